//! The table of what is asked and what is reached: `reports/performance/demands.csv`.

use super::page;

/// What is asked of a number.
#[derive(Clone, Copy)]
pub enum Demand {
    AtLeast {
        least: f64,
        aim: f64,
    },
    /// `None`: nothing beyond the limit is aimed at.
    Below {
        most: f64,
        aim: Option<f64>,
    },
}

/// All rows in the order of the table. A part fills in its own and leaves the others.
const ROWS: [&str; 20] = [
    STEP_EXACT,
    STEP_GAUSS,
    MODEL_A,
    PEER,
    THREADS,
    RANKS,
    SET_UP,
    SET_UP_GROWTH,
    MEMORY_ATOM,
    MEMORY_REPRESENTED,
    OUTPUT,
    SOLID_STEP,
    SOLID_PEER,
    BAR_STEP,
    BAR_SET_UP,
    BAR_MEMORY,
    CHECK,
    PLAN,
    REPORT,
    NO_OP,
];
pub const STEP_EXACT: &str = "n = 10 intact mesh, exact";
pub const STEP_GAUSS: &str = "n = 10 intact mesh, gauss 2";
pub const MODEL_A: &str = "model A to 1.2 % strain with its crack, whole run";
pub const PEER: &str = "all atoms, running crack, over LAMMPS lj/cut/opt";
pub const THREADS: &str = "two threads over two runs side by side";
pub const RANKS: &str = "two ranks over two runs side by side, 128,160 elements";
pub const SET_UP: &str = "set-up of model A";
pub const SET_UP_GROWTH: &str = "set-up an element, 7 million atoms over 1 million";
pub const MEMORY_ATOM: &str = "memory an atom";
pub const MEMORY_REPRESENTED: &str = "memory a represented atom, n = 10";
pub const OUTPUT: &str = "output every ps and 20 snapshots, share of the time";
pub const SOLID_STEP: &str = "film of 1,600 blocks of ten cells";
pub const SOLID_PEER: &str = "atoms of a solid, cutoff 2.5 sigma, over LAMMPS lj/cut/opt";
pub const BAR_STEP: &str = "5,120 blocks: a step";
pub const BAR_SET_UP: &str = "5,120 blocks: set-up with all neighbour lists";
pub const BAR_MEMORY: &str = "5,120 blocks: memory";
pub const CHECK: &str = "check of 1,000 cases";
pub const PLAN: &str = "plan of 1,000 cases";
pub const REPORT: &str = "report of five models like A";
pub const NO_OP: &str = "study run with nothing to do";

const HEAD: [&str; 6] = ["work", "measured", "unit", "asked", "aim", "met"];

/// Puts a measured number into the table.
pub fn record(work: &str, measured: f64, unit: &str, demand: Demand) {
    assert!(ROWS.contains(&work), "the table has a place for {work}");
    let row = [
        work.to_owned(),
        page::number(measured),
        unit.to_owned(),
        demand.asked(),
        demand.aim(),
        demand.verdict(measured).to_owned(),
    ];
    eprintln!("  {}", row.join(" | "));
    let mut rows: Vec<Vec<String>> = page::read("demands")
        .into_iter()
        .skip(1)
        .filter(|old| old[0] != work)
        .collect();
    rows.push(row.to_vec());
    rows.sort_by_key(|row| ROWS.iter().position(|&place| place == row[0]));
    page::write("demands", &HEAD, &rows);
}

impl Demand {
    fn asked(self) -> String {
        match self {
            Self::AtLeast { least, .. } => format!("at least {}", page::number(least)),
            Self::Below { most, .. } => format!("below {}", page::number(most)),
        }
    }

    fn aim(self) -> String {
        match self {
            Self::AtLeast { aim, .. } | Self::Below { aim: Some(aim), .. } => page::number(aim),
            Self::Below { aim: None, .. } => String::new(),
        }
    }

    /// Written so that what is not a number fails.
    fn verdict(self, measured: f64) -> &'static str {
        let (asked, aimed) = match self {
            Self::AtLeast { least, aim } => (measured >= least, measured >= aim),
            Self::Below { most, aim } => (measured <= most, aim.is_some_and(|aim| measured <= aim)),
        };
        match (asked, aimed) {
            (true, true) => "yes, and the aim",
            (true, false) => "yes",
            (false, _) => "no",
        }
    }
}

/// The table as text.
pub fn table() -> String {
    let rows = page::read("demands");
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..HEAD.len()).map(width).collect();
    let line = |row: &Vec<String>| -> String {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:<width$}"));
        cells.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}
