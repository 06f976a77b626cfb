//! `kill -9` at any moment: what is run again ends as if nothing had happened.

use std::fs;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use super::{PATIENCE, Program, RESULTS, STUDY, Workspace, assert_same_results, files, restless, send};

/// When a process is killed.
#[derive(Clone, Copy, Debug)]
enum Moment {
    /// So long after its start.
    After(Duration),
    /// As soon as a file with this in its name is there that was not there at its start.
    Writing(&'static str),
}

/// Random numbers, the same in every run of the tests. [Steele 2014] splitmix64
struct Dice(u64);

impl Dice {
    /// Below `end`.
    fn throw(&mut self, end: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (mixed ^ (mixed >> 31)) % end
    }

    fn moment(&mut self, longest: Duration) -> Moment {
        Moment::After(Duration::from_millis(self.throw(longest.as_millis() as u64)))
    }
}

/// Lets a program run to a moment in the life of the files in a folder; `false` if it ends before.
fn reached(moment: Moment, program: &mut Program, folder: &Path) -> bool {
    let start = Instant::now();
    let before = files(folder);
    let is_new = |path: &PathBuf, part: &str| path.to_string_lossy().contains(part) && !before.contains(path);
    loop {
        let now = match moment {
            Moment::After(delay) => start.elapsed() >= delay,
            Moment::Writing(part) => files(folder).iter().any(|path| is_new(path, part)),
        };
        if now || program.has_ended() {
            return now && !program.has_ended();
        }
        assert!(start.elapsed() < PATIENCE, "{moment:?} never came: {}", program.said());
        thread::sleep(Duration::from_micros(100));
    }
}

/// No file of these folders is one that was just being written.
#[track_caller]
fn assert_nothing_half_written(folder: &Path) {
    let left: Vec<_> = files(folder)
        .into_iter()
        .filter(|path| path.extension().is_some_and(|end| end == "tmp" || end == "new"))
        .collect();
    assert!(left.is_empty(), "{left:?}");
}

/// A case that writes a checkpoint whenever it can; that is no part of its identity.
fn hurried(case: &Path) -> String {
    let text = fs::read_to_string(case).unwrap();
    let changed = |line: &str| match line.split_once("checkpoint-every: ") {
        Some((before, _)) => format!("{before}checkpoint-every: 20 ms\n"),
        None => format!("{line}\n"),
    };
    let hurried = text.lines().map(changed).collect();
    assert_ne!(hurried, text);
    hurried
}

/// What a solver writes while it computes; each name ends as a file does that is not yet in place.
const WHILE_COMPUTING: [&str; 3] = ["checkpoint.h5.tmp", "/series-", "/frame-"];
/// What it writes once, at its end, in this order.
const AT_THE_END: [&str; 4] = ["/series.h5.tmp", "/series.h5", "/fields.vtkhdf.tmp", "/outcome"];

/// Kills wanted of the solver, how often a test goes through its moments at most, and the kills without which it
/// shows nothing.
const KILLS: usize = 16;
const ROUNDS: usize = 3;
const LEAST_KILLS: usize = 12;

#[test]
fn a_solver_killed_at_any_moment_ends_with_the_same_bits() {
    let place = Workspace::with(&pictures());
    place.cgaft("run", &["--only", "mixed"]).succeeded();
    let whole = place.case("mixed");
    let case = place.path("mixed.yaml");
    fs::write(&case, hurried(&whole.join("case.yaml"))).unwrap();

    let into = place.path("killed");
    let mut dice = Dice(1);
    let computing = (0..2)
        .flat_map(|_| WHILE_COMPUTING)
        .flat_map(|part| [Moment::Writing(part), dice.moment(Duration::from_millis(300))]);
    let moments: Vec<Moment> = computing.chain(AT_THE_END.map(Moment::Writing)).collect();
    let mut kills = 0;
    // A run that ends before its moment comes starts anew, so that a fast machine is killed as often as a slow one.
    for moment in moments.iter().copied().cycle().take(ROUNDS * moments.len()) {
        if kills == KILLS {
            break;
        }
        let mut solve = Program::start(&mut place.solver(&case, &into, &["--threads", "1"]), &place);
        if reached(moment, &mut solve, &into) {
            solve.kill();
            kills += 1;
        } else {
            solve.wait(PATIENCE).succeeded();
            assert_same_results(&into, &whole);
            fs::remove_dir_all(&into).unwrap();
        }
    }
    assert!(kills >= LEAST_KILLS, "only {kills} kills");
    let last = &mut place.solver(&case, &into, &["--threads", "1"]);
    Program::start(last, &place).wait(PATIENCE).succeeded();
    assert_same_results(&into, &whole);
    assert_nothing_half_written(&into);
    let names = files(&into);
    assert!(
        !names.iter().any(|path| path.to_string_lossy().contains("frame-")),
        "{names:?}"
    );
}

/// Who is killed.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Victim {
    /// `cgaft`: its solvers see that it is gone.
    Runner,
    /// The solvers: `cgaft` sees that they are gone.
    Solvers,
    Both,
}

