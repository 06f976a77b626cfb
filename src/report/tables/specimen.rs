//! Specimens as asked for and as laid out, and cases that are one computation under several names.

use polars::prelude::Column;

use crate::report::numbers::significant;
use crate::report::study::Specimen;
use crate::report::table::Rows;
use crate::report::units::{METRE_PER_SECOND, PERCENT};
use crate::report::{Analysed, CaseResult};

/// Differences from what was asked for beyond this share are told.
const NOTABLE: f64 = 0.01;

/// The columns of the table of specimens.
pub fn columns(cases: &[Analysed]) -> Vec<Column> {
    let known = cases
        .iter()
        .filter_map(|case| Some((case, case.result.specimen.as_ref()?)));
    let rows = Rows(known.collect::<Vec<(&Analysed, &Specimen)>>());
    let places: Vec<String> = rows
        .0
        .iter()
        .map(|(_, specimen)| specimen.leftover_where.join(", "))
        .collect();
    let where_left: Vec<Option<&str>> = places
        .iter()
        .map(|text| Some(text.as_str()).filter(|text| !text.is_empty()))
        .collect();
    vec![
        rows.text("case", |row| row.0.name()),
        rows.number("length_asked_nm", |row| row.1.length[0]),
        rows.number("length_nm", |row| row.1.length[1]),
        rows.number("width_asked_nm", |row| row.1.width[0]),
        rows.number("width_nm", |row| row.1.width[1]),
        rows.number("height_between_grips_asked_nm", |row| row.1.height_between_grips[0]),
        rows.number("height_between_grips_nm", |row| row.1.height_between_grips[1]),
        rows.number("crack_asked_nm", |row| row.1.crack.map(|crack| crack[0])),
        rows.number("crack_nm", |row| row.1.crack.map(|crack| crack[1])),
        rows.word("notch_end", |row| row.1.notch_end),
        rows.number("grip_thickness_nm", |row| row.1.grip_thickness),
        rows.number("grip_speed_m_per_s", |row| row.1.grip_speed * METRE_PER_SECOND),
        rows.number("leftover_share", |row| row.1.leftover_share),
        Column::new("leftover_where".into(), where_left),
    ]
}

/// Whether two cases are one computation, so that nothing can differ between them, neither results nor pace.
pub fn are_one_computation(case: &CaseResult, other: &CaseResult) -> bool {
    let crew = |case: &CaseResult| [case.manifest.ranks, case.manifest.threads];
    let computation = |case: &CaseResult| case.specimen.as_ref().map(|specimen| specimen.computation);
    // Those of a study of ranks differ in what computes them, which is in their ids.
    let is_of_ranks = case.digest.is_some() && crew(case) != crew(other);
    computation(case).is_some() && computation(case) == computation(other) && !is_of_ranks
}

/// More cases than this with one specimen are counted.
const MOST_NAMED: usize = 4;

/// Cases that are one computation, each with the first of its kind, and sizes that are not what was asked for.
pub fn notes(cases: &[Analysed]) -> Vec<(&'static str, String)> {
    let mut notes = Vec::new();
    let same: Vec<String> = cases
        .iter()
        .enumerate()
        .filter_map(|(index, case)| {
            let first = cases[..index]
                .iter()
                .find(|other| are_one_computation(other.result, case.result))?;
            Some(format!("{} is {}", case.name(), first.name()))
        })
        .collect();
    if !same.is_empty() {
        let text = format!(
            "{}: mesh, notch and loading are the same, and no difference between them says anything.",
            same.join(", ")
        );
        notes.push(("One computation under several names", text));
    }
    let mut off: Vec<(String, Vec<&str>)> = Vec::new();
    for case in cases {
        let Some(told) = unlike_asked(case) else { continue };
        match off.iter_mut().find(|(known, _)| *known == told) {
            Some((_, names)) => names.push(case.name()),
            None => off.push((told, vec![case.name()])),
        }
    }
    let of = |(told, names): &(String, Vec<&str>)| match names.len() {
        number if number == cases.len() && number > 1 => format!("in all cases {told}"),
        number if number > MOST_NAMED => format!("in {number} cases, {} among them, {told}", names[0]),
        _ => format!("in {} {told}", names.join(", ")),
    };
    let off: Vec<String> = off.iter().map(of).collect();
    if !off.is_empty() {
        let text = format!(
            "Laid out of whole elements, {}. All sizes are in table specimen.",
            off.join("; ")
        );
        notes.push(("Specimens that are not what was asked for", text));
    }
    notes
}

/// `the length is 112.5 nm instead of 114 nm`
fn unlike_asked(case: &Analysed) -> Option<String> {
    let specimen = case.result.specimen.as_ref()?;
    let mut sizes = vec![
        ("length", specimen.length),
        ("width", specimen.width),
        ("height between the grips", specimen.height_between_grips),
    ];
    sizes.extend(specimen.crack.map(|crack| ("crack", crack)));
    let off = sizes
        .into_iter()
        .filter(|(_, [asked, actual])| (actual / asked - 1.0).abs() > NOTABLE);
    let told: Vec<String> = off
        .map(|(name, [asked, actual])| {
            let percent = significant(PERCENT * (actual / asked - 1.0).abs(), 2);
            let [asked, actual] = [asked, actual].map(|size| significant(size, 4));
            format!("the {name} is {actual} nm instead of {asked} nm ({percent} % off)")
        })
        .collect();
    (!told.is_empty()).then(|| told.join(" and "))
}
