//! Where the study agrees with what it is compared with, and where not: computed sentences.

use super::Analysed;
use super::numbers::{signed_percent, significant};
use super::table::Table;
use super::tables::k_ic::{self, Definition};
use super::tables::{comparison, first_branch, wave_arrival};
use crate::plan::{self, Comparison};

/// A topic and what is found.
pub fn notes(cases: &[Analysed], comparisons: &[Comparison], tables: &[Table]) -> Vec<(&'static str, String)> {
    if comparisons.is_empty() {
        return Vec::new();
    }
    [
        ("Counts", counts(comparisons, tables)),
        ("Stress intensity", stress_intensity(cases, comparisons)),
        ("First branch", first_branch(cases, comparisons)),
        ("Leaving the plane", leaving_the_plane(cases, comparisons)),
        ("Waves before the first branch", waves(cases)),
        ("Arrivals", arrivals(cases, comparisons)),
        ("Arrivals not measured", not_measured(cases)),
    ]
    .into_iter()
    .filter_map(|(topic, text)| Some((topic, text?)))
    .collect()
}

/// Whole numbers of nodes, elements and atoms must be the same.
fn counts(comparisons: &[Comparison], tables: &[Table]) -> Option<String> {
    const COUNTED: [&str; 3] = ["nodes", "elements", "represented_atoms"];
    let lines = comparisons
        .iter()
        .flat_map(|comparison| comparison::lines(comparison, tables));
    let lines: Vec<_> = lines.filter(|line| COUNTED.contains(&line.column)).collect();
    let computed: Vec<_> = lines.iter().filter(|line| line.measured.is_some()).collect();
    let equal = computed
        .iter()
        .filter(|line| line.measured == Some(line.reference))
        .count();
    (!computed.is_empty()).then(|| {
        format!(
            "{equal} of {} numbers of nodes, elements and atoms are those of the source.",
            computed.len()
        )
    })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Which definition of K comes nearest to the source's values.
fn stress_intensity(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    let offs = |definition: Definition| -> Vec<f64> {
        let pairs = cases
            .iter()
            .filter_map(|case| definition.value(case).zip(k_ic::reference(case, comparisons)));
        pairs.map(|(own, other)| own / other - 1.0).collect()
    };
    let mut found: Vec<(Definition, Vec<f64>)> = Definition::ALL
        .map(|definition| (definition, offs(definition)))
        .into_iter()
        .filter(|(_, offs)| !offs.is_empty())
        .collect();
    let size = |offs: &[f64]| mean(&offs.iter().map(|off| off.abs()).collect::<Vec<f64>>());
    found.sort_by(|a, b| size(&a.1).total_cmp(&size(&b.1)));
    let (nearest, others) = found.split_first()?;
    let others: Vec<String> = others
        .iter()
        .map(|(definition, offs)| format!("{} by {}", definition.words(), signed_percent(mean(offs))))
        .collect();
    let mut text = format!(
        "Nearest to the source comes {}, off by {} % on average ({} with sign).",
        nearest.0.words(),
        significant(100.0 * size(&nearest.1), 2),
        signed_percent(mean(&nearest.1))
    );
    if !others.is_empty() {
        text.push_str(&format!(" With sign and on average are off {}.", others.join(", ")));
    }
    text.extend(one_factor(cases, comparisons));
    Some(text)
}

/// Factors alike within this share are one factor.
const ONE_FACTOR: f64 = 0.03;

/// Whether one factor takes K near the tip to the source's value in all cases, as it does where only the definitions differ.
fn one_factor(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    let factor = |case| Some(k_ic::reference(case, comparisons)? / Definition::NearTip.value(case)?);
    let factors: Vec<f64> = cases.iter().filter_map(factor).collect();
    let mean = mean(&factors);
    let is_one = factors.len() > 2 && factors.iter().all(|factor| (factor / mean - 1.0).abs() < ONE_FACTOR);
    is_one.then(|| {
        format!(
            " The source's value is {} times that of the field near the tip in all {} cases, within {} %: the loads are the \
             same, and the definitions of K differ by a factor.",
            significant(mean, 3),
            factors.len(),
            significant(100.0 * ONE_FACTOR, 1)
        )
    })
}

fn first_branch(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    beside_the_pictures(
        cases,
        comparisons,
        first_branch::after_start,
        "no branch up to the end of the run",
    )
}

/// The source calls branching what it sees in its pictures, and a crack that turns aside looks alike there.
fn leaving_the_plane(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    beside_the_pictures(
        cases,
        comparisons,
        first_branch::leaves_after_start,
        "in its plane up to the end of the run",
    )
}

/// When something happens to each crack, ps after its start, beside the pictures between which the source saw it branch.
fn beside_the_pictures(
    cases: &[Analysed],
    comparisons: &[Comparison],
    after_start: impl Fn(&Analysed) -> Option<f64>,
    never: &str,
) -> Option<String> {
    let line = |case: &Analysed| {
        let [Some(from), Some(to)] = first_branch::reference(case, comparisons) else {
            return None;
        };
        case.findings.initiation?;
        let source = format!("the source between {from:.0} and {to:.0} ps");
        Some(match after_start(case) {
            Some(time) => {
                let order = match time {
                    _ if time < from => "earlier than",
                    _ if time > to => "later than",
                    _ => "as in",
                };
                let time = significant(time, 3);
                format!("{}: {time} ps after the crack starts, {order} {source}", case.name())
            }
            None => format!("{}: {never}; {source}", case.name()),
        })
    };
    let lines: Vec<String> = cases.iter().filter_map(line).collect();
    (!lines.is_empty()).then(|| format!("{}.", lines.join("; ")))
}

fn waves(cases: &[Analysed]) -> Option<String> {
    let line = |case: &Analysed| {
        first_branch::after_start(case)?;
        let waves = first_branch::waves_before(case);
        Some(match waves.is_empty() {
            true => format!("{}: none", case.name()),
            false => format!("{}: {}", case.name(), waves.join(", ")),
        })
    };
    let lines: Vec<String> = cases.iter().filter_map(line).collect();
    (!lines.is_empty()).then(|| {
        format!(
            "By their speeds and the path of the tip are back at it by then: {}.",
            lines.join("; ")
        )
    })
}

/// Why there may be no measured arrival.
fn not_measured(cases: &[Analysed]) -> Option<String> {
    let arrivals: Vec<_> = cases.iter().flat_map(|case| &case.findings.arrivals).collect();
    let missing = arrivals.iter().filter(|arrival| arrival.measured.is_none()).count();
    (missing > 0).then(|| {
        format!(
            "{missing} of {}: there no front stands out at the gauges from what the running crack sends past them, by the rule \
             under Method.",
            arrivals.len()
        )
    })
}

/// How far predicted and measured arrivals are from the source's.
fn arrivals(cases: &[Analysed], comparisons: &[Comparison]) -> Option<String> {
    let mut offs = [const { Vec::new() }; 3];
    for case in cases {
        for arrival in &case.findings.arrivals {
            let keys = [wave_arrival::wave_name(arrival), wave_arrival::path_name(arrival)];
            let Some(reference) = plan::reference(comparisons, "wave_arrival", "reference_ps", case.name(), &keys)
            else {
                continue;
            };
            offs[0].push(arrival.predicted / reference - 1.0);
            offs[1].extend(arrival.at_running_tip.map(|time| time / reference - 1.0));
            offs[2].extend(arrival.measured.map(|measured| measured / reference - 1.0));
        }
    }
    let largest = |offs: &[f64]| offs.iter().fold(0.0, |largest: f64, off| largest.max(off.abs()));
    let line = |kind: &str, offs: &[f64]| {
        format!(
            "{kind}: off the source's by {} on average and {} % at most, of {}",
            signed_percent(mean(offs)),
            significant(100.0 * largest(offs), 2),
            offs.len()
        )
    };
    let kinds = [
        "predicted at the end of the notch",
        "predicted at the running tip",
        "measured",
    ]
    .into_iter()
    .zip(&offs);
    let lines: Vec<String> = kinds
        .filter(|(_, offs)| !offs.is_empty())
        .map(|(kind, offs)| line(kind, offs))
        .collect();
    (!lines.is_empty()).then(|| format!("{}.", lines.join("; ")))
}
