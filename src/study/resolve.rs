//! A case with all its choices made, once it makes sense.
//!
//! A mistake keeps nothing else from being checked: what depends on a wrong value is left out, what does not is not.

mod crack;
mod gauges;
mod material;
mod noise;
mod refine;
mod resolution;
mod run;
mod slab;
mod solid;
mod specimen;
mod strangers;
mod unstrained;

use super::{
    case::Case,
    file::{CaseFile, Observe},
    finding::{Finding, Findings, Place},
    quantity::{Kind, Quantity},
    reader::Given,
};
use crate::units;
use serde::Serialize;

/// A case and what its report is to show.
#[derive(Clone, Debug, PartialEq)]
pub struct Resolved {
    pub case: Case,
    pub tables: Vec<Table>,
}

/// A table of the report.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Table {
    Crack,
    StressProfile,
    WaveArrival,
    AverageStress,
}

impl Table {
    pub const ALL: [Table; 4] = [
        Table::Crack,
        Table::StressProfile,
        Table::WaveArrival,
        Table::AverageStress,
    ];
}

/// Fill in the defaults and check that the whole makes sense; `None` where it does not, with the reasons in `findings`.
pub fn resolve(case: &Given<CaseFile>, name: &str, findings: &Findings) -> Option<Resolved> {
    let check = Check { findings, case: name };
    let (case, place) = check.section(case, Place::default())?;
    let (body, run, tables) = match strangers::is_solid(&case) {
        true => check.solid(&case, place),
        false => check.slab(&case, place),
    };
    let execution = check.execution(&case.run);
    let probes = check.probes(&case.probes);
    let snapshots = check.snapshots(&case.observe);
    let case = Case {
        body: body?,
        run: run?,
        probes: probes?,
        snapshots: snapshots?,
        execution: execution?,
    };
    Some(Resolved { case, tables })
}

/// The tables asked for; all of them where nothing is said.
fn tables(observe: &Given<Vec<Given<Observe>>>) -> Vec<Table> {
    let Given::Right(items, _) = observe else {
        return Table::ALL.to_vec();
    };
    let word = |item: &Given<Observe>| match item.right()? {
        Observe::Crack => Some(Table::Crack),
        Observe::StressProfile => Some(Table::StressProfile),
        Observe::WaveArrival => Some(Table::WaveArrival),
        Observe::AverageStress => Some(Table::AverageStress),
        Observe::Snapshots(_) | Observe::Gauges(_) => None,
    };
    let asked: Vec<Table> = items.iter().filter_map(word).collect();
    Table::ALL.into_iter().filter(|table| asked.contains(table)).collect()
}

/// A value and where it was given.
type At<T> = (T, Place);

struct Check<'a> {
    findings: &'a Findings,
    case: &'a str,
}

impl Check<'_> {
    fn add(&self, finding: Finding) {
        self.findings.add(finding.case(self.case));
    }

    /// A section, empty where it was left out; what it lacks is then missing from `parent`.
    fn section<T: Default + Clone>(&self, given: &Given<T>, parent: Place) -> Option<At<T>> {
        match given {
            Given::Absent => Some((T::default(), parent)),
            Given::Wrong(_) => None,
            Given::Right(values, place) => Some((values.clone(), *place)),
        }
    }

    /// A value that has no default. `path` and `example` are for the message.
    fn need<T: Clone>(&self, given: &Given<T>, section: Place, path: &str, example: &str) -> Option<At<T>> {
        match given {
            Given::Right(value, place) => Some((value.clone(), *place)),
            Given::Wrong(_) => None,
            Given::Absent => {
                let key = path.rsplit('.').next().unwrap_or(path);
                self.add(
                    Finding::at(section, format!("`{path}` is missing")).help(format!("write `{key}: {example}`")),
                );
                None
            }
        }
    }

    /// A value that may be left out.
    fn choice<T: Clone>(&self, given: &Given<T>, default: T) -> Option<T> {
        match given {
            Given::Right(value, _) => Some(value.clone()),
            Given::Wrong(_) => None,
            Given::Absent => Some(default),
        }
    }

    /// A quantity that has no default and is more than zero.
    fn size<K: Kind>(&self, given: &Given<Quantity<K>>, section: Place, path: &str) -> Option<At<f64>> {
        let (quantity, place) = self.need(given, section, path, example(path, K::DIMENSION))?;
        self.positive(quantity, place, path)
    }

    /// A quantity that may be left out and is otherwise more than zero; the outer `None` is a mistake.
    fn size_if_given<K: Kind>(&self, given: &Given<Quantity<K>>, path: &str) -> Option<Option<At<f64>>> {
        match given {
            Given::Absent => Some(None),
            Given::Wrong(_) => None,
            Given::Right(quantity, place) => self.positive(*quantity, *place, path).map(Some),
        }
    }

    fn positive<K: Kind>(&self, quantity: Quantity<K>, place: Place, path: &str) -> Option<At<f64>> {
        if quantity.value > 0.0 {
            return Some((quantity.value, place));
        }
        self.add(
            Finding::at(place, format!("`{path}` must be more than zero, and {quantity} is not"))
                .help(format!("write for example {}", example(path, K::DIMENSION))),
        );
        None
    }

    /// A number of at least 1.
    fn counted(&self, given: &Given<u32>, path: &str, most: u32) -> Option<Option<u32>> {
        match given {
            Given::Right(0, place) => {
                self.add(
                    Finding::at(*place, format!("`{path}` must be at least 1")).help("leave it out for the default"),
                );
                None
            }
            Given::Right(number, place) if *number > most => {
                let message =
                    format!("`{path}` must be at most {most}, more than any machine has, and {number} is not");
                self.add(Finding::at(*place, message).help("leave it out for the default"));
                None
            }
            Given::Right(number, _) => Some(Some(*number)),
            Given::Wrong(_) => None,
            Given::Absent => Some(None),
        }
    }
}

/// A quantity that would be right, of the size that this one usually has.
fn example(path: &str, dimension: units::Dimension) -> &'static str {
    match path.rsplit('.').next() {
        Some("sigma") => "0.2277 nm",
        Some("distance" | "from") => "0.2556 nm",
        Some("cutoff" | "to") => "0.34 nm",
        Some("thickness") => "0.2087 nm",
        Some("half-width" | "radius") => "9 nm",
        Some("sponge") => "60 nm",
        Some("damping") => "2e10 /s",
        _ if path == "probes.every" => "1 ps",
        _ if path == "run.time-step" => "2 fs",
        _ if path == "crack.length" => "56 nm",
        _ if path == "crack.center" => "57 nm",
        _ if path == "specimen.length" => "566 nm",
        _ => dimension.example(),
    }
}

/// A length for a message.
fn nanometres(value: f64) -> String {
    units::format(value, units::Dimension::Length)
}

/// A computed length for a message, which needs no more than four digits.
fn about(value: f64) -> String {
    nanometres(format!("{value:.3e}").parse().unwrap_or(value))
}
