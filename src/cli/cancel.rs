use serde_json::json;

use super::survey::{self, OfResults};
use super::terminal::Terminal;
use super::{CliError, format};
use crate::executor::slurm::commands;

/// `cgaft study cancel FILE`: jobs that wait are forgotten, jobs at work write a checkpoint and end.
pub fn cancel(arguments: &OfResults) -> Result<u8, CliError> {
    let survey = survey::survey(&arguments.common.study, &arguments.place.results)?;
    let live = survey.entries.iter().filter(|entry| entry.is_on_slurm());
    let ids: Vec<&str> = live
        .filter_map(|entry| Some(entry.job.as_ref()?.slurm_id.as_str()))
        .collect();
    let unknown = survey
        .entries
        .iter()
        .find_map(|entry| entry.job.as_ref()?.sighting.as_ref().err());
    if let Some(why) = unknown {
        return Err(CliError::Environment(why.clone()));
    }
    if !ids.is_empty() {
        commands::cancel(ids.iter().copied()).map_err(crate::executor::ExecutorError::from)?;
    }
    let terminal = Terminal {
        quiet: false,
        json: arguments.common.json,
    };
    let json = json!({ "study": survey.plan.study, "cancelled": ids });
    terminal.result(&json, || match ids.len() {
        0 => "no case of this study waits or runs on Slurm\n".to_owned(),
        jobs => format!(
            "cancelled {}; `cgaft study run` goes on from the last checkpoints\n",
            format::count(jobs, "job")
        ),
    })?;
    Ok(0)
}
