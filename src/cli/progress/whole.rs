//! How far a study is as a whole: which of its cases this is, and how long all of them will take.

use std::collections::HashMap;
use std::time::Instant;

use crate::executor::Job;

/// The cases of one run, weighed by what each was estimated to take.
#[derive(Debug)]
pub struct Whole {
    cases: HashMap<String, Part>,
    started: usize,
    clock: Option<Instant>,
}

#[derive(Clone, Copy, Debug)]
struct Part {
    /// Estimated time of the whole case, s.
    seconds: f64,
    /// Position in the order of starting, from 1.
    number: Option<usize>,
    /// Percent when it was first heard of, and now.
    from: Option<f64>,
    percent: f64,
}

impl Whole {
    pub fn of(jobs: &[Job]) -> Whole {
        let part = |job: &Job| Part {
            seconds: job.seconds.max(f64::MIN_POSITIVE),
            number: None,
            from: None,
            percent: 0.0,
        };
        Whole {
            cases: jobs.iter().map(|job| (job.id.clone(), part(job))).collect(),
            started: 0,
            clock: None,
        }
    }

    /// Whether there is more to tell than of a case alone.
    pub fn is_several(&self) -> bool {
        self.cases.len() > 1
    }

    /// `case 3 of 9`: cases are counted as they start.
    pub fn count(&mut self, job: &Job) -> String {
        let total = self.cases.len();
        self.clock.get_or_insert_with(Instant::now);
        let Some(part) = self.cases.get_mut(&job.id) else {
            return format!("one of {total} cases");
        };
        let number = *part.number.get_or_insert_with(|| {
            self.started += 1;
            self.started
        });
        format!("case {number} of {total}")
    }

    /// A case has come so far.
    pub fn reach(&mut self, job: &Job, percent: f64) {
        if let Some(part) = self.cases.get_mut(&job.id) {
            part.from.get_or_insert(percent);
            part.percent = percent;
        }
    }

    /// A case has ended, however it did: nothing is left of it.
    pub fn end(&mut self, job: &Job) {
        self.reach(job, 100.0);
    }

    /// Cases that nothing is left of.
    pub fn ended(&self) -> usize {
        self.cases.values().filter(|part| part.percent >= 100.0).count()
    }

    pub fn total(&self) -> usize {
        self.cases.len()
    }

    /// Time until all have ended, s; `None` before there is anything to judge by, and at the end.
    pub fn seconds_left(&self) -> Option<f64> {
        self.left_after(self.clock?.elapsed().as_secs_f64())
    }

    fn left_after(&self, elapsed: f64) -> Option<f64> {
        let sum = |of: &dyn Fn(&Part) -> f64| self.cases.values().map(|part| part.seconds * of(part)).sum::<f64>();
        let gained = sum(&|part| part.percent - part.from.unwrap_or(part.percent));
        let missing = sum(&|part| 100.0 - part.percent);
        (gained > 0.0 && elapsed > 0.0 && missing > 0.0).then(|| elapsed * missing / gained)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn job(id: &str, seconds: f64) -> Job {
        Job {
            name: id.to_owned(),
            id: id.to_owned(),
            case_text: String::new(),
            case: serde_json::Value::Null,
            seconds,
            ranks: None,
            threads: None,
            fresh: None,
        }
    }

    #[test]
    fn cases_are_counted_as_they_start_and_weighed_by_their_estimates() {
        let jobs = [job("long", 90.0), job("short", 10.0), job("resumed", 100.0)];
        let mut whole = Whole::of(&jobs);
        assert_eq!(whole.left_after(10.0), None, "nothing to judge by");
        assert_eq!(whole.count(&jobs[0]), "case 1 of 3");
        assert_eq!(whole.count(&jobs[2]), "case 2 of 3");
        assert_eq!(whole.count(&jobs[0]), "case 1 of 3");
        whole.reach(&jobs[0], 0.0);
        whole.reach(&jobs[0], 50.0);
        whole.reach(&jobs[2], 50.0);
        // 45 s of estimated work were done in 30 s; 45, 10 and 50 are left.
        assert_eq!(whole.left_after(30.0), Some(70.0));
        jobs.iter().for_each(|job| whole.end(job));
        assert_eq!((whole.ended(), whole.left_after(60.0)), (3, None));
    }
}
