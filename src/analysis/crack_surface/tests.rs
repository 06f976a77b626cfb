//! Solids that are parted on purpose.

use super::arms::arms;
use super::branches::branches;
use super::front::{Directions, front, normal_speed, roughness};
use super::grown::{Root, grown};
use super::*;
use crate::mesh::solid::bonds::Bonds;
use crate::mesh::solid::cut::Cut;
use crate::mesh::solid::region::{Region, Shape};
use crate::mesh::solid::sites::{self, Outline, Range3, Sites};
use crate::mesh::solid::{Plan, Solid};

/// Sites along each axis: blocks of six.
const EXTENT: [i32; 3] = [18, 24, 12];

/// Distance of {111} planes, spacings.
const LAYER: f64 = 0.816_496_580_927_726;

/// Beyond which a bond is broken, spacings.
const BREAKING: f64 = 1.33;

fn mesh(element: u16, slot: Option<Range3>, atoms_between: Option<[f64; 2]>) -> Solid {
    let region = atoms_between.map(|[from, to]| Region {
        shape: Shape::Box {
            from: [-100.0, from, -100.0],
            to: [100.0, to, 100.0],
        },
        element: 1,
    });
    Solid::new(&Plan {
        sites: Sites {
            outline: Outline::Rhombohedron(EXTENT),
            frame: sites::Frame::of_blocks(1.0),
            removed: slot.into_iter().collect(),
            cut: None,
        },
        element,
        regions: region.into_iter().collect(),
        spacing: 1.0,
    })
}

/// Elements, atoms above the plane of j = 12 and around it, atoms.
fn meshes(slot: Option<Range3>) -> [Solid; 4] {
    [
        mesh(6, slot, None),
        mesh(6, slot, Some([10.0, 100.0])),
        mesh(6, slot, Some([9.0, 12.0])),
        mesh(1, slot, None),
    ]
}

/// The nodes, with all elements moved that are wanted.
fn moved(mesh: &Solid, by: [f64; 3], is_wanted: impl Fn([i32; 3]) -> bool) -> [Vec<f64>; 3] {
    let mut position = mesh.node_positions();
    for (number, element) in mesh.elements.iter().enumerate() {
        if is_wanted(element.anchor) {
            for node in mesh.nodes_of(number) {
                (0..3).for_each(|axis| position[axis][node] += by[axis]);
            }
        }
    }
    position
}

/// Out of the planes of constant j, of length 1.
fn normal() -> [f64; 3] {
    let [a, _, c] = sites::Frame::of_blocks(1.0).vectors;
    let normal = joints::cross(c, a);
    let length = joints::dot(normal, normal).sqrt();
    normal.map(|part| part / length)
}

/// Area of a plane of constant j, a site.
const OF_SITE: f64 = 0.866_025_403_784_438_6;

const ROUNDING: f64 = 1e-9;

/// Sites at the sides of a plane have fewer neighbours beyond it, some none.
const AT_SIDES: f64 = 0.02;

#[test]
fn a_solid_that_is_parted_along_a_plane_has_its_area_of_crack_on_any_mesh_and_no_slip() {
    for mesh in meshes(None) {
        let joints = Joints::new(&mesh, BREAKING);
        assert_eq!(joints.parted(&mesh.node_positions()), []);
        let position = moved(&mesh, normal().map(|part| 0.6 * part), |site| site[1] >= 12);
        let parted = joints.parted(&position);
        let areas = Areas::of(&parted, &grown(&parted, &Root::of(&mesh), 1.0));
        let expected = f64::from(EXTENT[0] * EXTENT[2]) * OF_SITE;
        assert!((areas.crack[1] / expected - 1.0).abs() < AT_SIDES, "{areas:?}");
        let not_crack = areas.elsewhere + areas.slip.iter().sum::<f64>();
        assert!(not_crack < AT_SIDES * expected, "{areas:?}");
    }
}

#[test]
fn slip_by_a_partial_and_by_a_whole_spacing_is_slip_of_the_whole_plane_and_no_crack() {
    let [a, _, c] = sites::Frame::of_blocks(1.0).vectors;
    let partial = [0, 1, 2].map(|axis| (a[axis] + c[axis]) / 3.0);
    for mesh in meshes(None) {
        let joints = Joints::new(&mesh, BREAKING);
        for slip in [partial, a] {
            let position = moved(&mesh, slip, |site| site[1] >= 12);
            let parted = joints.parted(&position);
            assert!(parted.iter().all(|piece| piece.how == How::Slid), "{parted:?}");
            let areas = Areas::of(&parted, &grown(&parted, &Root::of(&mesh), 1.0));
            let expected = f64::from(EXTENT[0] * EXTENT[2]) * OF_SITE;
            // The last row of sites has no broken bond but the one that is not there.
            assert!((areas.slip[1] / expected - 1.0).abs() < 0.06, "{areas:?}");
            assert_eq!(areas.crack, [0.0; FAMILIES]);
        }
    }
}

