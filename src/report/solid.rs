//! The report of solids: what came out, what it cost, and how far the cases are from the finest.

mod figures;
mod findings;
mod method;
mod overview;
mod period;
mod picture;
mod series;
pub mod specimen;
mod surfaces;
mod tables;
mod verdict;

pub use series::{Gauge, Series, along};
pub use specimen::{Crystal, Solid, Specimen};

use std::path::Path;

use super::page::Solids;
use super::{CaseResult, ReportError, Study, save, scaling};
use findings::Findings;
use surfaces::Surface;

/// A case with what its series says.
struct Analysed<'a> {
    result: &'a CaseResult,
    solid: &'a Solid,
    findings: Findings,
    /// One a picture.
    surfaces: Vec<Surface>,
}

impl Analysed<'_> {
    fn name(&self) -> &str {
        &self.result.name
    }

    fn series(&self) -> Option<&Series> {
        self.solid.series.as_ref()
    }

    /// Whether anything has opened or slid in its pictures.
    fn has_parted(&self) -> bool {
        self.surfaces
            .iter()
            .any(|surface| surface.crack() + surface.slip() + surface.areas.elsewhere > 0.0)
    }

    /// Energy that is missing over the work; `None` of what stands still, on which nothing works.
    fn energy_error(&self) -> Option<f64> {
        let moves = self.findings.modulus_at_rest.is_none();
        self.result.manifest.energy_error.filter(|_| moves)
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

/// What a case is measured against: that with the most nodes of all that load the same solid in the same way and have come to their
/// end; `None` where there is no other such case.
fn reference<'a>(cases: &'a [Analysed<'a>], of: &Analysed) -> Option<&'a Analysed<'a>> {
    let alike = cases.iter().filter(|case| experiment(case).eq(experiment(of)));
    let done = alike.filter(|case| case.series().is_some() && case.result.failure.is_none());
    let others = done.clone().any(|case| case.name() != of.name());
    // The first of equals.
    done.rev()
        .max_by_key(|case| case.solid.specimen.nodes)
        .filter(|_| others)
}

/// What of a case says which experiment it is, and not how it is computed.
fn experiment<'a>(case: &'a Analysed) -> impl Iterator<Item = &'a (String, String)> {
    const SECTIONS: [&str; 7] = [
        "material.",
        "specimen.",
        "notch.",
        "held.",
        "loading.",
        "run.relax.",
        "run.noise.",
    ];
    let says = |(key, _): &&(String, String)| SECTIONS.iter().any(|section| key.starts_with(section));
    case.result.choices.iter().filter(says)
}

/// Writes report, tables and figures of a study of solids into its folder.
pub fn write(study: &Study, folder: &Path) -> Result<(), ReportError> {
    let solids = study
        .cases
        .iter()
        .filter_map(|result| Some((result, result.solid.as_ref()?)));
    let cases: Vec<Analysed> = solids
        .map(|(result, solid)| {
            Ok(Analysed {
                result,
                solid,
                findings: Findings::of(solid),
                surfaces: surfaces::surfaces(solid)?,
            })
        })
        .collect::<Result<_, ReportError>>()?;
    let scaling = scaling::findings(study);
    let mut tables = tables::all(&cases, &study.comparisons, scaling.as_ref())?;
    for table in &mut tables {
        table.write(&folder.join("tables"))?;
    }
    let mut charts = scaling.as_ref().map(scaling::charts).unwrap_or_default();
    charts.extend(figures::charts(&cases));
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
        scaling: scaling.as_ref(),
        verdict: match scaling.as_ref().and_then(scaling::verdict) {
            Some(gain) => vec![verdict::done(&cases), gain],
            None => verdict::sentences(&cases),
        },
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

#[cfg(test)]
mod tests {
    use super::*;

    fn result(name: &str, choices: &[(&str, &str)], nodes: u64) -> CaseResult {
        let owned = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
        CaseResult {
            name: name.to_owned(),
            choices: choices.iter().map(owned).collect(),
            solid: Some(Solid {
                specimen: Specimen {
                    nodes,
                    ..Specimen::default()
                },
                series: Some(Series::default()),
                ..Solid::default()
            }),
            ..CaseResult::default()
        }
    }

    #[test]
    fn a_case_is_measured_against_the_finest_of_its_own_experiment() {
        let long = ("specimen.blocks", "4; 4; 40");
        let short = ("specimen.blocks", "2; 2; 20");
        let [coarse, fine] = ["10", "1"].map(|size| ("resolution.element", size));
        let rest = ("loading.traction.face", "a3-high");
        let results = [
            result("long", &[long, coarse], 20),
            result("long-atoms", &[long, fine], 900),
            result("short", &[short, coarse], 5),
            result("short-atoms", &[short, fine], 100),
            result("alone", &[short, coarse, rest], 5),
        ];
        let analysed = |result| Analysed {
            result,
            solid: result.solid.as_ref().expect("it is a solid"),
            findings: Findings::of(result.solid.as_ref().expect("it is a solid")),
            surfaces: Vec::new(),
        };
        let cases: Vec<Analysed> = results.iter().map(analysed).collect();
        let found = cases.iter().map(|case| reference(&cases, case).map(Analysed::name));
        let expected = ["long-atoms", "long-atoms", "short-atoms", "short-atoms"].map(Some);
        assert_eq!(found.collect::<Vec<_>>(), [&expected[..], &[None]].concat());
    }
}
