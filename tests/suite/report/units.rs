//! Numbers of tables in their units: what is put in is known, and what must come out.

use cgaft::report::{CaseResult, Study};

use super::{finished, text, three_meshes, written};
use crate::suite::synthetic::{SPACING, breaks, series, setting, straight};

/// Nine digits are written.
const DIGITS: f64 = 1e-6;

/// A crack at two spacings a ps from 50 ps on, in a slab that is strained by 1e-4 a ps.
fn steady() -> CaseResult {
    let pieces = straight(99.0, 240.0);
    let pieces = pieces.chunks(4).zip(50..);
    let bonds = pieces.flat_map(|(piece, probe)| breaks(piece, probe)).collect();
    CaseResult {
        series: series(120, bonds, &setting()),
        setting: Some(setting()),
        ..finished("steady", 1, 60_000, 0.01, 1.0)
    }
}

/// The numbers of a column.
fn column(table: &str, name: &str) -> Vec<Option<f64>> {
    let mut lines = table.lines();
    let place = lines
        .next()
        .unwrap()
        .split(',')
        .position(|column| column == name)
        .unwrap();
    lines
        .map(|line| line.split(',').nth(place).unwrap().parse().ok())
        .collect()
}

#[test]
fn speeds_are_told_in_metres_a_second_and_stresses_in_gigapascals() {
    let study = Study {
        cases: vec![steady()],
        ..three_meshes()
    };
    let folder = written(&study);
    let speeds = text(&folder, "tables/crack_speed.csv");
    // 2 spacings of 0.255586 nm a ps, 1000 m/s each nm/ps.
    let metres: Vec<f64> = column(&speeds, "speed_m_per_s").into_iter().flatten().collect();
    assert!(metres.len() > 50);
    assert!(
        metres
            .iter()
            .all(|speed| (speed / (2000.0 * SPACING) - 1.0).abs() < DIGITS),
        "{metres:?}"
    );
    let shares: Vec<f64> = column(&speeds, "speed_over_c_r").into_iter().flatten().collect();
    assert!(
        shares
            .iter()
            .all(|share| (share / (2.0 * SPACING / 1.0675) - 1.0).abs() < DIGITS),
        "{shares:?}"
    );
    let stresses = text(&folder, "tables/stress_strain.csv");
    // E strain in GPa: 65.987 epsilon/sigma^2 over the thickness, 1 eV/nm^3 = 0.1602176634 GPa. [CODATA 2018]
    let young = 65.987 * 0.415 / (0.2277 * 0.2277) / 0.2087 * 0.160_217_663_4;
    let strains = column(&stresses, "strain");
    for (strain, stress) in strains.iter().zip(column(&stresses, "sigma_yy_gpa")).skip(1) {
        let (strain, stress) = (strain.unwrap(), stress.unwrap());
        assert!((stress / (young * strain) - 1.0).abs() < DIGITS, "{strain}: {stress}");
    }
}

#[test]
fn a_crack_that_joins_one_ahead_has_a_row_of_its_own() {
    let mut case = steady();
    // What has opened from 200 to 230 spacings is joined when the crack opens the spacing before it.
    case.series.bonds.splice(..0, breaks(&straight(200.0, 230.0), 20));
    let study = Study {
        cases: vec![case],
        ..three_meshes()
    };
    let joins = text(&written(&study), "tables/joins.csv");
    let mut lines = joins.lines();
    assert_eq!(
        lines.next(),
        Some("case,time_ps,strain,x_nm,y_nm,to_x_nm,to_y_nm,gap_nm")
    );
    assert_eq!(lines.count(), 1, "{joins}");
    let gap = column(&joins, "gap_nm")[0].unwrap();
    assert!((gap / SPACING - 1.0).abs() <= 0.5 + DIGITS, "{gap}");
    assert_eq!(column(&joins, "time_ps"), [Some(100.0)]);
}
