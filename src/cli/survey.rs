//! What a study asks for beside what there is of it, and why each case would run.

use std::path::{Path, PathBuf};

use clap::Args;

use super::CliError;
use crate::executor::queue::starts_over;
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
    let entries = plan.cases.iter().map(|planned| entry(&store, planned)).collect();
    Ok(Survey { plan, store, entries })
}

impl Survey {
    /// Looks again, after something has run.
    pub fn refresh(&mut self) {
        self.entries = self
            .plan
            .cases
            .iter()
            .map(|planned| entry(&self.store, planned))
            .collect();
    }
}

impl Entry {
    pub fn to_json(&self) -> serde_json::Value {
        serde_json::json!({
            "case": self.planned.name, "id": self.id, "state": self.state.word(), "reason": self.reason,
        })
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
    Some(format!("changed: {}", differences.join(", ")))
}
