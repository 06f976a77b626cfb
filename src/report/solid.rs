//! The report of solids: what came out, what it cost, and how far the cases are from the finest.

mod figures;
mod findings;
mod method;
mod overview;
mod picture;
mod series;
mod tables;
mod verdict;

pub use series::{Gauge, Series};

use std::path::Path;

use super::page::Solids;
use super::{CaseResult, Film, ReportError, Study, save};
use findings::Findings;

/// What a case of a solid has beside what any case has.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    pub specimen: Specimen,
    /// `None` where nothing was computed or nothing can be read.
    pub series: Option<Series>,
    /// The pictures that the run took.
    pub film: Option<Film<[f64; 3]>>,
}

/// A solid as it is laid out; in words where the page shows words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Specimen {
    /// Lengths along its axes, with their names, nm.
    pub edges: Vec<(&'static str, f64)>,
    /// `1,590 octahedra of 10, 3,180 tetrahedra of 10`
    pub kinds: String,
    pub notch: String,
    pub held: String,
    pub loading: String,
    /// Where the loading pulls, of length 1.
    pub direction: [f64; 3],
    /// Distance of nearest neighbours, nm.
    pub spacing: f64,
    pub nodes: u64,
    pub elements: u64,
    pub atoms: u64,
    /// Elements that are single atoms.
    pub atoms_alone: u64,
    /// Share of the atoms in smaller elements than asked for.
    pub leftover_share: Option<f64>,
    /// Equal for cases that are one computation, however they were asked for.
    pub computation: u64,
}

/// A case with what its series says.
struct Analysed<'a> {
    result: &'a CaseResult,
    solid: &'a Solid,
    findings: Findings,
}

impl Analysed<'_> {
    fn name(&self) -> &str {
        &self.result.name
    }

    fn series(&self) -> Option<&Series> {
        self.solid.series.as_ref()
    }

    /// Its name as part of the name of a file.
    fn file_part(&self) -> String {
        let plain = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '-' | '_' | '.');
        let letters = self.name().chars();
        letters.map(|letter| if plain(letter) { letter } else { '-' }).collect()
    }

    /// Atoms times steps over the wall time, /s.
    fn atom_steps_a_second(&self) -> Option<f64> {
        let manifest = &self.result.manifest;
        let wall = manifest.wall_seconds.filter(|&wall| wall > 0.0)?;
        Some(self.solid.specimen.atoms as f64 * manifest.steps? as f64 / wall)
    }
}

/// Whether a report may have drawn a file of this name.
pub fn is_of_a_report(name: &str) -> bool {
    figures::is_of_a_report(name) || picture::is_of_a_report(name)
}

/// The case with the most nodes that has come to its end: what the others are measured against.
fn reference<'a>(cases: &'a [Analysed<'a>]) -> Option<&'a Analysed<'a>> {
    let done = cases
        .iter()
        .filter(|case| case.series().is_some() && case.result.failure.is_none());
    // The first of equals.
    done.rev().max_by_key(|case| case.solid.specimen.nodes)
}

/// Writes report, tables and figures of a study of solids into its folder.
pub fn write(study: &Study, folder: &Path) -> Result<(), ReportError> {
    let solids = study
        .cases
        .iter()
        .filter_map(|result| Some((result, result.solid.as_ref()?)));
    let cases: Vec<Analysed> = solids
        .map(|(result, solid)| Analysed {
            result,
            solid,
            findings: Findings::of(solid),
        })
        .collect();
    let mut tables = tables::all(&cases)?;
    for table in &mut tables {
        table.write(&folder.join("tables"))?;
    }
    let charts = figures::charts(&cases);
    let mut drawn = Vec::new();
    for chart in &charts {
        let svg = chart.draw(study.figure_width)?;
        let file = folder.join("figures").join(format!("{}.svg", chart.id));
        save(&file, svg.standalone.as_bytes())?;
        drawn.push(svg);
    }
    let galleries = picture::galleries(&cases, &folder.join("figures"))?;
    let results: Vec<&CaseResult> = cases.iter().map(|case| case.result).collect();
    let page = Solids {
        study,
        cases: &results,
        verdict: verdict::sentences(&cases),
        groups: overview::groups(&cases),
        notes: method::notes(&cases),
        tables: &tables,
        charts: &charts,
        drawn: &drawn,
        galleries: &galleries,
    };
    save(&folder.join("report.html"), page.html()?.as_bytes())?;
    save(&folder.join("report.md"), page.markdown()?.as_bytes())
}
