//! Where the study agrees with what it is compared with, and where not: computed sentences.

use super::Analysed;
use super::table::Table;
use super::tables::{comparison, first_branch, k_ic, wave_arrival};
use crate::plan::Comparison;

/// A topic and what is found.
pub fn notes(cases: &[Analysed], comparisons: &[Comparison], tables: &[Table]) -> Vec<(&'static str, String)> {
    if comparisons.is_empty() {
        return Vec::new();
    }
    [
        ("Counts", counts(comparisons, tables)),
        ("Stress intensity", k_ic::agreement(cases, comparisons)),
        ("First branch", first_branch::agreement(cases, comparisons)),
        ("Leaving the plane", first_branch::leaving_the_plane(cases, comparisons)),
        ("Waves before the first branch", first_branch::waves(cases)),
        ("Arrivals", wave_arrival::agreement(cases, comparisons)),
        ("Arrivals not measured", wave_arrival::not_measured(cases)),
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
