//! The table of all gates: claim, expected, found, tolerance, passed.
//!
//! Every gate adds its rows as it ends, and the page is written again, ordered by chapter: the last gate leaves it
//! complete. It lies beside the build. With `CGAFT_WRITE_DOCS` set it becomes `docs/verification.md`, but only when as
//! many gates have closed as there are tests of the physics, each of which closes one: a run that leaves some out, or in
//! which one broke off, leaves the document alone.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;
use std::process::Command;
use std::sync::Mutex;

/// Chapters of the page, in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Chapter {
    Energy,
    Crystal,
    Waves,
    Motion,
    Fracture,
    Peer,
    Gates,
}

impl Chapter {
    fn title(self) -> &'static str {
        match self {
            Self::Energy => "Forces and energy",
            Self::Crystal => "The crystal",
            Self::Waves => "Waves",
            Self::Motion => "Motion in time",
            Self::Fracture => "Fracture",
            Self::Peer => "Against LAMMPS",
            Self::Gates => "The tests themselves",
        }
    }
}

/// What is asked of a number.
#[derive(Clone, Copy, Debug)]
enum Demand {
    Within { expected: f64, share: f64 },
    Near { expected: f64, distance: f64 },
    Below { limit: f64 },
    Reported,
}

#[derive(Clone, Debug)]
struct Row {
    claim: String,
    setting: String,
    demand: Demand,
    found: f64,
}

impl Row {
    /// Written so that what is not a number fails.
    fn passes(&self) -> bool {
        match self.demand {
            Demand::Within { expected, share } => (self.found - expected).abs() <= share * expected.abs(),
            Demand::Near { expected, distance } => (self.found - expected).abs() <= distance,
            Demand::Below { limit } => self.found <= limit,
            Demand::Reported => true,
        }
    }

    fn line(&self) -> String {
        let (expected, tolerance) = match self.demand {
            Demand::Within { expected, share } => (number(expected), format!("{} of it", short(share))),
            Demand::Near { expected, distance } => (number(expected), short(distance)),
            Demand::Below { limit } => (format!("at most {}", short(limit)), String::new()),
            Demand::Reported => ("reported".to_owned(), String::new()),
        };
        let verdict = match self.demand {
            Demand::Reported => "",
            _ if self.passes() => "yes",
            _ => "**no**",
        };
        let Self { claim, setting, .. } = self;
        format!(
            "| {claim} | {setting} | {expected} | {} | {tolerance} | {verdict} |",
            number(self.found)
        )
    }
}

fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-3 => format!("{value:.1e}"),
        size => {
            let decimals = (5 - size.log10().floor() as i32).max(0) as usize;
            format!("{value:.decimals$}")
        }
    }
}

fn short(value: f64) -> String {
    if value < 1e-3 {
        format!("{value:e}")
    } else {
        format!("{value}")
    }
}

type Page = BTreeMap<(Chapter, &'static str), Vec<Row>>;
static PAGE: Mutex<Page> = Mutex::new(Page::new());

/// Collects the rows of one gate, and fails with all of them that do not hold.
pub struct Gate {
    key: (Chapter, &'static str),
    rows: Vec<Row>,
}

impl Gate {
    /// `order` places a gate among those of its chapter.
    pub fn new(chapter: Chapter, order: &'static str) -> Self {
        Self {
            key: (chapter, order),
            rows: Vec::new(),
        }
    }

    fn add(&mut self, claim: &str, setting: &str, demand: Demand, found: f64) {
        self.rows.push(Row {
            claim: claim.to_owned(),
            setting: setting.to_owned(),
            demand,
            found,
        });
    }

    /// Found must be this share of the expected near to it.
    pub fn within(&mut self, claim: &str, setting: &str, found: f64, expected: f64, share: f64) {
        self.add(claim, setting, Demand::Within { expected, share }, found);
    }

    pub fn near(&mut self, claim: &str, setting: &str, found: f64, expected: f64, distance: f64) {
        self.add(claim, setting, Demand::Near { expected, distance }, found);
    }

    pub fn below(&mut self, claim: &str, setting: &str, found: f64, limit: f64) {
        self.add(claim, setting, Demand::Below { limit }, found);
    }

    pub fn report(&mut self, claim: &str, setting: &str, found: f64) {
        self.add(claim, setting, Demand::Reported, found);
    }

    pub fn close(self) {
        let failed: Vec<String> = self.rows.iter().filter(|row| !row.passes()).map(Row::line).collect();
        let rows = self.rows.iter().map(Row::line).collect::<Vec<_>>().join("\n");
        let mut page = PAGE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let before = page.insert(self.key, self.rows);
        write_page(&page);
        drop(page);
        assert!(before.is_none(), "two gates share the place {:?}", self.key);
        assert!(failed.is_empty(), "\n{}\n\nof\n{rows}", failed.join("\n"));
    }
}

fn write_page(page: &Page) {
    let mut text = String::from(
        "# Verification\n\nWritten by `make verify` from a run of all gates. \
         Reduced Lennard-Jones units (epsilon = sigma = mass = 1) and the triangular lattice unless said otherwise; \
         r0 is the lattice spacing, n the number of atoms per edge of an element, n = 1 single atoms.\n",
    );
    let mut chapter = None;
    for ((next, _), rows) in page {
        if chapter != Some(*next) {
            let head = "| claim | potential, specimen | expected | found | tolerance | holds |\n| --- | --- | --- | --- | --- | --- |";
            write!(text, "\n## {}\n\n{head}\n", next.title()).expect("a string takes all");
            chapter = Some(*next);
        }
        for row in rows {
            text += &row.line();
            text.push('\n');
        }
    }
    let beside_build = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("../verification");
    write(&beside_build.join("verification.md"), &text);
    if std::env::var_os("CGAFT_WRITE_DOCS").is_some() && page.len() == test_count() {
        write(
            &PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("docs/verification.md"),
            &text,
        );
    }
}

/// All tests of the physics in this program, whatever it was told to run.
fn test_count() -> usize {
    let program = std::env::current_exe().expect("the program knows its place");
    let list = Command::new(program).args(["--list", "--format", "terse"]).output();
    let list = list.expect("the program lists its tests").stdout;
    let list = String::from_utf8(list).expect("names of tests are text");
    let of_physics = |line: &&str| {
        let chapters = ["verify::gates::", "verify::lammps::"];
        line.ends_with(": test") && chapters.iter().any(|chapter| line.starts_with(chapter))
    };
    list.lines().filter(of_physics).count()
}

fn write(path: &std::path::Path, text: &str) {
    std::fs::create_dir_all(path.parent().expect("the page lies in a folder")).expect("the folder can be made");
    std::fs::write(path, text).expect("the page can be written");
}
