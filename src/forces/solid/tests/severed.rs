//! Bodies with a plane that is severed over a part: its faces push each other and never pull.

use super::*;
use crate::mesh::solid::cut::Cut;
use crate::mesh::solid::severed::severed_element;

/// Between blocks of six, from the low and from the high side of a1, and along the third kind of {111} plane between parts.
const CUTS: [Cut; 3] = [
    Cut {
        normal: [0, 1, 0],
        layer: 6,
        into: [1, 0, 0],
        end: 6,
    },
    Cut {
        normal: [0, 1, 0],
        layer: 6,
        into: [-1, 0, 0],
        end: -5,
    },
    Cut {
        normal: [1, 1, 1],
        layer: 11,
        into: [1, -1, 0],
        end: 1,
    },
];

fn cut(element: u16, regions: Vec<Region>, cut: Cut, spacing: f64) -> Solid {
    let whole = solid([12, 12, 6], element, regions.clone(), vec![], spacing);
    Solid::new(&Plan {
        sites: Sites {
            cut: Some(cut),
            ..whole.sites
        },
        element,
        regions,
        spacing,
    })
}

/// Elements, elements beside atoms and smaller ones, and atoms.
fn meshes(cut_at: Cut, spacing: f64) -> [Solid; 3] {
    let ball = Region {
        shape: RegionShape::Ball {
            center: [6.0, 4.0, 2.0],
            radius: 2.0,
        },
        element: 1,
    };
    let half = Region {
        shape: RegionShape::Box {
            from: [-9.0; 3],
            to: [4.0, 4.0, 9.0],
        },
        element: 3,
    };
    [
        cut(6, vec![], cut_at, spacing),
        cut(6, vec![ball, half], cut_at, spacing),
        cut(1, vec![], cut_at, spacing),
    ]
}

/// What lies beyond the plane is moved out of it, or into the other side, and along it, all but far ahead of its end.
fn parted(mesh: &Solid, [above, along]: [f64; 2], noise: f64) -> Planes {
    let cut = mesh.sites.cut.expect("the mesh has a cut");
    let placed = cut.placed(&mesh.sites.frame.vectors);
    let mut position = displaced(mesh, NONE, noise);
    for element in 0..mesh.elements.len() {
        for node in mesh.nodes_of(element) {
            let place = position.each_ref().map(|plane| plane[node]);
            let [ahead, height] = placed.coordinates(place);
            if height > 0.0 {
                let share = (1.0 - 0.2 * ahead / mesh.spacing).clamp(0.0, 1.0);
                for axis in 0..3 {
                    position[axis][node] += share * (above * placed.up[axis] + along * placed.ahead[axis]);
                }
            }
        }
    }
    position
}

#[test]
fn nothing_pulls_in_a_crystal_at_rest_that_is_severed_over_a_part_of_a_plane() {
    let material = material(SHORT);
    for mesh in CUTS.into_iter().flat_map(|cut| meshes(cut, material.spacing)) {
        assert_eq!(severed_element(&mesh), None);
        let mut forces = Forces::new(mesh.clone(), material);
        let mut position = mesh.node_positions();
        let mut force = position.clone();
        let open = forces.open_interfaces();
        assert!(open == forces.interfaces.severed && (mesh.atom_count() > 0 || !open.is_empty()));
        forces.compute(&mut position, &mut force).expect("nothing flies away");
        assert!(force.iter().flatten().all(|force| force.abs() < 1e-10));
        assert_eq!(forces.open_interfaces(), open);
    }
}

#[test]
fn forces_of_severed_bodies_are_those_of_the_plain_sum_whether_strained_opened_slid_or_closed() {
    let states = [
        ([0.0, 0.0], 0.0),
        ([0.0, 0.0], 0.01),
        ([0.6, 0.0], 0.005),
        ([-0.08, 0.0], 0.005),
        ([-0.05, 0.5], 0.02),
    ];
    for cutoff in [SHORT, 2.5] {
        let material = material(cutoff);
        for mesh in CUTS.into_iter().flat_map(|cut| meshes(cut, material.spacing)) {
            for (moved, noise) in states {
                let mut position = parted(&mesh, moved.map(|part| part * material.spacing), noise);
                check_against_referee(mesh.clone(), material, position.clone());
                // Lists that were made in another state hold all that matters.
                let mut forces = Forces::new(mesh.clone(), material);
                let mut before = mesh.node_positions();
                let mut force = before.clone();
                forces.compute(&mut before, &mut force).expect("nothing flies away");
                forces.compute(&mut position, &mut force).expect("nothing flies away");
                let (expected, _) = referee::forces(&mesh, &material, Summation::Exact, &position);
                let pairs = force.iter().flatten().zip(expected.iter().flatten());
                let largest = expected
                    .iter()
                    .flatten()
                    .fold(1.0, |most: f64, force| most.max(force.abs()));
                pairs.for_each(|(found, expected)| assert!((found - expected).abs() < ROUNDING * largest));
            }
        }
    }
}

#[test]
fn closed_faces_push_with_the_curvature_of_bonds_and_open_ones_leave_each_other_alone() {
    // Sites of atoms far from the end and from the sides: three severed neighbours each, at a distance h above and 1/sqrt(3)
    // aside. To first order they push like bonds, k times the share along each; pulled, they do nothing.
    let material = material(SHORT);
    let mesh = cut(1, vec![], Cut { end: 12, ..CUTS[0] }, material.spacing);
    let placed = CUTS[0].placed(&mesh.sites.frame.vectors);
    let push = |above: f64| {
        let mut forces = Forces::new(mesh.clone(), material);
        let mut position = mesh.node_positions();
        for number in (0..mesh.elements.len()).filter(|&number| mesh.elements[number].anchor[1] >= 6) {
            (0..3).for_each(|axis| position[axis][number] += above * placed.up[axis]);
        }
        let mut force = position.clone();
        forces.compute(&mut position, &mut force).expect("nothing flies away");
        let middle = mesh
            .elements
            .iter()
            .position(|atom| atom.anchor == [6, 6, 3])
            .expect("it is there");
        (0..3).map(|axis| force[axis][middle] * placed.up[axis]).sum::<f64>()
    };
    assert!(push(0.05).abs() < 1e-10);
    let stiffness = material.interaction.curvature(material.spacing);
    const SMALL: f64 = 1e-6;
    // Three bonds with a share of 2/3 of the square along the normal each; the second order is 1e-5 of it.
    assert!((push(-SMALL) / (2.0 * stiffness * SMALL) - 1.0).abs() < 1e-4);
}

#[test]
fn threads_and_lists_leave_no_trace_in_the_sums_of_a_severed_body() {
    let material = material(SHORT);
    let [_, mesh, _] = meshes(CUTS[0], material.spacing);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("threads can be started").install(|| {
            let mut forces = Forces::new(mesh.clone(), material);
            let mut position = parted(&mesh, [-0.05, 0.02], 0.01);
            let (mut force, mut measure) = (position.clone(), Measure::default());
            forces
                .compute_and_measure(&mut position, &mut force, &mut measure)
                .expect("nothing flies away");
            (force, measure)
        })
    };
    let one = on(1);
    assert!([2, 3].into_iter().all(|threads| on(threads) == one));
}
