//! The same atoms in LAMMPS: both in turns, and the median of the ratios.

use std::fs;
use std::process::Command;

use super::demand::{self, Demand};
use super::{clock, commands, page, specimens};

const TURNS: usize = 3;

/// A slab whose crack runs.
pub fn measure() {
    let ratio = in_turns("running-crack", "lammps", our_seconds);
    let demand = Demand::AtLeast { least: 1.5, aim: 3.0 };
    demand::record(demand::PEER, ratio, "times", demand);
}

/// How many times the processor time of this program LAMMPS takes for the case `atoms` of a study, of which `ours` tells what so many
/// steps take here, and how many atoms there are. Leaves the turns as a table.
pub fn in_turns(study: &str, table: &str, ours: impl Fn(u32) -> [f64; 2]) -> f64 {
    let folder = page::scratch().join(table);
    if folder.exists() {
        fs::remove_dir_all(&folder).expect("the scratch folder can be written");
    }
    let into = folder.display().to_string();
    let study = specimens::study(study).display().to_string();
    commands::cgaft(&["export", "lammps", &study, "--case", "atoms", "--into", &into]);
    let exported = fs::read_to_string(folder.join("in.atoms")).expect("it is exported");
    let (script, steps) = fastest(&exported);
    fs::write(folder.join("in.fast"), script).expect("the scratch folder can be written");
    let mut rows = Vec::new();
    let mut ratios = Vec::new();
    for turn in 1..=TURNS {
        let [ours, atoms] = ours(steps);
        let theirs = their_seconds(&folder);
        let rate = |seconds: f64| page::number(1e-6 * atoms * f64::from(steps) / seconds);
        rows.push(vec![
            turn.to_string(),
            rate(ours),
            rate(theirs),
            page::number(theirs / ours),
        ]);
        eprintln!("  {}", rows[rows.len() - 1].join(" | "));
        ratios.push(theirs / ours);
    }
    page::write(
        table,
        &["turn", "cgaft, million atom-steps a core-second", "LAMMPS", "ratio"],
        &rows,
    );
    clock::median(ratios)
}

/// The exported script with the fastest pair style for it, without output; and its number of steps. The pairs that the
/// notch severs are left out of the neighbour lists: they only repel, which they have no occasion for under tension.
fn fastest(exported: &str) -> (String, u32) {
    let mut script = String::new();
    let mut steps = 0;
    for line in exported.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        let kept = match words[..] {
            ["pair_style", "hybrid", _, cutoff, ..] => format!("pair_style lj/cut {cutoff}"),
            ["pair_coeff", "*", "*", _, _, epsilon, sigma] => format!("pair_coeff * * {epsilon} {sigma}"),
            ["pair_coeff", "*", "*", ..] => line.to_owned(),
            ["pair_coeff", one, other, ..] => format!("neigh_modify exclude type {one} {other}"),
            [
                "pair_modify" | "dump" | "dump_modify" | "thermo_style" | "thermo_modify" | "thermo",
                ..,
            ] => continue,
            ["run", number] => {
                steps = number.parse().expect("the number of steps");
                format!("thermo {steps}\n{line}")
            }
            _ => line.to_owned(),
        };
        script.push_str(&kept);
        script.push('\n');
    }
    (script, steps)
}

/// Seconds of a core that the steps take here, and the number of atoms.
fn our_seconds(steps: u32) -> [f64; 2] {
    clock::with_threads(1, || {
        let mut solver = specimens::solver("running-crack", "atoms");
        let work = || solver.advance_by(u64::from(steps)).expect("the step is stable");
        let seconds = clock::core_seconds(work);
        [seconds, solver.mesh().sites.len() as f64]
    })
}

/// The same in LAMMPS: what it says of its loop, and of the share of a core that it had.
fn their_seconds(folder: &std::path::Path) -> f64 {
    let output = Command::new("lmp")
        .args(["-suffix", "opt", "-in", "in.fast"])
        .env("OMP_NUM_THREADS", "1")
        .current_dir(folder)
        .output()
        .expect("LAMMPS (`lmp`) is installed: make bench");
    let said = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{said}");
    let after = |before: &str| {
        said.split(before)
            .nth(1)
            .and_then(|rest| rest.split_whitespace().next())
    };
    let seconds: f64 = after("Loop time of ")
        .and_then(|word| word.parse().ok())
        .expect("its time");
    let share = said
        .lines()
        .find(|line| line.contains("% CPU use"))
        .and_then(|line| line.split('%').next());
    let share: f64 = share
        .and_then(|word| word.trim().parse().ok())
        .expect("its share of a core");
    0.01 * share * seconds
}
