use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

use super::ticket;
use crate::executor::Job;
use crate::executor::command::quoted;
use crate::executor::share::Crew;
use crate::store::Store;
use crate::study::cluster::Cluster;

/// Jobs with equal resources, one or an array of them, as `sbatch` reads it.
#[derive(Clone, Debug)]
pub struct Script {
    /// Positions in the list of jobs, in the order of the array's tasks.
    pub jobs: Vec<usize>,
    pub crew: Crew,
    is_array: bool,
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
    /// Tasks that this Slurm takes in one array; 0 or 1: it has no arrays.
    pub longest_array: usize,
}

/// Time for a checkpoint before a job's limit, s, where the limit leaves it. Slurm may be a minute early.
const WARNING: f64 = 120.0;
/// A short job is warned when this share of its time is left.
const WARNING_SHARE: f64 = 0.25;

/// The scripts for these jobs, by their positions: one for each kind of crew and each array that Slurm takes.
pub fn scripts(store: &Store, study: &str, jobs: &[Job], chosen: &[usize], setting: &Setting) -> Vec<Script> {
    let Setting { cluster, .. } = setting;
    let crew_of = |&job: &usize| Crew {
        ranks: jobs[job].ranks.or(cluster.ranks).unwrap_or(1),
        threads: jobs[job].threads.or(cluster.threads).unwrap_or(1),
    };
    let mut alike: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for job in chosen {
        let Crew { ranks, threads } = crew_of(job);
        alike.entry((ranks, threads)).or_default().push(*job);
    }
    let mut scripts = Vec::new();
    for ((ranks, threads), alike) in alike {
        let crew = Crew { ranks, threads };
        let is_array = setting.longest_array > 1;
        scripts.extend(alike.chunks(setting.longest_array.max(1)).map(|some| Script {
            jobs: some.to_vec(),
            crew,
            is_array,
            text: text(store, study, some.iter().map(|&job| &jobs[job]), crew, setting),
        }));
    }
    scripts
}

impl Script {
    /// By which Slurm knows a job of this script, once it has taken the script under a number.
    pub fn slurm_id(&self, number: u64, task: usize) -> String {
        if self.is_array {
            format!("{number}_{task}")
        } else {
            number.to_string()
        }
    }
}

fn text<'a>(
    store: &Store,
    study: &str,
    jobs: impl ExactSizeIterator<Item = &'a Job>,
    crew: Crew,
    setting: &Setting,
) -> String {
    let Setting {
        program,
        solver,
        cluster,
        at_once,
        longest_array,
    } = setting;
    let root = absolute(store.root());
    let results = root.parent().unwrap_or(&root);
    let throttle = at_once.map(|most| format!("%{most}")).unwrap_or_default();
    let is_array = *longest_array > 1;
    let output = absolute(&ticket::folder(store))
        .display()
        .to_string()
        .replace('%', "%%")
        + if is_array { "/%A_%a.out" } else { "/%j.out" };
    let mut options = vec![format!("--job-name={}", super::job_name(study))];
    options.extend(is_array.then(|| format!("--array=0-{}{throttle}", jobs.len() - 1)));
    options.extend([
        // A node without a rank would compute nothing.
        format!("--nodes={}", cluster.nodes.unwrap_or(1).min(crew.ranks)),
        format!("--ntasks={}", crew.ranks),
        format!("--cpus-per-task={}", crew.threads),
    ]);
    let mut given = |name: &str, value: Option<String>| options.extend(value.map(|value| format!("--{name}={value}")));
    given("partition", cluster.partition.clone());
    given("account", cluster.account.clone());
    given("time", cluster.time.map(clock));
    let warning = cluster.time.map_or(WARNING, |time| WARNING.min(WARNING_SHARE * time));
    given("signal", Some(format!("B:USR1@{warning:.0}")));
    options.extend(["--requeue".to_owned(), "--open-mode=append".to_owned()]);
    options.push(format!("--output={output}"));
    options.extend(cluster.options.iter().cloned());

    let mut lines = vec!["#!/bin/bash".to_owned()];
    lines.extend(options.iter().map(|option| format!("#SBATCH {}", directive(option))));
    lines.push(String::new());
    lines.extend(cluster.modules.iter().map(|module| format!("module load {module}")));
    lines.extend(cluster.preamble.clone());
    lines.push("cases=(".to_owned());
    lines.extend(jobs.map(|job| format!("    {} # {}", job.id, job.name)));
    lines.push(")".to_owned());
    let word = |path: &Path| quoted(&absolute(path).display().to_string());
    lines.push(format!("export CGAFT_SOLVE={}", word(solver)));
    lines.push(format!(
        "exec {} slurm-job --results {} {} \"${{cases[${{SLURM_ARRAY_TASK_ID:-0}}]}}\"",
        word(program),
        word(results),
        quoted(study)
    ));
    lines.join("\n") + "\n"
}

/// An option as sbatch takes it from a script: it knows quotes and backslashes, and takes an open `#` for a comment. A line
/// break has no form there; [`absolute`] paths with one are refused before.
fn directive(option: &str) -> String {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_./=:,+@%".contains(letter);
    if option.chars().all(plain) {
        return option.to_owned();
    }
    format!("\"{}\"", option.replace('\\', r"\\").replace('"', "\\\""))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Takes an option apart as sbatch does (`_get_argument` of its option reader).
    fn read(line: &str) -> String {
        let (mut argument, mut quote, mut escaped) = (String::new(), None, false);
        for letter in line.chars() {
            match (escaped, quote, letter) {
                (true, ..) => {
                    argument.push(letter);
                    escaped = false;
                }
                (_, _, '\\') => escaped = true,
                (_, Some(open), _) if letter == open => quote = None,
                (_, None, '"' | '\'') => quote = Some(letter),
                (_, None, '#' | ' ') => break,
                _ => argument.push(letter),
            }
        }
        argument
    }

    #[test]
    fn sbatch_reads_each_option_as_it_was_meant() {
        for option in [
            "--mem=8G",
            "--output=/data/my results/%A.out",
            r#"--output=/a"b/c'd"#,
            r"--comment=a\b#c",
            "--comment=#",
        ] {
            assert_eq!(read(&directive(option)), option);
        }
        assert_eq!(directive("--mem=8G"), "--mem=8G");
    }
}
