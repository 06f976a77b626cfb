//! Base, cases and sweep multiplied out.

use super::draft::Draft;
use super::{name, repeats, sweep};
use crate::study::{CaseFile, Finding, Findings, Given, Overlay, Place, StudyFile};

/// Name of the only case of a study that names none.
const ONLY: &str = "base";
/// Cases of one study; more than this is a slip in a range.
const MOST_CASES: usize = 10_000;

/// All cases in the order of the file; of the sweep, the last line varies fastest.
pub fn expand(content: &StudyFile, findings: &Findings) -> Vec<Draft> {
    let axes = match &content.sweep {
        Given::Right(sweep, _) => sweep::axes(sweep, findings),
        _ => Vec::new(),
    };
    let starts = starts(content, findings);
    let number = axes
        .iter()
        .fold(starts.len(), |number, axis| number.saturating_mul(axis.points.len()));
    let repeats = content.repeats.right().and_then(|repeats| repeats.count.right());
    let number = number.saturating_mul(repeats.map_or(1, |&count| count as usize));
    if number > MOST_CASES {
        let message = format!("this study has {number} cases; at most {MOST_CASES} fit into a study");
        findings.add(
            Finding::at(content.sweep.place().unwrap_or_default(), message)
                .help("shorten a list, widen a step, or repeat less often"),
        );
        return starts;
    }
    let mut drafts = starts;
    for (position, axis) in axes.iter().enumerate() {
        // A study without named cases is named by its sweep alone.
        let named = content.cases.right().is_some() || position > 0;
        drafts = drafts
            .iter()
            .flat_map(|draft| axis.points.iter().map(move |point| varied(draft, point, named)))
            .collect();
    }
    repeats::repeated(drafts, &content.repeats, findings)
}

fn varied(draft: &Draft, point: &sweep::Point, named: bool) -> Draft {
    let mut values = draft.values.clone();
    for change in &point.changes {
        values.overlay(change);
    }
    let name = if named {
        format!("{}-{}", draft.name, point.name)
    } else {
        point.name.clone()
    };
    Draft {
        name,
        origin: draft.origin.clone(),
        place: point.place,
        values,
        swept: draft.swept.iter().chain(&point.swept).cloned().collect(),
        repeat_of: None,
    }
}

/// The base with each case laid over it.
fn starts(content: &StudyFile, findings: &Findings) -> Vec<Draft> {
    match &content.cases {
        Given::Absent => vec![Draft {
            name: ONLY.into(),
            origin: ONLY.into(),
            place: Place::default(),
            values: content.base.clone(),
            swept: Vec::new(),
            repeat_of: None,
        }],
        Given::Wrong(_) => Vec::new(),
        Given::Right(cases, place) => {
            if cases.0.is_empty() {
                findings.add(Finding::at(*place, "there are no cases").help("write `A: {}` for the base as it is"));
            }
            let draft = |(case, change): &(crate::study::Name, Given<CaseFile>)| {
                name::check(&case.text, case.place, "case", findings);
                let mut values = content.base.clone();
                values.overlay(change);
                Draft {
                    name: case.text.clone(),
                    origin: case.text.clone(),
                    place: case.place,
                    values,
                    swept: Vec::new(),
                    repeat_of: None,
                }
            };
            cases.0.iter().map(draft).collect()
        }
    }
}