/// Processes that this process has started.
fn children(process: u32) -> Vec<u32> {
    let parent = |path: &Path| -> Option<u32> {
        let stat = fs::read_to_string(path.join("stat")).ok()?;
        // Behind the name, which may hold anything: the state and the parent.
        stat.rsplit_once(')')?.1.split_whitespace().nth(1)?.parse().ok()
    };
    let processes = fs::read_dir("/proc").unwrap().flatten().map(|entry| entry.path());
    let own = processes.filter(|path| parent(path) == Some(process));
    own.filter_map(|path| path.file_name()?.to_str()?.parse().ok())
        .collect()
}

#[test]
fn a_study_killed_at_any_moment_ends_with_the_same_bits() {
    const CASES: [&str; 3] = ["coarse", "mixed", "atoms"];
    let whole = Workspace::with(&pictures());
    whole.cgaft("run", &[]).succeeded();

    let place = Workspace::restless();
    let mut dice = Dice(2);
    let mut random = || dice.moment(Duration::from_millis(800));
    let moments = [
        (Victim::Runner, random()),
        (Victim::Both, Moment::Writing("/checkpoint.h5")),
        (Victim::Solvers, random()),
        (Victim::Both, random()),
        (Victim::Runner, Moment::Writing("/attempt")),
        (Victim::Solvers, Moment::Writing("/frame-")),
        (Victim::Both, random()),
        (Victim::Runner, Moment::Writing("/series.h5.tmp")),
        (Victim::Both, Moment::Writing("/fields.vtkhdf.tmp")),
        (Victim::Both, Moment::Writing("/outcome.json")),
        (Victim::Runner, Moment::Writing("/manifest")),
        (Victim::Runner, Moment::Writing("/tables/")),
    ];
    let mut kills = 0;
    for (victim, moment) in moments.into_iter().cycle().take(ROUNDS * moments.len()) {
        if kills == moments.len() {
            break;
        }
        let arguments = ["--jobs", "2", "--threads", "1"];
        let mut run = Program::start(&mut place.command("run", &arguments), &place);
        if !reached(moment, &mut run, &place.results()) {
            run.wait(PATIENCE).succeeded();
            fs::remove_dir_all(place.results()).unwrap();
            continue;
        }
        kills += 1;
        let solvers = children(run.child.id());
        if victim != Victim::Solvers {
            run.kill();
        }
        if victim != Victim::Runner {
            solvers.iter().for_each(|solver| send("-KILL", *solver));
        }
        if victim == Victim::Solvers {
            let told = run.wait(PATIENCE);
            assert!(
                solvers.is_empty() || told.stderr.contains("the solver was killed (signal 9)"),
                "{}{}",
                told.stdout,
                told.stderr
            );
        }
    }
    assert!(kills >= 8, "only {kills} kills");
    place.cgaft("run", &[]).succeeded();
    for case in CASES {
        assert_same_results(&place.case(case), &whole.case(case));
    }
    place.cgaft("clean", &[]).succeeded();
    assert_nothing_half_written(&place.results());
    let runs = fs::read_dir(place.results().join("runs")).unwrap();
    assert_eq!(runs.count(), CASES.len(), "published runs and nothing else");
    assert_eq!(place.states(), ["done"; 3]);
}

/// The study of the restless ones with no checkpoint before its end.
fn pictures() -> String {
    restless(STUDY).replace("checkpoint-every: 20 ms", "checkpoint-every: 1 h")
}

/// What a kill between two acts of publishing leaves, made by hand, because these moments are too short to be met.
#[test]
fn a_run_killed_while_it_is_published_is_published_again_as_it_was() {
    let place = Workspace::new();
    place.cgaft("run", &["--only", "mixed"]).succeeded();
    let published = place.case("mixed");
    let results = RESULTS.map(|name| fs::read(published.join(name)).unwrap());
    let steps = steps(&published);
    let partial = published.with_extension("partial");
    let undo: [&[&str]; 3] = [&[], &["manifest.json"], &["manifest.json", "log.txt"]];
    for removed in undo {
        fs::rename(&published, &partial).unwrap();
        removed
            .iter()
            .for_each(|name| fs::remove_file(partial.join(name)).unwrap());
        let again = place.cgaft("run", &["--only", "mixed"]).succeeded();
        assert!(again.started("mixed"), "{}", again.stdout);
        let now = RESULTS.map(|name| fs::read(published.join(name)).unwrap());
        assert!(now == results, "without {removed:?}");
        assert_eq!(self::steps(&published), steps);
        assert_eq!(place.states()[1], "done");
    }
}

/// What the manifest tells of the computation itself.
fn steps(run: &Path) -> serde_json::Value {
    let manifest = fs::read_to_string(run.join("manifest.json")).unwrap();
    let manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
    let outcome = &manifest["outcome"];
    [
        "end_reason",
        "steps",
        "time_step_ps",
        "stability_limit_ps",
        "energy_error_relative",
    ]
    .map(|key| outcome[key].clone())
    .to_vec()
    .into()
}