#[test]
fn a_partial_leaves_two_layers_dislocated_a_whole_spacing_none_and_parting_exposes_two() {
    let [a, _, c] = sites::Frame::of_blocks(1.0).vectors;
    let partial = [0, 1, 2].map(|axis| (a[axis] + c[axis]) / 3.0);
    let mesh = mesh(1, None, None);
    let bonds = Bonds::new(&mesh, &[]);
    let count = |by: [f64; 3]| dislocated::counts(&mesh, &bonds, &moved(&mesh, by, |site| site[1] >= 12));
    let layer = u64::from((EXTENT[0] - 2) as u32 * (EXTENT[2] - 2) as u32);
    let inner = layer * (EXTENT[1] - 2) as u64;
    let at_rest = count([0.0; 3]);
    assert_eq!(
        at_rest,
        dislocated::Counts {
            all: inner,
            dislocated: 0,
            exposed: 0
        }
    );
    // [Kelchner1998] Eq. (1): a stacking fault has two layers. At its sides atoms have lost neighbours that they had.
    let faulted = count(partial);
    assert!(
        faulted.dislocated + faulted.exposed == 2 * layer && faulted.dislocated > 3 * layer / 2,
        "{faulted:?}"
    );
    let slipped = count(a);
    assert!(slipped.dislocated + slipped.exposed < layer / 2, "{slipped:?}");
    let parted = count(normal());
    assert_eq!([parted.dislocated, parted.exposed], [0, 2 * layer]);
}

/// Left out from the low side of a1, one block high and over all of a3.
const SLOT: Range3 = Range3 {
    from: [0, 6, 0],
    to: [6, 12, 12],
};

#[test]
fn a_crack_grows_from_the_notch_and_its_front_is_where_it_ends() {
    for mesh in meshes(Some(SLOT)) {
        let joints = Joints::new(&mesh, BREAKING);
        let directions = Directions::of(&mesh).expect("there is one slot");
        assert!((directions.width - 12.0).abs() < ROUNDING);
        let height = normal().map(|part| 0.6 * part);
        let find = |position: &[Vec<f64>; 3]| {
            let parted = joints.parted(position);
            let is_crack = grown(&parted, &Root::of(&mesh), 1.0);
            (Areas::of(&parted, &is_crack), parted, is_crack)
        };
        // The plane of the upper side of the slot opens as far as the solid goes.
        let mut position = moved(&mesh, height, |site| site[1] >= 12);
        let (areas, parted, is_crack) = find(&position);
        assert!(
            (areas.crack[1] / (12.0 * 12.0 * OF_SITE) - 1.0).abs() < AT_SIDES,
            "{areas:?}"
        );
        assert!(areas.elsewhere < AT_SIDES * areas.crack[1], "{areas:?}");
        let front = front(&parted, &is_crack, &Root::of(&mesh), &directions, 2);
        // Up to half the edge of a block lies between the last middle and the end; the way there leans.
        assert!(front.iter().all(|&front| (8.0..15.0).contains(&front)), "{front:?}");
        let speed = normal_speed(&[0.0; 2], &front, 2.0, &directions);
        assert!((4.0..7.5).contains(&speed), "{speed}");
        let rough = roughness(&parted, &is_crack, &directions);
        assert!(rough.iter().flatten().all(|&rough| rough < ROUNDING), "{rough:?}");
        // Another plane opens, to which no crack comes.
        for (number, element) in mesh.elements.iter().enumerate() {
            if element.anchor[1] >= 18 {
                for node in mesh.nodes_of(number) {
                    (0..3).for_each(|axis| position[axis][node] += height[axis]);
                }
            }
        }
        let areas = find(&position).0;
        assert!(
            (areas.elsewhere / (18.0 * 12.0 * OF_SITE) - 1.0).abs() < AT_SIDES,
            "{areas:?}"
        );
    }
}

/// Severed from the low side of a1 up to the end of a block.
const CUT: Cut = Cut {
    normal: [0, 1, 0],
    layer: 12,
    into: [1, 0, 0],
    end: 6,
};

