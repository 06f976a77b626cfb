//! A study's results as tables, figures and one page that says what came out and what it cost.

mod agreement;
mod beware;
mod chart;
mod figures;
mod film;
mod headline;
mod joined;
mod method;
mod numbers;
mod overview;
mod page;
mod palette;
mod picture;
mod quantity;
mod refined;
mod repeats;
mod resolution;
mod scaling;
mod side_by_side;
mod slab;
pub mod solid;
mod study;
mod sweep;
mod table;
mod tables;
mod units;
mod verdict;

pub use film::Film;
pub use joined::{Joined, Part};
pub use study::{CaseResult, Failure, Manifest, OtherStudy, Phase, Scaling, Specimen, Study};

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use crate::analysis::comparison::{self, Candidate, Difference};
use crate::analysis::{self, Findings};
use crate::durable;
use crate::record::RecordError;

/// What went wrong while a report was made.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    #[error(
        "cannot write {}: {source}; make room or the folder writable, then `cgaft study report` builds it again: \
         the runs that it shows are safe",
        path.display()
    )]
    Write { path: PathBuf, source: std::io::Error },
    #[error("cannot draw a picture: {0}")]
    Read(#[from] RecordError),
    #[error("cannot make table `{table}`: {reason}; this is a defect of the program, please report it")]
    Table { table: &'static str, reason: String },
    #[error("cannot draw figure `{figure}`: {reason}; this is a defect of the program, please report it")]
    Figure { figure: String, reason: String },
    #[error("cannot fill in the page: {0}; this is a defect of the program, please report it")]
    Page(#[from] minijinja::Error),
}

/// A case with everything extracted from it.
struct Analysed<'a> {
    result: &'a CaseResult,
    findings: Findings,
    /// Index of the case it is measured against, and how far it is from it.
    reference: Option<usize>,
    difference: Difference,
}

impl Analysed<'_> {
    fn name(&self) -> &str {
        &self.result.name
    }

    /// Its name as part of the name of a file.
    fn file_part(&self) -> String {
        let plain = |letter: char| letter.is_ascii_alphanumeric() || matches!(letter, '-' | '_' | '.');
        self.name()
            .chars()
            .map(|letter| if plain(letter) { letter } else { '-' })
            .collect()
    }

    /// Whether there is a crack to be followed; before the set-up of a case its choices tell.
    fn has_crack(&self) -> bool {
        match &self.result.setting {
            Some(setting) => setting.crack_row.is_some(),
            None => self.result.choices.iter().any(|(key, _)| key.starts_with("crack.")),
        }
    }

    /// nm/ps
    fn rayleigh_speed(&self) -> Option<f64> {
        self.result.setting.as_ref().map(|setting| setting.rayleigh_speed)
    }

    /// Whether bonds of nodes stood for all others, so that the moduli of the lattice are not those of the specimen.
    fn is_nodal(&self) -> bool {
        is_nodal(self.result)
    }

    fn peak_speed_over_rayleigh(&self) -> Option<f64> {
        Some(self.findings.peak_speed()? / self.rayleigh_speed()?)
    }

    /// Time that processors worked, s.
    fn core_seconds(&self) -> Option<f64> {
        self.result.core_seconds()
    }

    /// What a simulated picosecond costs, in seconds of one core.
    fn core_seconds_a_picosecond(&self) -> Option<f64> {
        let cost = self.core_seconds()? / self.result.series.probes.last()?.time;
        (cost.is_finite() && cost > 0.0).then_some(cost)
    }

    fn atom_steps_a_second(&self) -> Option<f64> {
        let atoms = self.result.setting.as_ref()?.represented_atoms;
        let wall = self.result.manifest.wall_seconds.filter(|&wall| wall > 0.0)?;
        Some(atoms as f64 * self.result.manifest.steps? as f64 / wall)
    }
}

/// Writes `report.html`, `report.md`, `tables/` and `figures/` into a folder. Equal inputs give equal bytes.
pub fn write(study: &Study, folder: &Path) -> Result<(), ReportError> {
    for part in ["tables", "figures"] {
        let path = folder.join(part);
        fs::create_dir_all(&path).map_err(|source| ReportError::Write { path, source })?;
    }
    remove_old(folder)?;
    match study.cases.iter().any(|case| case.solid.is_some()) {
        true => solid::write(study, folder),
        false => write_slabs(study, folder),
    }
}

