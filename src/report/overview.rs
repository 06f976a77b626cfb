//! The cases side by side: what differs, what it costs, what came out, how far from the finest.

use super::numbers::{ABSENT, count, signed_percent, significant};
use super::refined::is_refined;
use super::tables::specimen::are_one_computation;
use super::units::{MEGAPASCAL_ROOT_METRE, PERCENT};
use super::{Analysed, CaseResult, sweep};
use crate::analysis::stress_intensity::{FromJ, NearTip};
use crate::plan::Swept;
use crate::units::amounts::duration;

/// So that a difference of just one probe counts as one, however it was rounded.
pub const ROUNDING: f64 = 1.0 + 1e-6;

/// No stress intensity is known to more decimals, MPa √m.
const MOST_DECIMALS: i32 = 3;

/// Stands where a case is measured against itself.
const REFERENCE: &str = "reference";

/// The group that tells what a sweep varies already.
const DIFFERS: &str = "What differs";

/// Rows that belong together; one cell per case.
pub struct Group {
    pub title: &'static str,
    pub rows: Vec<Row>,
}

pub struct Row {
    pub label: String,
    pub cells: Vec<String>,
}

/// The comparison, in the order in which it is read.
pub fn groups(cases: &[Analysed]) -> Vec<Group> {
    let mut groups = vec![
        Group {
            title: DIFFERS,
            rows: differing(&cases.iter().map(|case| case.result).collect::<Vec<_>>()),
        },
        Group {
            title: "What it costs",
            rows: costs(cases),
        },
        Group {
            title: "What comes out",
            rows: results(cases),
        },
        Group {
            title: "How far from the case with the most nodes",
            rows: distances(cases),
        },
        Group {
            title: "Where the energy goes",
            rows: energies(cases),
        },
    ];
    let says_something = |row: &Row| row.cells.iter().any(|cell| cell != ABSENT && cell != REFERENCE);
    for group in &mut groups {
        group.rows.retain(says_something);
    }
    groups.retain(|group| !group.rows.is_empty());
    groups
}

/// The same where each group is a table of its own, which begins with what a sweep varies.
pub fn tables(cases: &[Analysed]) -> Vec<Group> {
    let mut groups = groups(cases);
    for group in groups.iter_mut().filter(|group| group.title != DIFFERS) {
        group
            .rows
            .splice(0..0, swept(&cases.iter().map(|case| case.result).collect::<Vec<_>>()));
    }
    groups
}

/// What a sweep has set, as numbers with their unit at the head.
fn swept(cases: &[&CaseResult]) -> Vec<Row> {
    let first = cases.iter().find(|case| !case.swept.is_empty());
    let keys = first.into_iter().flat_map(|case| case.swept.iter().enumerate());
    let cell = |case: &&CaseResult, index: usize| case.swept.get(index).map_or_else(|| ABSENT.to_owned(), sweep::shown);
    let row = |(index, key): (usize, &Swept)| Row {
        label: key.heading(),
        cells: cases.iter().map(|case| cell(case, index)).collect(),
    };
    keys.map(row).collect()
}

/// Strain between the probes at which two cracks start, over the strain of the second: what cannot be told apart.
pub fn between_probes(case: &Analysed, reference: &Analysed) -> Option<f64> {
    let gap = |case: &Analysed| {
        let start = case.findings.initiation?;
        let before = case.result.series.probes.get(start.probe.checked_sub(1)?)?;
        Some(start.strain - before.strain)
    };
    Some(gap(case)?.max(gap(reference)?) / reference.findings.initiation?.strain)
}

/// What one probe is of the earliest wave that a case has measured.
pub fn between_arrivals(case: &Analysed) -> Option<f64> {
    let earliest = case.findings.arrivals.iter().filter_map(|arrival| arrival.measured);
    let [first, second] = case.result.series.probes.first_chunk()?;
    Some((second.time - first.time) / earliest.min_by(f64::total_cmp)?)
}

