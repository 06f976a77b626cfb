//! Files of a run: to the bit, whole or an error, and readable by others.

mod changing;
mod checkpoint;
mod interrupted;
mod others;
mod pieces;
mod solids;

use cgaft::analysis::series::{BondEvent, CrackFrom, Probe, Series, Setting};
use cgaft::loading::Booked;
use cgaft::record::frames::{FieldMesh, Frame};
use cgaft::solver::checkpoint::Checkpoint;
use cgaft::solver::slab::Kept;

/// A number with no short form, different for every `seed`.
fn number(seed: u64) -> f64 {
    (seed as f64 + 0.1).sin() * 1e3
}

/// A bond that broke at this probe.
fn parted_at(probe: u32) -> impl Fn([i32; 3]) -> BondEvent {
    move |[column, row, direction]| BondEvent {
        probe,
        column,
        row,
        direction: direction as u8,
        broken: true,
    }
}

fn checkpoint(nodes: u64) -> Checkpoint {
    let column = |offset: u64| (0..nodes).map(|node| number(offset + node)).collect::<Vec<_>>();
    Checkpoint {
        step: u64::MAX,
        time: number(1),
        time_step: 2.5e-3,
        step_after_next: number(6),
        longest_step: 0.0375,
        stability_limit: number(5),
        position: [column(10), column(20)],
        velocity: [column(30), column(40)],
        open_interfaces: vec![0, 7, u32::MAX],
        closest_approach: number(9),
        start: [number(6), number(7), number(8)],
        peak_work: f64::INFINITY,
        peak_imbalance: number(2),
        refined_energy: number(5),
        looks: 12,
        probes: 12,
        snapshots: 3,
        kept: Kept {
            booked: Booked {
                impulses: column(50),
                absorbed: column(60),
                works: column(70),
            },
            broken_bonds: vec![[-1, 2, 0], [i32::MAX, i32::MIN, 2]],
            parted_bonds: [[-1, 2, 0], [0, 3, 1], [i32::MAX, i32::MIN, 2]]
                .map(parted_at(7))
                .to_vec(),
            joins: vec![3, 7],
            last_advance: number(3),
            farthest_tip: number(4),
            damage_front: 14.25,
            earlier_work: number(6),
            refined: vec![3, 4, 9],
            outruns: 2,
            branched: f64::INFINITY,
            left_plane: 61.5,
        },
    }
}

/// Rows `probes` of one long series, steps 10 apart, with `bins` bins a profile; bonds at every third probe.
fn series(probes: std::ops::Range<u64>, bins: u64) -> Series {
    let probe = |index: u64| Probe {
        step: 10 * index,
        time: 0.025 * index as f64,
        strain: number(index),
        sigma_xx: number(index + 1),
        sigma_yy: number(index + 2),
        sigma_xy: number(index + 3),
        grip_stress: number(index + 4),
        kinetic: number(index + 5),
        potential: number(index + 6),
        work: number(index + 7),
        cutoff_release: number(index + 8),
        refined_energy: number(index + 11),
        nodes: 1000.0 + index as f64,
        outruns: 2.0,
        temperature: f64::NAN,
        j_integral: [number(index + 9), f64::NAN, number(index + 10)],
    };
    let bond = |index: u64| BondEvent {
        probe: index as u32,
        column: -(index as i32),
        row: 7,
        direction: (index % 3) as u8,
        broken: index.is_multiple_of(2),
    };
    Series {
        probes: probes.clone().map(probe).collect(),
        profile_x: (0..bins).map(|bin| 0.5 + bin as f64).collect(),
        profiles: probes
            .clone()
            .flat_map(|p| (0..bins).map(move |b| [number(p), number(b), number(p * b)]))
            .collect(),
        tractions: probes
            .clone()
            .flat_map(|p| (0..bins).map(move |b| [number(p + b), number(p * b + 1)]))
            .collect(),
        gauge_places: vec![[1.0, 2.0], [1.0, -2.0]],
        gauges: probes
            .clone()
            .flat_map(|p| (0..2).map(move |g| [0, 1, 2, 3, 4].map(|k| number(p + g * k))))
            .collect(),
        bonds: probes.filter(|index| index % 3 == 0).map(bond).collect(),
    }
}

fn setting(crack_row: Option<i32>) -> Setting {
    Setting {
        spacing: number(1),
        length: number(2),
        left_x: number(3),
        height: number(4),
        crack_row,
        crack_from: CrackFrom::Left,
        crack_length: number(5),
        strain_rate: number(6),
        thickness: number(7),
        longitudinal_speed: number(8),
        transverse_speed: number(9),
        rayleigh_speed: number(10),
        young_modulus: number(11),
        poisson_ratio: number(12),
        fracture_energy: number(13),
        element_at_crack: 10,
        nodes: 1 << 40,
        elements: 12,
        represented_atoms: u64::MAX,
    }
}

/// Triangles with nodes of their own, then as many atoms.
fn mesh(triangles: u32) -> FieldMesh {
    let nodes = 4 * triangles;
    let starts = (0..triangles).map(|triangle| 3 * triangle).chain(3 * triangles..=nodes);
    FieldMesh {
        points: (0..u64::from(nodes))
            .map(|node| [number(node), number(node + 1)])
            .collect(),
        connectivity: (0..nodes).rev().collect(),
        offsets: starts.collect(),
        element_size: (0..2 * triangles)
            .map(|cell| if cell < triangles { 10 } else { 1 })
            .collect(),
    }
}

fn frame(step: u64, mesh: &FieldMesh) -> Frame {
    let (nodes, cells) = (mesh.points.len() as u64, mesh.element_size.len() as u64);
    Frame {
        step,
        time: 0.0025 * step as f64,
        strain: number(step),
        displacement: (0..nodes)
            .map(|node| [number(node + step), number(node * step)])
            .collect(),
        velocity: (0..nodes)
            .map(|node| [number(2 * node + step), number(3 * node + step)])
            .collect(),
        stress: (0..cells)
            .map(|cell| [number(cell), number(cell + step), number(cell * step)])
            .collect(),
        damage: (0..cells).map(|cell| cell as f64 / cells as f64).collect(),
        mesh: None,
    }
}

/// Equal to the bit, NaN and the sign of zero included: what `{:?}` shows tells all f64 but NaNs apart.
fn assert_same_series(left: &Series, right: &Series) {
    assert_eq!(format!("{left:?}"), format!("{right:?}"));
}
