//! What jobs on a cluster get, from the study and from a profile of the user's own.

use super::{
    StudyError,
    case::{MOST_RANKS, MOST_THREADS},
    file::ClusterFile,
    finding::{Finding, Findings, Place},
    quantity::Duration,
    reader::{Given, read as read_tree},
    source, tree,
};
use std::{path::Path, sync::Arc};

/// Resources of a job, and how its node is made ready.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cluster {
    pub partition: Option<String>,
    pub account: Option<String>,
    /// Longest time of one job, s.
    pub time: Option<f64>,
    /// Nodes that the ranks of a case are spread over.
    pub nodes: Option<u32>,
    pub ranks: Option<u32>,
    /// Of each rank.
    pub threads: Option<u32>,
    pub modules: Vec<String>,
    /// Lines of shell.
    pub preamble: Option<String>,
    /// Of `sbatch`.
    pub options: Vec<String>,
}

/// Slurm counts time in minutes, s. No job runs for ten years.
const SHORTEST: f64 = 60.0;
const LONGEST: f64 = 3.2e8;

/// What the runner itself tells `sbatch`, and must know.
const RESERVED: [&str; 17] = [
    "--partition",
    "--account",
    "--time",
    "--array",
    "--job-name",
    "--output",
    "--error",
    "--open-mode",
    "--signal",
    "--requeue",
    "--no-requeue",
    "--wrap",
    "--parsable",
    "--wait",
    "--ntasks",
    "--nodes",
    "--cpus-per-task",
];

impl Cluster {
    /// What this one leaves open is as in `profile`.
    pub fn over(self, profile: Cluster) -> Cluster {
        let list = |own: Vec<String>, other: Vec<String>| if own.is_empty() { other } else { own };
        Cluster {
            partition: self.partition.or(profile.partition),
            account: self.account.or(profile.account),
            time: self.time.or(profile.time),
            nodes: self.nodes.or(profile.nodes),
            ranks: self.ranks.or(profile.ranks),
            threads: self.threads.or(profile.threads),
            modules: list(self.modules, profile.modules),
            preamble: self.preamble.or(profile.preamble),
            options: list(self.options, profile.options),
        }
    }
}

/// A profile: a file with the keys of `cluster:`; `None` where there is no such file.
pub fn read_profile(path: &Path) -> Result<Option<Cluster>, StudyError> {
    if !path.exists() {
        return Ok(None);
    }
    let name = path.display().to_string();
    let fail = |text: &Arc<str>, findings: Vec<Finding>| StudyError::new(&name, Arc::clone(text), findings);
    let (text, _) = source::text(&name).map_err(|finding| fail(&"".into(), vec![finding]))?;
    let text: Arc<str> = text.into();
    let findings = Findings::default();
    let root = tree::parse(&text, &findings).map_err(|finding| fail(&text, vec![finding]))?;
    let cluster = resolve(&read_tree(&root, &findings), &findings);
    if findings.is_empty() {
        Ok(Some(cluster))
    } else {
        Err(fail(&text, findings.sorted()))
    }
}

/// The block with its mistakes noted; what is wrong is left out.
pub(crate) fn resolve(given: &Given<ClusterFile>, findings: &Findings) -> Cluster {
    let Some(file) = given.right() else {
        return Cluster::default();
    };
    let check = Check(findings);
    check.spread(&file.nodes, &file.ranks);
    Cluster {
        partition: check.word(&file.partition, "partition"),
        account: check.word(&file.account, "account"),
        time: check.time(&file.time),
        nodes: check.count(&file.nodes, "nodes", MOST_RANKS),
        ranks: check.count(&file.ranks, "ranks", MOST_RANKS),
        threads: check.count(&file.threads, "threads", MOST_THREADS),
        modules: check.list(&file.modules, |check, given| check.word(given, "modules")),
        preamble: file.preamble.right().map(|text| text.trim_end().to_owned()),
        options: check.list(&file.options, Check::option),
    }
}

