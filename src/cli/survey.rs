//! What a study asks for beside what there is of it, and why each case would run.

use std::path::{Path, PathBuf};

use clap::Args;

use super::CliError;
use crate::executor::queue::starts_over;
use crate::executor::slurm::{self, Sighting, Whereabouts};
use crate::plan::{self, Plan, PlannedCase};
use crate::record::CHECKPOINT_FILE;
use crate::store::{Attempt, Reached, State, Store};
use crate::study;

/// What every `study` command wants to know.
#[derive(Args, Clone, Debug)]
pub struct Common {
    /// The study file, or the name of a study that comes with cgaft
    #[arg(value_name = "FILE")]
    pub study: String,
    /// Print the result as JSON, and messages to standard error
    #[arg(long)]
    pub json: bool,
}

/// Where the results are.
#[derive(Args, Clone, Debug)]
pub struct Place {
    /// Folder of all results; each study has its own folder in it
    #[arg(long, value_name = "DIR", default_value = "results")]
    pub results: PathBuf,
}

/// What the commands want to know that look at results.
#[derive(Args, Clone, Debug)]
pub struct OfResults {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub place: Place,
}

/// A study, its cases and their states.
#[derive(Debug)]
pub struct Survey {
    pub plan: Plan,
    pub store: Store,
    pub entries: Vec<Entry>,
}

/// One case of a study.
#[derive(Debug)]
pub struct Entry {
    pub planned: PlannedCase,
    /// Identity of the case, as text.
    pub id: String,
    pub state: State,
    /// Why it would run, or why not.
    pub reason: String,
    /// Its job, where Slurm was given it and it is not done.
    pub job: Option<Whereabouts>,
}

/// Reads and plans a study.
pub fn read(file: &str) -> Result<Plan, CliError> {
    let plan = plan::plan(&study::read(file)?)?;
    if plan.cases.is_empty() {
        return Err(CliError::Input(format!(
            "{file} has no cases; add at least one below `cases:`"
        )));
    }
    Ok(plan)
}

/// The case of this name.
pub fn named<'a>(plan: &'a Plan, wanted: &str) -> Result<&'a PlannedCase, CliError> {
    let named = plan.cases.iter().find(|case| case.name == wanted);
    named.ok_or_else(|| {
        let names: Vec<&str> = plan.cases.iter().map(|case| case.name.as_str()).collect();
        let nearest = names
            .iter()
            .max_by(|a, b| strsim::jaro(a, wanted).total_cmp(&strsim::jaro(b, wanted)));
        let nearest = nearest
            .map(|name| format!(" Did you mean `{name}`?"))
            .unwrap_or_default();
        let (study, names) = (&plan.study, names.join(", "));
        CliError::Input(format!(
            "study {study} has no case `{wanted}`.{nearest} It has: {names}"
        ))
    })
}

/// Reads and plans a study and looks at what there is of it. Changes nothing.
pub fn survey(file: &str, results: &Path) -> Result<Survey, CliError> {
    let plan = read(file)?;
    let store = Store::open(results, &plan.study)?;
    let entries = entries(&store, &plan);
    Ok(Survey { plan, store, entries })
}

impl Survey {
    /// Whether this case waits or runs as a job.
    pub fn is_on_slurm(&self, id: &str) -> bool {
        self.entries.iter().any(|entry| entry.id == id && entry.is_on_slurm())
    }

    /// Looks at the content of every published file too.
    pub fn verify(&mut self) {
        for entry in &mut self.entries {
            if matches!(entry.state, State::Done(_) | State::Corrupt { .. }) {
                entry.state = self.store.verified_state(&entry.id);
                entry.reason = reason(&self.store, &entry.planned, &entry.id, &entry.state);
            }
        }
    }

    /// Cases that were published and whose files are no longer what they were, with what is wrong.
    pub fn damaged(&self) -> impl Iterator<Item = (&str, &str)> {
        self.entries.iter().filter_map(|entry| match &entry.state {
            State::Corrupt { why } => Some((entry.planned.name.as_str(), why.as_str())),
            _ => None,
        })
    }

    /// Looks again, after something has run.
    pub fn refresh(&mut self) {
        self.entries = entries(&self.store, &self.plan);
    }
}

impl Entry {
    pub fn to_json(&self) -> serde_json::Value {
        let mut entry = serde_json::json!({
            "case": self.planned.name, "id": self.id, "state": self.word(), "reason": self.reason,
        });
        if !self.planned.swept.is_empty() {
            entry["swept"] = swept(&self.planned);
        }
        if let Some(job) = &self.job {
            entry["slurm_job"] = serde_json::json!(job.slurm_id);
        }
        entry
    }