fn write_slabs(study: &Study, folder: &Path) -> Result<(), ReportError> {
    let cases = analysed(&study.cases);
    let others: Vec<Vec<Analysed>> = study.others.iter().map(|other| analysed(&other.cases)).collect();
    let panels = side_by_side::panels(study, &cases, &others);
    let scaling = scaling::findings(study);
    let mut tables = tables::all(&cases, &study.comparisons, &panels, scaling.as_ref())?;
    for table in &mut tables {
        table.write(&folder.join("tables"))?;
    }
    let mut charts = scaling.as_ref().map(scaling::charts).unwrap_or_default();
    charts.extend(figures::charts(&cases, &study.comparisons));
    let mut drawn = Vec::new();
    for chart in &charts {
        let svg = chart.draw(study.figure_width)?;
        save(
            &folder.join("figures").join(format!("{}.svg", chart.id)),
            svg.standalone.as_bytes(),
        )?;
        drawn.push(svg);
    }
    let galleries = picture::draw_all(&cases, study.stages.as_ref(), &folder.join("figures"))?;
    let page = page::Page {
        study,
        cases: &cases,
        scaling: scaling.as_ref(),
        tables: &tables,
        charts: &charts,
        drawn: &drawn,
        galleries: &galleries,
        panels: &panels,
    };
    save(&folder.join("report.html"), page.html()?.as_bytes())?;
    save(&folder.join("report.md"), page.markdown()?.as_bytes())
}

fn analysed(cases: &[CaseResult]) -> Vec<Analysed<'_>> {
    let findings: Vec<Findings> = cases
        .par_iter()
        .map(|case| {
            let findings = case.setting.as_ref();
            let mut findings = findings
                .map(|setting| analysis::analyse(&case.series, setting))
                .unwrap_or_default();
            if is_nodal(case) {
                findings.griffith = None;
            }
            findings
        })
        .collect();
    let conditions: Vec<String> = cases.iter().map(conditions).collect();
    let parts = cases.iter().zip(&findings).zip(&conditions);
    let candidates: Vec<Option<Candidate>> = parts
        .map(|((case, findings), conditions)| candidate(case, findings, conditions))
        .collect();
    let references = comparison::references(&candidates);
    let differences: Vec<Difference> = (0..candidates.len())
        .map(|index| {
            let group = references[index]?;
            let earliest = comparison::earliest_initiation(&candidates, &references, group);
            (group != index).then_some(())?;
            Some(comparison::difference(candidates[index]?, candidates[group]?, earliest))
        })
        .map(Option::unwrap_or_default)
        .collect();
    drop(candidates);
    let parts = cases.iter().zip(findings).zip(references).zip(differences);
    parts
        .map(|(((result, findings), reference), difference)| Analysed {
            result,
            findings,
            reference,
            difference,
        })
        .collect()
}

fn is_nodal(case: &CaseResult) -> bool {
    let chosen = case.choices.iter().find(|(key, _)| key == "run.summation");
    chosen.is_some_and(|(_, value)| value == "nodal")
}

/// A case takes part in the comparison when it ran to its end.
fn candidate<'a>(case: &'a CaseResult, findings: &'a Findings, conditions: &'a str) -> Option<Candidate<'a>> {
    let usable = case.failure.is_none() && !case.series.probes.is_empty();
    let setting = case.setting.as_ref().filter(|_| usable)?;
    Some(Candidate {
        series: &case.series,
        setting,
        findings,
        conditions,
    })
}

/// How a specimen is held and set in motion, which its sizes and constants do not tell.
fn conditions(case: &CaseResult) -> String {
    const KEYS: [&str; 8] = [
        "specimen.grips",
        "loading.strain-rate.mode",
        "loading.strain-rate.ramp",
        "loading.strain-rate.sponge",
        "loading.strain-rate.damping",
        "run.relax.strain",
        "run.noise.amplitude",
        "run.noise.seed",
    ];
    let chosen = case.choices.iter().filter(|(key, _)| KEYS.contains(&key.as_str()));
    chosen.map(|(key, value)| format!("{key}: {value}\n")).collect()
}

/// Removes what an earlier report of more cases may have left and this one does not write again.
fn remove_old(folder: &Path) -> Result<(), ReportError> {
    let failed = |path: &Path, source| ReportError::Write {
        path: path.to_owned(),
        source,
    };
    let figures = folder.join("figures");
    for entry in fs::read_dir(&figures).map_err(|source| failed(&figures, source))? {
        let path = entry.map_err(|source| failed(&figures, source))?.path();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if figures::is_of_a_report(name) || solid::is_of_a_report(name) || picture::is_of_a_report(name) {
            fs::remove_file(&path).map_err(|source| failed(&path, source))?;
        }
    }
    let optional = [
        "arrivals.csv",
        "arrivals.parquet",
        "cheapest_choice.csv",
        "cheapest_choice.parquet",
        "speed_against_error.csv",
        "speed_against_error.parquet",
        "comparison.csv",
        "comparison.parquet",
        "side_by_side.csv",
        "side_by_side.parquet",
        "repeats.csv",
        "repeats.parquet",
        "together.csv",
        "together.parquet",
    ];
    for table in optional.map(|file| folder.join("tables").join(file)) {
        match fs::remove_file(&table) {
            Err(source) if source.kind() != ErrorKind::NotFound => return Err(failed(&table, source)),
            _ => (),
        }
    }
    Ok(())
}

fn save(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    durable::write(path, bytes).map_err(|source| ReportError::Write {
        path: path.to_owned(),
        source,
    })
}