struct Check<'a>(&'a Findings);

impl Check<'_> {
    fn refuse(&self, place: Place, message: String, help: &str) {
        self.0.add(Finding::at(place, message).help(help));
    }

    /// A name that stands in a script as it is.
    fn word(&self, given: &Given<String>, key: &str) -> Option<String> {
        let Given::Right(text, place) = given else { return None };
        let plain = |letter: char| letter.is_alphanumeric() || "-_./+=:,@".contains(letter);
        if !text.is_empty() && text.chars().all(plain) {
            return Some(text.clone());
        }
        let message = format!("`{text}` is no name for `cluster.{key}`");
        self.refuse(
            *place,
            message,
            "write it as the cluster does, without blanks and quotes",
        );
        None
    }

    fn list(
        &self,
        given: &Given<Vec<Given<String>>>,
        one: impl Fn(&Self, &Given<String>) -> Option<String>,
    ) -> Vec<String> {
        let items = given.right().map(Vec::as_slice).unwrap_or_default();
        items.iter().filter_map(|item| one(self, item)).collect()
    }

    fn option(&self, given: &Given<String>) -> Option<String> {
        let Given::Right(text, place) = given else { return None };
        let name = text.split('=').next().unwrap_or_default();
        if !text.starts_with("--") || text.contains(char::is_control) {
            let message = format!("`{text}` is no option of sbatch in its long form");
            self.refuse(*place, message, "write for example `options: [--mem=8G, --qos=long]`");
        } else if text.contains(char::is_whitespace) {
            let message = format!("`{text}` is more than one option, or has a blank in its value");
            self.refuse(
                *place,
                message,
                "write each option as an item of its own: `options: [--mem=8G, --qos=long]`",
            );
        } else if let Some(reserved) = RESERVED.iter().find(|reserved| reserved.starts_with(name)) {
            // sbatch takes the beginning of a name for the whole.
            let message = format!("`{reserved}` is set by cgaft itself");
            let help = match *reserved {
                "--partition" | "--account" | "--time" => {
                    "write it as a key of `cluster`: `partition`, `account` or `time`"
                }
                _ => "leave it out; `cgaft study plan FILE --on slurm` shows the script",
            };
            self.refuse(*place, message, help);
        } else {
            return Some(text.clone());
        }
        None
    }

    fn time(&self, given: &Given<Duration>) -> Option<f64> {
        let Given::Right(time, place) = *given else { return None };
        if (SHORTEST..LONGEST).contains(&time.value) {
            return Some(time.value);
        }
        let bound = if time.value < SHORTEST {
            "at least a minute"
        } else {
            "less than ten years"
        };
        let message = format!("`cluster.time` must be {bound}, and {time} is not");
        self.refuse(place, message, "write for example `time: 4 h`");
        None
    }

    fn count(&self, given: &Given<u32>, key: &str, most: u32) -> Option<u32> {
        match *given {
            Given::Right(0, place) => {
                let message = format!("`cluster.{key}` must be at least 1");
                self.refuse(place, message, "leave it out for one");
                None
            }
            Given::Right(number, place) if number > most => {
                let message = format!("`cluster.{key}` must be at most {most}, more than any machine has");
                self.refuse(place, message, "leave it out for one");
                None
            }
            Given::Right(number, _) => Some(number),
            _ => None,
        }
    }

    /// A node without a rank would compute nothing.
    fn spread(&self, nodes: &Given<u32>, ranks: &Given<u32>) {
        if let (&Given::Right(nodes, place), &Given::Right(ranks, other)) = (nodes, ranks)
            && nodes > ranks
            && ranks > 0
        {
            let message =
                format!("`cluster.nodes: {nodes}` is more than there are ranks, so that a node would have none");
            let finding = Finding::at(place, message).with(other, "the ranks");
            self.0.add(finding.help("ask for fewer nodes, or for more ranks"));
        }
    }
}
