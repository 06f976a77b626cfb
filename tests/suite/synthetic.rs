//! Made-up but physical runs: a slab of nearest-neighbour Lennard-Jones atoms with a crack that goes where it is told.

use cgaft::analysis::series::{BondEvent, Probe, Series, Setting};

pub const SPACING: f64 = 0.2277 * 1.122_462_048_309_373;

/// 400 spacings long, 150 rows high, a crack of 100 spacings between rows 74 and 75.
pub fn setting() -> Setting {
    Setting {
        spacing: SPACING,
        length: 400.0 * SPACING,
        left_x: 40.0 * SPACING,
        height: 130.0 * SPACING,
        crack_row: Some(75),
        crack_length: 100.0 * SPACING,
        strain_rate: 1e-4,
        thickness: 0.2087,
        longitudinal_speed: 2.011,
        transverse_speed: 1.161,
        rayleigh_speed: 1.0675,
        young_modulus: 65.987 * 0.415 / (0.2277 * 0.2277),
        poisson_ratio: 1.0 / 3.0,
        fracture_energy: 1.7818 * 0.415 / 0.2277,
        element_at_crack: 1,
        nodes: 60_000,
        elements: 60_000,
        represented_atoms: 60_000,
    }
}

/// Lattice column at which row 74 has x nearest to this many spacings from the left edge.
fn column(spacings: f64) -> i32 {
    (40.0 + spacings - 37.0).round() as i32
}

/// The bonds across the crack plane from `from` to `to` spacings right of the left edge, left to right.
pub fn straight(from: f64, to: f64) -> Vec<[i32; 3]> {
    (column(from)..column(to))
        .flat_map(|column| [[column, 74, 2], [column, 74, 1]])
        .collect()
}

/// The bonds opened by a crack that leaves the crack plane `from` spacings right of the left edge and runs
/// `rows` rows upwards at 60 degrees: between lattice columns.
pub fn kinked(from: f64, rows: i32) -> Vec<[i32; 3]> {
    let column = column(from) - 2;
    (75..75 + rows)
        .flat_map(|row| [[column, row, 0], [column + 1, row, 2]])
        .collect()
}

/// Bonds that break at one probe.
pub fn breaks(bonds: &[[i32; 3]], probe: u32) -> Vec<BondEvent> {
    let event = |&[column, row, direction]: &[i32; 3]| BondEvent {
        probe,
        column,
        row,
        direction: direction as u8,
        broken: true,
    };
    bonds.iter().map(event).collect()
}

/// Probes 1 ps apart under a constant strain rate, with nothing in them but time, strain and a linear stress.
pub fn probes(count: usize, setting: &Setting) -> Vec<Probe> {
    let modulus = setting.young_modulus / setting.thickness;
    let row = |index: usize| {
        let strain = setting.strain_rate * index as f64;
        Probe {
            step: 10 * index as u64,
            time: index as f64,
            strain,
            sigma_yy: modulus * strain,
            ..Probe::default()
        }
    };
    (0..count).map(row).collect()
}

/// A series with the given bond events and bare probes.
pub fn series(count: usize, bonds: Vec<BondEvent>, setting: &Setting) -> Series {
    Series {
        probes: probes(count, setting),
        bonds,
        ..Series::default()
    }
}
