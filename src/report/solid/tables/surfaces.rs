//! Tables of cracks and slip.

use polars::prelude::Column;

use crate::report::solid::Analysed;
use crate::report::solid::surfaces::{Kept, Surface, kept};
use crate::report::table::Rows;
use crate::report::units::METRE_PER_SECOND;

/// A row a picture.
pub fn surfaces(cases: &[Analysed]) -> Vec<Column> {
    let pictures = cases
        .iter()
        .flat_map(|case| case.surfaces.iter().map(move |surface| (case, surface)));
    let rows = Rows(pictures.collect::<Vec<_>>());
    type Row<'a> = (&'a Analysed<'a>, &'a Surface);
    let crack = |family: usize| move |row: &Row| row.1.areas.crack[family];
    let slip = |family: usize| move |row: &Row| row.1.areas.slip[family];
    let front = |part: usize| move |row: &Row| Some(row.1.front()?[part]);
    let count = |of: fn(&Surface) -> Option<u64>| move |row: &Row| of(row.1);
    vec![
        rows.text("case", |row| row.0.name()),
        rows.number("time_ps", |row| row.1.time),
        rows.number("strain", |row| row.1.strain),
        rows.number("crack_nm2", |row| row.1.crack()),
        rows.number("slip_nm2", |row| row.1.slip()),
        rows.number("open_elsewhere_nm2", |row| row.1.areas.elsewhere),
        rows.number("crack_on_a1_nm2", crack(0)),
        rows.number("crack_on_a2_nm2", crack(1)),
        rows.number("crack_on_a3_nm2", crack(2)),
        rows.number("crack_on_fourth_nm2", crack(3)),
        rows.number("slip_on_a1_nm2", slip(0)),
        rows.number("slip_on_a2_nm2", slip(1)),
        rows.number("slip_on_a3_nm2", slip(2)),
        rows.number("slip_on_fourth_nm2", slip(3)),
        rows.number("front_mean_nm", front(0)),
        rows.number("front_least_nm", front(1)),
        rows.number("front_most_nm", front(2)),
        rows.number("front_speed_m_per_s", |row| {
            row.1.speed.map(|speed| speed * METRE_PER_SECOND)
        }),
        rows.number("roughness_sides_nm", |row| row.1.roughness[0]),
        rows.number("roughness_middle_nm", |row| row.1.roughness[1]),
        rows.count("dislocated_atoms", count(|surface| Some(surface.atoms?.dislocated))),
        rows.count("exposed_atoms", count(|surface| Some(surface.atoms?.exposed))),
    ]
}

/// A row for each crack and each band of slip that keeps its direction.
pub fn directions(cases: &[Analysed]) -> Vec<Column> {
    let found = cases
        .iter()
        .flat_map(|case| kept(&case.surfaces).into_iter().map(move |kept| (case, kept)));
    let rows = Rows(found.collect::<Vec<_>>());
    let start = |part: usize| move |row: &(&Analysed, Kept)| Some(row.1.start?[part]);
    vec![
        rows.text("case", |row| row.0.name()),
        rows.text("what", |row| row.1.kind),
        rows.number("degrees", |row| row.1.degrees),
        rows.number("first_seen_ps", |row| row.1.time),
        rows.number("starts_ahead_nm", start(0)),
        rows.number("starts_above_nm", start(1)),
        rows.number("length_nm", |row| row.1.length),
        rows.number("speed_m_per_s", |row| row.1.speed.map(|speed| speed * METRE_PER_SECOND)),
    ]
}