    /// One word for what there is of it, or where it is.
    pub fn word(&self) -> &'static str {
        match self.job.as_ref().map(|job| &job.sighting) {
            Some(Ok(Some(Sighting::Queued { .. }))) => "queued",
            Some(Ok(Some(Sighting::Running))) => "running",
            _ => self.state.word(),
        }
    }

    /// It waits or runs as a job.
    pub fn is_on_slurm(&self) -> bool {
        self.job.as_ref().is_some_and(Whereabouts::is_live)
    }
}

/// What a sweep has set in a case, by the names of the columns in its tables.
pub fn swept(planned: &PlannedCase) -> serde_json::Value {
    let values = planned.swept.iter().map(|swept| (swept.column(), swept.json()));
    serde_json::Value::Object(values.collect())
}

fn entries(store: &Store, plan: &Plan) -> Vec<Entry> {
    let mut entries: Vec<Entry> = plan.cases.iter().map(|planned| entry(store, planned)).collect();
    let open = entries.iter().filter(|entry| !matches!(entry.state, State::Done(_)));
    let mut jobs = slurm::whereabouts(store, &plan.study, open.map(|entry| entry.id.as_str()));
    for entry in &mut entries {
        if let Some(job) = jobs.remove(&entry.id) {
            entry.reason = with_job(&entry.state, &entry.reason, &job);
            entry.job = Some(job);
        }
    }
    entries
}

/// The reason of a case, with what Slurm says of its job.
fn with_job(state: &State, reason: &str, job: &Whereabouts) -> String {
    let id = &job.slurm_id;
    match (&job.sighting, state) {
        (Ok(Some(Sighting::Queued { why })), State::Partial(attempt)) => {
            format!(
                "queued as Slurm job {id} ({}), goes on{}",
                slurm::reason(why),
                at_step(attempt)
            )
        }
        (Ok(Some(Sighting::Queued { why })), _) => format!("queued as Slurm job {id} ({})", slurm::reason(why)),
        (Ok(Some(Sighting::Running)), State::Running(attempt) | State::Partial(attempt)) => {
            format!("running as Slurm job {id}{}", at_step(attempt))
        }
        (Ok(Some(Sighting::Running)), _) => format!("running as Slurm job {id}"),
        (Err(why), _) => format!("{reason}; submitted as Slurm job {id}, of which nothing can be learned: {why}"),
        (Ok(Some(Sighting::Ended(_))), State::Missing | State::Partial(_)) | (Ok(None), State::Missing) => {
            format!("{reason}; {}", job.fact())
        }
        (_, State::Failed(failure)) if failure.ended >= job.submitted => format!("{reason} (Slurm job {id})"),
        // The job is of long ago, and somebody else has worked on the case since.
        _ => reason.to_owned(),
    }
}

fn entry(store: &Store, planned: &PlannedCase) -> Entry {
    let id = planned.id.to_string();
    let state = store.state(&id);
    let reason = reason(store, planned, &id, &state);
    Entry {
        planned: planned.clone(),
        id,
        state,
        reason,
        job: None,
    }
}

fn reason(store: &Store, planned: &PlannedCase, id: &str, state: &State) -> String {
    let checkpoint = store.partial_folder(id).join(CHECKPOINT_FILE);
    let over = match (starts_over(state), checkpoint.exists()) {
        (true, _) => "; starts over",
        (false, true) => "; goes on from its last checkpoint",
        (false, false) => "; no checkpoint yet, starts over",
    };
    match state {
        State::Done(_) => "unchanged".to_owned(),
        State::Missing => changes(store, planned, id).unwrap_or_else(|| "new".to_owned()),
        State::Partial(attempt) => format!("interrupted{}{over}", at_step(attempt)),
        State::Running(attempt) => format!("running in another process{}", at_step(attempt)),
        State::Failed(failure) => format!("failed before: {}{over}", failure.meaning),
        State::Corrupt { why } => format!("corrupt: {why}; starts over"),
    }
}

fn at_step(attempt: &Option<Attempt>) -> String {
    match attempt.as_ref().and_then(|attempt| attempt.reached) {
        Some(Reached { step, of, percent }) => format!(" at step {step} of {of} ({percent:.0} %)"),
        None => String::new(),
    }
}

/// What differs from the run that the case had before; `None` if it never had one.
fn changes(store: &Store, planned: &PlannedCase, id: &str) -> Option<String> {
    let old = store.linked(&planned.name).filter(|old| old != id)?;
    let State::Done(manifest) = store.state(&old) else {
        return None;
    };
    let differences = plan::explain_difference(&manifest.case, &plan::spelled(&planned.case));
    Some(match differences.is_empty() {
        // Only what computes it can be another.
        true => "new: with these ranks and threads".to_owned(),
        false => format!("changed: {}", differences.join(", ")),
    })
}
