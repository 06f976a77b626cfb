//! What nobody works on is submitted, as much as Slurm has room for.

use std::collections::HashMap;
use std::time::{Duration, Instant};

use jiff::Timestamp;

use super::Watch;
use crate::executor::queue::starts_over;
use crate::executor::share::Crew;
use crate::executor::slurm::commands::{self, Sighting};
use crate::executor::slurm::script::{Script, scripts};
use crate::executor::slurm::{SlurmError, Ticket, job_name};
use crate::executor::{Ending, ExecutorError, Job, Stop};
use crate::store::{State, Store};

/// Time after which Slurm is asked again whether it has room, where none of the jobs has ended meanwhile.
const TRY_AGAIN: Duration = Duration::from_secs(60);

impl Watch<'_> {
    /// Submits what nobody works on and what no job of before waits for.
    pub(super) fn hand_over(&mut self, stop: &Stop) -> Result<(), ExecutorError> {
        let without: Vec<usize> = self
            .cases
            .iter()
            .filter(|case| case.ticket.is_none())
            .map(|case| case.job)
            .collect();
        let is_full = self.full.is_some_and(|since| since.elapsed() < TRY_AGAIN);
        if without.is_empty() || stop.requested() || is_full {
            return Ok(());
        }
        self.full = None;
        let _lock = self.errand.store.lock_submission()?;
        let seen = commands::sightings(&job_name(&self.settings.study))?;
        let mut free = without;
        free.retain(|&job| !self.find_again(job, &seen) && !self.is_busy(job));
        let (store, jobs, settings) = (self.errand.store, self.errand.jobs, self.settings);
        let scripts_of = |some: &[usize]| scripts(store, &settings.study, jobs, some, &settings.setting);
        let mut left = scripts_of(&free);
        left.reverse();
        while let Some(script) = left.pop() {
            match self.submit(&script) {
                Err(ExecutorError::Slurm(full)) if full.is_for_want_of_room() => {
                    let (some, others) = script.jobs.split_at(script.jobs.len() / 2);
                    if some.is_empty() {
                        self.full = Some(Instant::now());
                        let held_back = left.iter().flat_map(|script| &script.jobs).chain(others);
                        self.hold_back(&held_back.copied().collect::<Vec<_>>(), &full.words());
                        break;
                    }
                    // As many of them as there is room for.
                    left.extend(scripts_of(others).into_iter().rev());
                    left.extend(scripts_of(some).into_iter().rev());
                }
                Err(ExecutorError::Slurm(source)) if self.submitted > 0 => {
                    let source = Box::new(source);
                    let submitted = self.submitted;
                    return Err(SlurmError::Halfway { submitted, source }.into());
                }
                other => other?,
            }
        }
        Ok(())
    }

    /// Hands one script over.
    fn submit(&mut self, script: &Script) -> Result<(), ExecutorError> {
        let (store, jobs) = (self.errand.store, self.errand.jobs);
        let ticket = |&job: &usize| ticket_for(store, &jobs[job], script.crew);
        let tickets: Vec<Ticket> = script.jobs.iter().map(ticket).collect();
        // The jobs may begin before `sbatch` has ended.
        tickets.iter().try_for_each(|ticket| ticket.write(store))?;
        let number = match commands::submit(&script.to_string()) {
            Ok(number) => number,
            Err(refused) => {
                tickets.iter().try_for_each(|ticket| ticket.withdraw(store))?;
                return Err(refused.into());
            }
        };
        for (task, (ticket, &job)) in tickets.into_iter().zip(&script.jobs).enumerate() {
            let slurm_id = script.slurm_id(number, task);
            self.errand.watcher.submitted(&jobs[job], &slurm_id);
            let ticket = Ticket {
                slurm_id: Some(slurm_id.clone()),
                ..ticket
            };
            ticket.write(store)?;
            self.follow(job, ticket, slurm_id);
            self.submitted += 1;
        }
        Ok(())
    }

    /// Tells once of each case for which Slurm has no room that it waits here.
    fn hold_back(&mut self, these: &[usize], words: &str) {
        let next = match self.settings.detach {
            true => "the same command hands it over when some have ended",
            false => "it is handed over when some have ended",
        };
        let why = format!("not yet submitted, because Slurm takes no more jobs now; {next} ({words})");
        for case in self.cases.iter_mut().filter(|case| these.contains(&case.job)) {
            if !std::mem::replace(&mut case.told_full, true) {
                self.errand.watcher.queued(&self.errand.jobs[case.job], &why);
            }
        }
    }

    /// Whether another process computes it, of which the watcher is told once.
    fn is_busy(&mut self, job: usize) -> bool {
        let busy = matches!(self.errand.store.state(&self.errand.jobs[job].id), State::Running(_));
        if busy {
            self.errand.tell_busy(job);
        }
        busy
    }

    /// Whether a job of before waits for this case or computes it.
    fn find_again(&mut self, job: usize, seen: &HashMap<String, Sighting>) -> bool {
        let Some(ticket) = Ticket::read(self.errand.store, &self.errand.jobs[job].id) else {
            return false;
        };
        let Some(slurm_id) = ticket.slurm_id.clone() else {
            return false;
        };
        let live = matches!(seen.get(&slurm_id), Some(Sighting::Queued { .. } | Sighting::Running));
        if live {
            self.follow(job, ticket, slurm_id);
        }
        live
    }

    fn follow(&mut self, job: usize, ticket: Ticket, slurm_id: String) {
        self.errand.endings[job] = Ending::HandedOver(slurm_id);
        if let Some(case) = self.cases.iter_mut().find(|case| case.job == job) {
            case.ticket = Some(ticket);
        }
    }
}

/// A case that starts over says so with its time, so that a job that comes back to the queue does not start over again.
fn ticket_for(store: &Store, job: &Job, crew: Crew) -> Ticket {
    let submitted = Timestamp::now();
    let over = job.fresh.is_some() || starts_over(&store.state(&job.id));
    Ticket {
        job: Job {
            fresh: over.then_some(submitted),
            ranks: Some(crew.ranks),
            ..job.clone()
        },
        threads: crew.threads,
        submitted,
        slurm_id: None,
    }
}
