use std::fmt;
use std::path::{Path, PathBuf};

use super::ticket;
use crate::executor::Job;
use crate::executor::launch::quoted;
use crate::store::Store;
use crate::study::cluster::Cluster;

/// One array of jobs with equal resources, as `sbatch` reads it.
#[derive(Clone, Debug)]
pub struct Script {
    /// Positions in the list of jobs, in the order of the array's tasks.
    pub jobs: Vec<usize>,
    pub threads: u32,
    text: String,
}

/// Programs, resources and limits that all scripts of a study share.
#[derive(Clone, Debug)]
pub struct Setting {
    /// `cgaft` and `cgaft-solve` as the nodes see them.
    pub program: PathBuf,
    pub solver: PathBuf,
    pub cluster: Cluster,
    /// Jobs of an array at work at once; `None`: as many as Slurm starts.
    pub at_once: Option<usize>,
}

/// Tasks of one array: Slurm as it comes allows 1,001.
const LONGEST_ARRAY: usize = 1000;

/// Time for a checkpoint before a job's limit, s, where the limit leaves it. Slurm may be a minute early.
const WARNING: f64 = 120.0;
/// A short job is warned when this share of its time is left.
const WARNING_SHARE: f64 = 0.25;

/// The scripts for these jobs, by their positions: one for each number of threads and every thousand cases.
pub fn scripts(store: &Store, study: &str, jobs: &[Job], chosen: &[usize], setting: &Setting) -> Vec<Script> {
    let threads_of = |&job: &usize| jobs[job].threads.or(setting.cluster.threads).unwrap_or(1);
    let mut classes: Vec<u32> = chosen.iter().map(threads_of).collect();
    classes.sort_unstable();
    classes.dedup();
    let mut scripts = Vec::new();
    for threads in classes {
        let alike: Vec<usize> = chosen
            .iter()
            .copied()
            .filter(|job| threads_of(job) == threads)
            .collect();
        scripts.extend(alike.chunks(LONGEST_ARRAY).map(|some| Script {
            jobs: some.to_vec(),
            threads,
            text: text(store, study, some.iter().map(|&job| &jobs[job]), threads, setting),
        }));
    }
    scripts
}

fn text<'a>(
    store: &Store,
    study: &str,
    jobs: impl ExactSizeIterator<Item = &'a Job>,
    threads: u32,
    setting: &Setting,
) -> String {
    let Setting {
        program,
        solver,
        cluster,
        at_once,
    } = setting;
    let root = absolute(store.root());
    let results = root.parent().unwrap_or(&root);
    let throttle = at_once.map(|most| format!("%{most}")).unwrap_or_default();
    let output = absolute(&ticket::folder(store))
        .display()
        .to_string()
        .replace('%', "%%")
        + "/%A_%a.out";
    let mut options = vec![
        format!("--job-name={}", super::job_name(study)),
        format!("--array=0-{}{throttle}", jobs.len() - 1),
        "--nodes=1".to_owned(),
        "--ntasks=1".to_owned(),
        format!("--cpus-per-task={threads}"),
    ];
    let mut given = |name: &str, value: Option<String>| options.extend(value.map(|value| format!("--{name}={value}")));
    given("partition", cluster.partition.clone());
    given("account", cluster.account.clone());
    given("time", cluster.time.map(clock));
    let warning = cluster.time.map_or(WARNING, |time| WARNING.min(WARNING_SHARE * time));
    given("signal", Some(format!("B:USR1@{warning:.0}")));
    options.extend(["--requeue".to_owned(), "--open-mode=append".to_owned()]);
    options.push(format!("--output=\"{output}\""));
    options.extend(cluster.options.iter().cloned());

    let mut lines = vec!["#!/bin/bash".to_owned()];
    lines.extend(options.iter().map(|option| format!("#SBATCH {option}")));
    lines.push(String::new());
    lines.extend(cluster.modules.iter().map(|module| format!("module load {module}")));
    lines.extend(cluster.preamble.clone());
    lines.push("cases=(".to_owned());
    lines.extend(jobs.map(|job| format!("    {} # {}", job.id, job.name)));
    lines.push(")".to_owned());
    let word = |path: &Path| quoted(&absolute(path).display().to_string());
    lines.push(format!("export CGAFT_SOLVE={}", word(solver)));
    lines.push(format!(
        "exec {} slurm-job --results {} {} \"${{cases[$SLURM_ARRAY_TASK_ID]}}\"",
        word(program),
        word(results),
        quoted(study)
    ));
    lines.join("\n") + "\n"
}

/// A node starts in another folder.
fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// `hours:minutes:seconds`
fn clock(seconds: f64) -> String {
    let whole = seconds.ceil() as u64;
    format!("{:02}:{:02}:{:02}", whole / 3600, whole % 3600 / 60, whole % 60)
}

impl fmt::Display for Script {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.text)
    }
}
