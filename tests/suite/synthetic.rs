//! Made-up but physical runs: a slab of nearest-neighbour Lennard-Jones atoms with a crack that goes where it is told.

use std::f64::consts::PI;

use cgaft::analysis::series::{BondEvent, CrackFrom, Probe, Series, Setting};
use cgaft::record::frames::{FieldMesh, Frame};

pub const SPACING: f64 = 0.2277 * 1.122_462_048_309_373;

/// 400 spacings long, 150 rows high, a crack of 100 spacings between rows 74 and 75.
pub fn setting() -> Setting {
    Setting {
        spacing: SPACING,
        length: 400.0 * SPACING,
        left_x: 40.0 * SPACING,
        height: 130.0 * SPACING,
        crack_row: Some(75),
        crack_from: CrackFrom::Left,
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

/// A made-up run to the end: the crack starts at `start` (strain), speeds up to 0.36 c_R and forks near its end.
///
/// Stresses follow Hooke's law before the start and fall with the ligament after it; energies add up but for a part
/// in ten thousand.
pub fn crack_run(setting: &Setting, start: f64, element: f64) -> Series {
    let (count, end) = (400, 0.028);
    let modulus = setting.young_modulus / setting.thickness;
    let volume = setting.length * setting.height * setting.thickness;
    let (mut bonds, mut ahead) = (Vec::new(), 0.0_f64);
    let mut way = straight(99.0, 330.0).into_iter();
    let mut side = kinked(170.0, 60).into_iter();
    let mut rows = Vec::new();
    let mut taken = 0;
    for index in 0..count {
        let strain = end * index as f64 / (count - 1) as f64;
        let time = strain / setting.strain_rate;
        let running = ((strain - start) / 0.002).clamp(0.0, 1.0);
        let speed = if strain > start {
            setting.rayleigh_speed * (0.16 + 0.20 * running)
        } else {
            0.0
        };
        ahead += speed * end / (count - 1) as f64 / setting.strain_rate;
        // Coarse meshes open a whole element edge at once.
        let opened = (ahead / SPACING / element).floor() * element;
        let wanted = (2.0 * opened) as usize;
        let fresh: Vec<_> = way.by_ref().take(wanted.saturating_sub(taken)).collect();
        bonds.extend(breaks(&fresh, index as u32));
        if opened > 75.0 && element < 2.0 {
            bonds.extend(breaks(
                &side.by_ref().take(fresh.len()).collect::<Vec<_>>(),
                index as u32,
            ));
        }
        taken = taken.max(wanted);
        let share = 1.0 - 0.9 * (opened * SPACING / (setting.length - setting.crack_length)).min(1.0);
        let ripple = 1.0 + 0.004 * (time * 0.15).sin();
        let sigma_yy = 0.8 * modulus * strain * share * ripple * (1.0 + 0.001 * (element - 1.0));
        let work = 0.4 * modulus * volume * strain * strain * (0.3 + 0.7 * share);
        let kinetic = 2e-4 * modulus * volume * strain + if speed > 0.0 { 0.04 * work * running } else { 0.0 };
        let cutoff_release = 0.27 * taken as f64;
        rows.push(Probe {
            step: 20 * index as u64,
            time,
            strain,
            sigma_xx: 0.31 * sigma_yy,
            sigma_yy,
            sigma_xy: 0.0,
            grip_stress: sigma_yy,
            kinetic,
            potential: work + cutoff_release - kinetic + 1e-4 * work * (time * 0.05).sin(),
            work,
            cutoff_release,
            refined_energy: 0.0,
            nodes: 1000.0,
            outruns: 0.0,
            temperature: if element < 2.0 { 10.0 * running } else { f64::NAN },
            j_integral: [0.98, 1.0, 1.02]
                .map(|share| share * (intensity(strain) * setting.thickness).powi(2) / setting.young_modulus),
        });
    }
    let width = element.max(2.0) * SPACING;
    let profile_x: Vec<f64> = (0..(setting.length / width) as usize)
        .map(|bin| (bin as f64 + 0.5) * width)
        .collect();
    let at = |row: &Probe, x: f64| {
        let distance = x - 100.5 * SPACING;
        let near = if distance > 0.0 {
            1.0 / (2.0 * PI * distance.max(0.1)).sqrt()
        } else {
            0.0
        };
        let far = if distance > 0.0 { 0.5 * row.sigma_yy } else { 0.0 };
        [0.4 * far, intensity(row.strain) * near + far, 0.0]
    };
    let profiles = rows
        .iter()
        .flat_map(|row| profile_x.iter().map(move |&x| at(row, x)))
        .collect();
    Series {
        probes: rows,
        profile_x,
        profiles,
        bonds,
        ..Series::default()
    }
}

/// Stress intensity at a strain, eV/nm^2.5.
fn intensity(strain: f64) -> f64 {
    230.0 * strain / 0.018
}

/// A slab of triangles of so many atoms per edge (1: of atoms), torn open up to `tip` nm.
pub fn torn(setting: &Setting, element: u32, tip: f64, strain: f64) -> (FieldMesh, Frame) {
    let mut mesh = FieldMesh {
        offsets: vec![0],
        ..FieldMesh::default()
    };
    let (columns, rows) = ((setting.length / SPACING) as i32, 150);
    let site = |i: f64, j: f64| [(i + 0.5 * j) * SPACING, j * 0.75_f64.sqrt() * SPACING];
    let cell = |mesh: &mut FieldMesh, corners: &[[f64; 2]]| {
        let first = mesh.points.len() as u32;
        mesh.points.extend_from_slice(corners);
        mesh.connectivity.extend(first..first + corners.len() as u32);
        mesh.offsets.push(mesh.connectivity.len() as u32);
        mesh.element_size.push(if corners.len() == 1 { 1 } else { element });
    };
    let edge = f64::from(element - 1);
    if element == 1 {
        for row in 0..rows {
            let shift = row / 2;
            (0..columns).for_each(|column| cell(&mut mesh, &[site(f64::from(column - shift), f64::from(row))]));
        }
    } else {
        let size = element as i32;
        for row in 0..rows / size {
            for block in 0..columns / (size + 1) {
                let (i, j) = (f64::from(block * (size + 1) - row * (size / 2)), f64::from(row * size));
                cell(&mut mesh, &[site(i, j), site(i + edge, j), site(i, j + edge)]);
                cell(
                    &mut mesh,
                    &[
                        site(i + edge + 1.0, j),
                        site(i + edge + 1.0, j + edge),
                        site(i + 1.0, j + edge),
                    ],
                );
            }
        }
    }
    let middle = 74.5 * 0.75_f64.sqrt() * SPACING;
    let half = 0.5 * setting.height;
    let field = |at: [f64; 2], upper: bool| {
        let (x, y) = (at[0], at[1] - middle);
        let open = 1.0 - (-(tip - x).max(0.0) / half).exp();
        let sign = if upper { 1.0 } else { -1.0 };
        let distance = (x - tip).hypot(y).max(0.5 * SPACING);
        let angle = y.atan2(x - tip);
        let modulus = setting.young_modulus / setting.thickness;
        let near = 150.0 / (2.0 * PI * distance).sqrt()
            * (0.5 * angle).cos()
            * (1.0 + (0.5 * angle).sin() * (1.5 * angle).sin());
        let wave = 6.0 * ((distance - 12.0) / 2.0).sin() * (-((distance - 12.0) / 5.0).powi(2)).exp();
        let rise = strain * y + sign * strain * (half - y.abs()).max(0.0) * open.sqrt();
        (
            [0.0, rise],
            [
                0.0,
                near + 0.7 * modulus * strain * (1.0 - open) + wave - 4.0 * open,
                0.0,
            ],
        )
    };
    let mut frame = Frame {
        step: 8_000,
        time: strain / setting.strain_rate,
        strain,
        ..Frame::default()
    };
    for ends in mesh.offsets.windows(2) {
        let nodes = &mesh.connectivity[ends[0] as usize..ends[1] as usize];
        let centre = [0, 1]
            .map(|axis| nodes.iter().map(|&node| mesh.points[node as usize][axis]).sum::<f64>() / nodes.len() as f64);
        let upper = centre[1] > middle;
        frame
            .displacement
            .extend(nodes.iter().map(|&node| field(mesh.points[node as usize], upper).0));
        frame.stress.push(field(centre, upper).1);
        frame.damage.push(0.0);
    }
    frame.velocity = vec![[0.0; 2]; frame.displacement.len()];
    (mesh, frame)
}
