//! `--on slurm`: what the jobs get, and the scripts that ask for it.

use std::env;
use std::path::{self, PathBuf};

use super::prepare::{Arguments, Prepared};
use super::survey::Survey;
use super::{CliError, format};
use crate::executor::launch;
use crate::executor::slurm::{Script, Setting, commands, scripts};
use crate::study::cluster::read_profile;

/// Resources of the study, and where it leaves them open, of the profile.
pub fn setting(survey: &Survey, arguments: &Arguments) -> Result<Setting, CliError> {
    let results = path::absolute(survey.store.root()).unwrap_or_default();
    if results.to_string_lossy().contains(char::is_control) {
        let results = results.display();
        return Err(CliError::Input(format!(
            "{results:?} has a line break or another control character, which no job script can hold; name another folder \
             by `--results`"
        )));
    }
    let profile = match profile_path() {
        Some(path) => read_profile(&path)?.unwrap_or_default(),
        None => Default::default(),
    };
    let program = env::current_exe().map_err(|error| {
        CliError::Environment(format!("this program cannot find itself: {error}; install it again"))
    })?;
    Ok(Setting {
        program,
        // A plan is worth showing before the solver is installed.
        solver: launch::find_solver().unwrap_or_else(|_| "cgaft-solve".into()),
        cluster: survey.plan.cluster.clone().over(profile),
        at_once: arguments.crew.jobs.map(usize::from),
        longest_array: commands::longest_array(),
    })
}

/// What a run would hand over now. What waits or runs there already is not handed over twice.
pub fn scripts_of(survey: &Survey, prepared: &Prepared, setting: &Setting) -> Vec<Script> {
    let new = |&job: &usize| !survey.is_on_slurm(&prepared.jobs[job].id);
    let chosen: Vec<usize> = (0..prepared.jobs.len()).filter(new).collect();
    scripts(&survey.store, &survey.plan.study, &prepared.jobs, &chosen, setting)
}

/// `2 cases to run as jobs of Slurm, 1 is there already`
pub fn summary(survey: &Survey, prepared: &Prepared) -> String {
    let there = prepared.jobs.iter().filter(|job| survey.is_on_slurm(&job.id)).count();
    match (prepared.jobs.len() - there, there) {
        (0, 0) => "nothing to run".to_owned(),
        (0, there) => format!(
            "nothing to hand over, {} on Slurm already",
            format::count(there, "case")
        ),
        (new, 0) => format!("{} to run as jobs of Slurm", format::count(new, "case")),
        (new, there) => format!(
            "{} to run as jobs of Slurm, {there} there already",
            format::count(new, "case")
        ),
    }
}

fn profile_path() -> Option<PathBuf> {
    let own = env::var_os("XDG_CONFIG_HOME")
        .filter(|folder| !folder.is_empty())
        .map(PathBuf::from);
    let folder = own.or_else(|| Some(PathBuf::from(env::var_os("HOME")?).join(".config")))?;
    Some(folder.join("cgaft/cluster.yaml"))
}