/// The choices that are not the same in all cases.
pub fn differing(cases: &[&CaseResult]) -> Vec<Row> {
    let mut keys: Vec<&str> = Vec::new();
    for (key, _) in cases.iter().flat_map(|case| &case.choices) {
        if !keys.contains(&key.as_str()) {
            keys.push(key);
        }
    }
    // A choice may be a word in one case and have parts in another, which then are told in its row.
    let is_part = |key: &str| keys.iter().any(|whole| part_of(key, whole).is_some());
    let row = |key: &str| Row {
        label: key.to_owned(),
        cells: cases
            .iter()
            .map(|case| choice(case, key).unwrap_or_else(|| ABSENT.to_owned()))
            .collect(),
    };
    // A case that failed before its choices were known says nothing about them.
    let known: Vec<bool> = cases.iter().map(|case| !case.choices.is_empty()).collect();
    let varies = |row: &Row| {
        let mut cells = row
            .cells
            .iter()
            .zip(&known)
            .filter(|(_, known)| **known)
            .map(|(cell, _)| cell);
        let first = cells.next();
        cells.any(|cell| Some(cell) != first)
    };
    let mut rows = swept(cases);
    let is_swept = |key: &str| {
        let paths = cases
            .iter()
            .flat_map(|case| &case.swept)
            .map(|swept| swept.path.as_str());
        paths
            .into_iter()
            .any(|path| path == key || part_of(key, path).is_some())
    };
    let whole = keys.iter().filter(|key| !is_part(key) && !is_swept(key));
    rows.extend(whole.map(|key| row(key)).filter(varies));
    rows
}

/// A choice in words, that of its parts where it has some: `gauss 2`.
fn choice(case: &CaseResult, key: &str) -> Option<String> {
    if let Some((_, value)) = case.choices.iter().find(|choice| choice.0 == key) {
        return Some(value.clone());
    }
    let parts = case
        .choices
        .iter()
        .filter_map(|(inner, value)| Some(format!("{} {value}", part_of(inner, key)?.replace('.', " "))));
    let parts: Vec<String> = parts.collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// What a key adds to that of a whole.
fn part_of<'a>(key: &'a str, whole: &str) -> Option<&'a str> {
    key.strip_prefix(whole)?.strip_prefix('.')
}

fn row(cases: &[Analysed], label: &str, cell: impl Fn(&Analysed) -> Option<String>) -> Row {
    let cells = cases
        .iter()
        .map(|case| cell(case).unwrap_or_else(|| ABSENT.to_owned()))
        .collect();
    Row {
        label: label.to_owned(),
        cells,
    }
}

fn costs(cases: &[Analysed]) -> Vec<Row> {
    let setting = |case: &Analysed| case.result.setting.clone();
    let manifest = |case: &Analysed| case.result.manifest.clone();
    vec![
        row(cases, "nodes", |case| Some(count(setting(case)?.nodes))),
        row(cases, "atoms represented", |case| {
            Some(count(setting(case)?.represented_atoms))
        }),
        row(cases, "time step (ps)", |case| {
            Some(significant(manifest(case).time_step?, 3))
        }),
        row(cases, "steps", |case| Some(count(manifest(case).steps?))),
        row(cases, "wall time", |case| Some(duration(manifest(case).wall_seconds?))),
        row(cases, "core-seconds", |case| Some(significant(case.core_seconds()?, 3))),
        row(cases, "memory (MB)", |case| {
            Some(significant(manifest(case).peak_memory? * 1e-6, 3))
        }),
        row(cases, "million atom-steps per second", |case| {
            Some(significant(case.atom_steps_a_second()? / 1e6, 3))
        }),
    ]
}

fn results(cases: &[Analysed]) -> Vec<Row> {
    let root_metre = |value: f64| significant(value * MEGAPASCAL_ROOT_METRE, 3);
    vec![
        row(cases, "first bond breaks at strain (%)", |case| {
            Some(significant(case.findings.first_bond?.strain * PERCENT, 3))
        }),
        row(cases, "crack starts at strain (%)", |case| {
            Some(significant(case.findings.initiation?.strain * PERCENT, 3))
        }),
        row(cases, "highest speed / c_R", |case| {
            Some(significant(case.peak_speed_over_rayleigh()?, 3))
        }),
        row(cases, "share of the moving time that has a speed (%)", |case| {
            Some(significant(case.findings.speed_share? * PERCENT, 2))
        }),
        row(cases, "leaves the plane at strain (%)", |case| {
            Some(significant(case.findings.leaves_plane?.strain * PERCENT, 3))
        }),
        row(cases, "first branch at strain (%)", |case| {
            Some(significant(case.findings.first_branch()?.strain * PERCENT, 3))
        }),
        row(
            cases,
            "K at initiation, near tip, ± standard error of the fit (MPa √m)",
            |case| {
                let refused = case.findings.near_tip_refused.map(|reason| format!("none: {reason}"));
                let told = |fit: NearTip| with_error(fit.value, fit.error);
                case.findings.near_tip.map(told).or(refused)
            },
        ),
        row(
            cases,
            "K at initiation, J-integral, in brackets the agreement of its rings (MPa √m)",
            |case| {
                let refused = case.findings.from_j_refused.map(|reason| format!("none: {reason}"));
                let told = |j: FromJ| {
                    let agreement = significant(j.spread / j.value * PERCENT, 1);
                    format!("{} (rings agree to {agreement} %)", root_metre(j.value))
                };
                case.findings.from_j.map(told).or(refused)
            },
        ),
        row(cases, "K of Griffith (MPa √m)", |case| {
            Some(root_metre(case.findings.griffith?))
        }),
    ]
}

