//! Twenty random `kill -9` of ranks, of their mpirun, of the runner and of all of them during one study: it ends with the
//! bits of a study that nobody has disturbed, and leaves nothing behind.
//!
//! Two ranks a case where the solver knows MPI, else one process.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;

use super::mpi_solver::solver_with_mpi;

const STUDY: &str = include_str!("../studies/slab.yaml");
const CASES: [&str; 3] = ["coarse", "mixed", "atoms"];

const KILLS: usize = 20;
/// Starts after which fewer kills of one study are a failure of the test: where a study ends before its last kill, another
/// one begins and the kills are counted anew.
const STARTS: usize = 80;
/// A kill comes within so many milliseconds of a start: with all of them the study does not come to its end.
const LONGEST: u64 = 2000;
/// As many times slower than the study of the other tests.
const SLOWER: [&str; 2] = ["rate: 1e9 /s", "rate: 1e8 /s"];
/// For a runner to notice that one of its solvers is gone.
const NOTICED: Duration = Duration::from_millis(300);
/// For a study without its mpirun, or a job without a rank, to be gone on a loaded machine.
const PATIENCE: Duration = Duration::from_secs(30);

/// Random numbers, the same in every run. [Steele 2014] splitmix64
struct Dice(u64);

impl Dice {
    /// Below `end`.
    fn throw(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ (mixed >> 31)) % end
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Victim {
    /// One process of a solver.
    Rank,
    /// What the runner has started itself: an mpirun, or a solver.
    Started,
    Runner,
    Everything,
}

const VICTIMS: [Victim; 4] = [Victim::Rank, Victim::Started, Victim::Runner, Victim::Everything];

struct Place {
    folder: TempDir,
    solver: PathBuf,
}

impl Place {
    /// A study that writes checkpoints all the time, or hardly ever.
    fn new(checkpoint_every: &str, solver: &Path) -> Place {
        let folder = tempfile::tempdir().unwrap();
        assert!(STUDY.contains("checkpoint-every: 1 h"));
        let checkpoint_every = format!("checkpoint-every: {checkpoint_every}");
        let study = STUDY.replace("checkpoint-every: 1 h", &checkpoint_every);
        let [fast, slow] = SLOWER;
        assert!(study.contains(fast));
        let study = study.replace(fast, slow);
        fs::write(folder.path().join("slab.yaml"), study).unwrap();
        Place {
            folder,
            solver: solver.to_owned(),
        }
    }

    fn start(&self, command: &str, arguments: &[&str]) -> Child {
        let output = |name: &str| fs::File::create(self.folder.path().join(name)).unwrap();
        let mut cgaft = Command::new(env!("CARGO_BIN_EXE_cgaft"));
        cgaft.args(["study", command, "slab.yaml"]).args(arguments);
        cgaft.env("CGAFT_SOLVE", &self.solver);
        cgaft.current_dir(self.folder.path()).stdin(Stdio::null());
        cgaft.stdout(output("stdout")).stderr(output("stderr")).spawn().unwrap()
    }

    #[track_caller]
    fn cgaft(&self, command: &str, arguments: &[&str]) {
        let status = self.start(command, arguments).wait().unwrap();
        assert!(status.success(), "{}", self.said());
    }

    fn said(&self) -> String {
        ["stdout", "stderr"]
            .map(|name| fs::read_to_string(self.folder.path().join(name)).unwrap_or_default())
            .concat()
    }