#[test]
fn a_crack_grows_from_a_severed_plane_and_what_is_severed_is_none_of_it() {
    for mut mesh in meshes(None) {
        mesh.sites.cut = Some(CUT);
        let joints = Joints::new(&mesh, BREAKING);
        assert_eq!(joints.parted(&mesh.node_positions()), []);
        let directions = Directions::of(&mesh).expect("one plane is severed");
        assert!((directions.width - 12.0).abs() < ROUNDING && (directions.ligament - 12.0 * OF_SITE).abs() < ROUNDING);
        // Midway between the layers, and between the last row of sites behind the end and the first ahead.
        let middle = mesh.sites.frame.place_between([5.5, 11.5, 5.5]);
        assert!((0..3).all(|axis| (directions.end[axis] - middle[axis]).abs() < ROUNDING));
        let position = moved(&mesh, normal().map(|part| 0.6 * part), |site| site[1] >= 12);
        let parted = joints.parted(&position);
        let root = Root::of(&mesh);
        let is_crack = grown(&parted, &root, 1.0);
        let areas = Areas::of(&parted, &is_crack);
        assert!(
            (areas.crack[1] / (12.0 * 12.0 * OF_SITE) - 1.0).abs() < AT_SIDES,
            "{areas:?}"
        );
        assert!(areas.elsewhere < AT_SIDES * areas.crack[1], "{areas:?}");
        let front = front(&parted, &is_crack, &root, &directions, 2);
        assert!(
            front.iter().all(|&front| (7.0..12.0 * OF_SITE).contains(&front)),
            "{front:?}"
        );
    }
}

fn piece(middle: [f64; 3]) -> Parted {
    Parted {
        how: How::Opened,
        middle,
        area: 1.0,
        size: 1,
        family: 0,
    }
}

#[test]
fn a_branch_counts_where_it_keeps_its_direction_over_ten_nanometres() {
    let mesh = mesh(6, Some(SLOT), None);
    let directions = Directions::of(&mesh).expect("there is one slot");
    let along = |degrees: f64, from: f64, length: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let steps = (length / 0.2) as usize;
        let place = move |step: usize| {
            let far = 0.2 * step as f64;
            [0, 1, 2].map(|axis| {
                directions.end[axis] + (from + far * cosine) * directions.ahead[axis] + far * sine * directions.up[axis]
            })
        };
        (0..steps).map(move |step| piece(place(step)))
    };
    let find = |pieces: Vec<Parted>| {
        let is_crack = vec![true; pieces.len()];
        branches(&pieces, &is_crack, &directions, &[60.0, -60.0])
    };
    assert_eq!(find(along(0.0, 0.0, 40.0).collect()), []);
    assert_eq!(find(along(0.0, 0.0, 20.0).chain(along(60.0, 20.0, 8.0)).collect()), []);
    let forked = along(0.0, 0.0, 20.0)
        .chain(along(58.0, 20.0, 15.0))
        .chain(along(-63.0, 20.0, 12.0));
    let found = find(forked.collect());
    assert_eq!(
        found.iter().map(|branch| branch.degrees).collect::<Vec<_>>(),
        [60.0, -60.0]
    );
    for branch in found {
        // Up to the width of the strip it may begin on the crack that it leaves.
        assert!(
            (branch.start[0] - 20.0).abs() < 4.0 && branch.start[1].abs() < 4.0,
            "{branch:?}"
        );
        assert!((10.0..20.0).contains(&branch.length));
    }
}

#[test]
fn six_cracks_from_one_place_are_six_arms_and_a_round_hole_is_none_but_one() {
    let ray = |degrees: f64, length: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        (0..(5.0 * length) as usize).map(move |step| {
            let far = 0.2 * step as f64;
            piece([7.0 + far * cosine, -3.0 + far * sine, 0.4])
        })
    };
    let find = |pieces: Vec<Parted>| {
        let is_crack = vec![true; pieces.len()];
        arms(&pieces, &is_crack, [7.0, -3.0, 0.0], [0.0, 0.0, 1.0])
    };
    let star = (0..6).flat_map(|arm| ray(11.0 + 60.0 * f64::from(arm), 20.0 - f64::from(arm)));
    let found = find(star.collect());
    assert_eq!(found.len(), 6, "{found:?}");
    for (number, arm) in found.iter().enumerate() {
        assert!((arm.degrees - 11.0 - 60.0 * number as f64).abs() < 1.0, "{arm:?}");
        assert!((arm.length - 20.0 + number as f64).abs() < 0.5, "{arm:?}");
    }
    assert_eq!(
        find((0..72).flat_map(|arm| ray(5.0 * f64::from(arm) + 2.0, 9.0)).collect()).len(),
        1
    );
}

#[test]
fn layers_of_planes_are_as_far_apart_as_the_lattice_says() {
    let [_, b, _] = sites::Frame::of_blocks(1.0).vectors;
    assert!((joints::dot(b, normal()).abs() - LAYER).abs() < ROUNDING);
}