/// A stress intensity in MPa √m and its error with two digits; the value has as many decimals.
fn with_error(value: f64, error: f64) -> String {
    let [value, error] = [value, error].map(|intensity| intensity * MEGAPASCAL_ROOT_METRE);
    let decimals = (1 - error.log10().floor() as i32).clamp(0, MOST_DECIMALS) as usize;
    format!("{value:.decimals$} ± {error:.decimals$}")
}

fn distances(cases: &[Analysed]) -> Vec<Row> {
    let own = |case: &Analysed| case.reference.is_some_and(|index| std::ptr::eq(case, &cases[index]));
    let or_reference =
        |case: &Analysed, text: Option<String>| if own(case) { Some(REFERENCE.to_owned()) } else { text };
    let later = |case: &Analysed| {
        let share = case.difference.initiation_strain?;
        let gap = between_probes(case, &cases[case.reference?])?;
        Some(if share.abs() <= ROUNDING * gap {
            format!("none within a probe ({} %)", significant(gap * PERCENT, 2))
        } else {
            signed_percent(share)
        })
    };
    let misfit = |value: Option<f64>| value.map(|share| format!("{} %", significant(share * PERCENT, 2)));
    vec![
        row(cases, "strain at initiation", |case| or_reference(case, later(case))),
        row(cases, "stress before initiation, at most", |case| {
            or_reference(case, misfit(case.difference.stress))
        }),
        row(cases, "crack speed, mean", |case| {
            or_reference(case, misfit(case.difference.speed))
        }),
        row(cases, "arrival of waves, at most", |case| {
            let resolved = case.reference.and_then(|index| between_arrivals(&cases[index]));
            let text = case.difference.arrival.map(|share| match resolved {
                Some(gap) if share <= ROUNDING * gap => {
                    format!("none within a probe ({} %)", significant(gap * PERCENT, 2))
                }
                _ => format!("{} %", significant(share * PERCENT, 2)),
            });
            or_reference(case, text)
        }),
        row(cases, "K at initiation, J-integral", |case| {
            or_reference(case, case.difference.stress_intensity.map(signed_percent))
        }),
        row(cases, "times fewer core-seconds per simulated ps", |case| {
            or_reference(case, times_faster(case, cases))
        }),
    ]
}

/// What of the work is neither stored nor motion.
fn energies(cases: &[Analysed]) -> Vec<Row> {
    vec![
        row(cases, "released at the cutoff (of the work)", |case| {
            let last = case.result.series.probes.last().filter(|last| last.work > 0.0)?;
            Some(format!(
                "{} %",
                significant(PERCENT * last.cutoff_release / last.work, 2)
            ))
        }),
        row(cases, "gained where elements became atoms (of the work)", |case| {
            let last = case
                .result
                .series
                .probes
                .last()
                .filter(|last| last.work > 0.0 && is_refined(case))?;
            Some(format!(
                "{} %",
                significant(PERCENT * last.refined_energy / last.work, 2)
            ))
        }),
        row(cases, "energy error (of the work)", |case| {
            let share = case.result.manifest.energy_error?;
            Some(format!("{} %", significant(share * PERCENT, 2)))
        }),
    ]
}

fn times_faster(case: &Analysed, cases: &[Analysed]) -> Option<String> {
    let reference = &cases[case.reference?];
    if are_one_computation(case.result, reference.result) {
        return None;
    }
    let reference = reference.core_seconds_a_picosecond()?;
    Some(significant(reference / case.core_seconds_a_picosecond()?, 2))
}