    fn results(&self) -> PathBuf {
        self.folder.path().join("results/slab")
    }
}

/// Every process, its parent and the name of its program.
fn processes() -> Vec<(u32, u32, String)> {
    let told = |folder: PathBuf| {
        let stat = fs::read_to_string(folder.join("stat")).ok()?;
        let (start, rest) = stat.rsplit_once(") ")?;
        let (process, name) = start.split_once(" (")?;
        let mut rest = rest.split_whitespace();
        let is_dead = rest.next()? == "Z";
        let parent = rest.next()?.parse().ok()?;
        (!is_dead).then_some((process.parse().ok()?, parent, name.to_owned()))
    };
    let folders = fs::read_dir("/proc").unwrap().flatten().map(|entry| entry.path());
    folders.filter_map(told).collect()
}

/// What a process has started, and what that has; with the names of their programs.
fn descendants(process: u32) -> Vec<(u32, String)> {
    let all = processes();
    let mut found: Vec<(u32, String)> = Vec::new();
    let mut parents = vec![process];
    while let Some(parent) = parents.pop() {
        for (child, _, name) in all.iter().filter(|(_, of, _)| *of == parent) {
            found.push((*child, name.clone()));
            parents.push(*child);
        }
    }
    found
}

/// Solvers and starters at work for a folder.
fn at_work(folder: &Path) -> Vec<u32> {
    let folder = folder.display().to_string();
    let is_ours = |process: u32| {
        let command = fs::read(format!("/proc/{process}/cmdline")).unwrap_or_default();
        let place = fs::read_link(format!("/proc/{process}/cwd")).unwrap_or_default();
        let command = String::from_utf8_lossy(&command).into_owned();
        command.contains("--parent-pipe") && (place.starts_with(&folder) || command.contains(&folder))
    };
    let all = processes().into_iter().map(|(process, _, _)| process);
    all.filter(|process| is_ours(*process)).collect()
}

fn send(signal: &str, process: u32) {
    // That it has ended meanwhile is the only way in which this fails.
    let _ = Command::new("kill")
        .args([signal, &process.to_string()])
        .stderr(Stdio::null())
        .status();
}

fn wait_until(what: &str, mut happened: impl FnMut() -> bool) {
    let start = Instant::now();
    while !happened() {
        assert!(start.elapsed() < PATIENCE, "waited too long until {what}");
        thread::sleep(Duration::from_millis(10));
    }
}

/// Kills; the runner where there is nobody else.
fn strike(victim: Victim, run: &Child, dice: &mut Dice) {
    let all = descendants(run.id());
    let ranks: Vec<u32> = all
        .iter()
        .filter(|(_, name)| name == "cgaft-solve")
        .map(|(rank, _)| *rank)
        .collect();
    let victims: Vec<u32> = match victim {
        Victim::Rank if ranks.is_empty() => Vec::new(),
        Victim::Rank => vec![ranks[dice.throw(ranks.len() as u64) as usize]],
        Victim::Started => {
            let own = processes().into_iter().filter(|(_, parent, _)| *parent == run.id());
            own.map(|(process, _, _)| process).collect()
        }
        Victim::Runner => vec![run.id()],
        Victim::Everything => all.iter().map(|(process, _)| *process).chain([run.id()]).collect(),
    };
    match victims.as_slice() {
        [] => send("-KILL", run.id()),
        victims => victims.iter().for_each(|process| send("-KILL", *process)),
    }
}

#[test]
fn a_study_killed_twenty_times_at_random_ends_with_the_same_bits_and_leaves_nothing_behind() {
    let with_mpi = solver_with_mpi();
    let ranks = if with_mpi.is_some() { "2" } else { "1" };
    let solver = with_mpi.unwrap_or_else(|| env!("CARGO_BIN_EXE_cgaft-solve").into());
    let whole = Place::new("1 h", &solver);
    whole.cgaft("run", &[]);

    let place = Place::new("20 ms", &solver);
    let arguments = ["--ranks", ranks, "--threads", "1"];
    let mut dice = Dice(5);
    let mut kills = 0;
    for _ in 0..STARTS {
        if kills == KILLS {
            break;
        }
        let mut run = place.start("run", &arguments);
        thread::sleep(Duration::from_millis(dice.throw(LONGEST)));
        let victim = VICTIMS[dice.throw(VICTIMS.len() as u64) as usize];
        let is_over = run.try_wait().unwrap().is_some();
        if is_over {
            fs::remove_dir_all(place.results()).unwrap();
            kills = 0;
            continue;
        }
        strike(victim, &run, &mut dice);
        kills += 1;
        if matches!(victim, Victim::Rank | Victim::Started) {
            // The runner would see the other cases through.
            thread::sleep(NOTICED);
            send("-INT", run.id());
        }
        wait_until("the runner has ended", || run.try_wait().unwrap().is_some());
        if victim != Victim::Rank {
            wait_until("nothing computes on", || at_work(place.folder.path()).is_empty());
        }
    }
    assert_eq!(kills, KILLS, "kills of one study in {STARTS} starts");

    place.cgaft("run", &arguments);
    for case in CASES {
        for name in ["checkpoint.h5", "series.h5", "fields.vtkhdf"] {
            let [own, other] =
                [&place, &whole].map(|place| fs::read(place.results().join("cases").join(case).join(name)));
            assert!(own.unwrap() == other.unwrap(), "{name} of {case} is another one");
        }
    }
    place.cgaft("clean", &[]);
    let names = |folder: &str| {
        let entries = fs::read_dir(place.results().join(folder)).unwrap().flatten();
        entries.map(|entry| entry.file_name().into_string().unwrap())
    };
    let unpublished: Vec<String> = names("runs").filter(|name| name.contains('.')).collect();
    assert!(unpublished.is_empty(), "{unpublished:?}");
    assert_eq!(names("runs").count(), CASES.len());
    for case in CASES {
        let half: Vec<String> = names(&format!("cases/{case}"))
            .filter(|name| name.ends_with(".tmp") || name.ends_with(".new"))
            .collect();
        assert!(half.is_empty(), "{half:?}");
    }
    assert!(at_work(place.folder.path()).is_empty());
}
