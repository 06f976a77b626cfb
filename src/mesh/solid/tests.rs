use std::collections::{HashMap, HashSet};

use super::interfaces::Interfaces;
use super::region::{Region, Shape as RegionShape};
use super::sites::{Frame, Outline, Range3};
use super::template::{self, BORDERS, Contact};
use super::*;
use crate::lattice::fcc;

fn blocks(extent: [i32; 3], element: u16, regions: Vec<Region>, removed: Vec<Range3>) -> Solid {
    let frame = Frame::of_blocks(1.0);
    let sites = Sites {
        outline: Outline::Rhombohedron(extent),
        frame,
        removed,
        cut: None,
    };
    Solid::new(&Plan {
        sites,
        element,
        regions,
        spacing: 1.0,
    })
}

fn check_cover(mesh: &Solid) {
    let mut seen = HashSet::new();
    for element in &mesh.elements {
        for local in element.locals() {
            assert!(mesh.sites.contains(element.site(local)) && seen.insert(element.site(local)));
        }
    }
    let bounds = mesh.sites.bounds();
    let mut expected = 0;
    for k in bounds.from[2]..bounds.to[2] {
        for j in bounds.from[1]..bounds.to[1] {
            expected += (bounds.from[0]..bounds.to[0])
                .filter(|&i| mesh.sites.contains([i, j, k]))
                .count();
        }
    }
    assert_eq!(seen.len(), expected);
    assert_eq!(mesh.site_count(), expected as u64);
    let nodes: Vec<usize> = (0..mesh.elements.len())
        .flat_map(|element| mesh.nodes_of(element))
        .collect();
    let distinct: HashSet<&usize> = nodes.iter().collect();
    assert_eq!([nodes.len(), distinct.len()], [mesh.node_count(); 2]);
    for element in 0..mesh.elements.len() {
        mesh.nodes_of(element)
            .for_each(|node| assert_eq!(mesh.element_of_node(node), element));
    }
}

#[test]
fn the_bar_and_the_film_of_the_source_have_its_counts() {
    // [Deng2011] Fig. 4-6: 4 x 4 x 40 blocks of a thousand atoms; Fig. 6-1: 40 x 40 less a notch of ten.
    let bar = blocks([40, 40, 400], 10, vec![], vec![]);
    assert_eq!([bar.elements.len(), bar.node_count()], [3 * 640, 14 * 640]);
    assert_eq!(bar.site_count(), 640_000);
    let notch = Range3 {
        from: [0, 200, 0],
        to: [100, 210, 10],
    };
    let film = blocks([400, 400, 10], 10, vec![], vec![notch]);
    assert_eq!([film.elements.len(), film.atom_count()], [3 * 1590, 0]);
}

#[test]
fn every_site_is_carried_once_whatever_sizes_are_mixed() {
    let ball = Region {
        shape: RegionShape::Ball {
            center: [16.0, 12.0, 8.0],
            radius: 4.0,
        },
        element: 1,
    };
    let slab = Region {
        shape: RegionShape::Slab {
            point: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
            half_width: 3.0,
        },
        element: 5,
    };
    let slot = Range3 {
        from: [0, 10, 0],
        to: [7, 14, 20],
    };
    check_cover(&blocks([30, 20, 20], 10, vec![], vec![]));
    check_cover(&blocks([30, 20, 20], 10, vec![ball, slab], vec![slot]));
    check_cover(&blocks([17, 23, 11], 6, vec![], vec![]));
    check_cover(&blocks([7, 5, 4], 1, vec![], vec![]));
    let frame = Frame::along([[1, 0, 0], [0, 1, 0], [0, 0, 1]], 1.0);
    let sites = Sites {
        outline: Outline::Box([22.0, 19.0, 25.0]),
        frame,
        removed: vec![],
        cut: None,
    };
    let boxed = Solid::new(&Plan {
        sites,
        element: 6,
        regions: vec![],
        spacing: 1.0,
    });
    assert!(boxed.parts > 0 && boxed.atom_count() > 0);
    check_cover(&boxed);
}

#[test]
fn no_region_holds_a_site_of_a_larger_element() {
    let ball = Region {
        shape: RegionShape::Ball {
            center: [16.0, 12.0, 8.0],
            radius: 5.0,
        },
        element: 1,
    };
    let mesh = blocks([30, 20, 20], 10, vec![ball], vec![]);
    assert!(mesh.atom_count() > 0 && mesh.parts > 0);
    for element in mesh.elements.iter().filter(|element| element.size > 1) {
        assert!(
            element
                .locals()
                .all(|local| !ball.shape.contains(mesh.sites.frame.place(element.site(local))))
        );
    }
}

/// Bonds of the block in the middle of 27 with every other part, by lattice vectors of these squared lengths.
fn bonds_by_pair(mesh: &Solid, squared: i32) -> HashMap<[u32; 2], u32> {
    let mut owner = HashMap::new();
    for (number, element) in (0..).zip(&mesh.elements) {
        element
            .locals()
            .for_each(|local| assert_eq!(owner.insert(element.site(local), number), None));
    }
    let mut counts = HashMap::new();
    for vector in fcc::half_vectors_within(1.5)
        .into_iter()
        .filter(|&v| fcc::squared_length(v) == squared)
    {
        for (site, &first) in &owner {
            let neighbour: [i32; 3] = std::array::from_fn(|axis| site[axis] + vector[axis]);
            if let Some(&second) = owner.get(&neighbour).filter(|&&second| second != first) {
                *counts.entry([first.min(second), first.max(second)]).or_insert(0) += 1;
            }
        }
    }
    counts
}

#[test]
fn borders_are_all_that_bonds_of_first_and_second_neighbours_find() {
    for n in [3, 6, 10] {
        let mesh = blocks([3 * n; 3], n as u16, vec![], vec![]);
        let interfaces = Interfaces::new(&mesh, 1.0);
        let nearest = bonds_by_pair(&mesh, 1);
        let second = bonds_by_pair(&mesh, 2);
        let mut found = HashMap::new();
        for ([first, second], border) in interfaces.pairs() {
            let bonds = template::bonds(BORDERS[border].contact, n);
            assert_eq!(found.insert([first.min(second), first.max(second)], bonds), None);
        }
        assert!(
            nearest.iter().all(|(pair, bonds)| found.get(pair) == Some(bonds)),
            "size {n}"
        );
        assert!(second.keys().all(|pair| found.contains_key(pair)), "size {n}");
        let with_bonds = found
            .iter()
            .filter(|(pair, _)| nearest.contains_key(*pair) || second.contains_key(*pair));
        assert_eq!(with_bonds.count(), found.len());
    }
}

#[test]
fn a_block_has_14_nodes_and_16_faces_four_of_each_slip_plane() {
    // [Deng2011] Fig. 3-8: all faces of the hybrid element are {111} planes, of which there are four.
    let element = |shape| Element {
        shape,
        size: 10,
        anchor: [0; 3],
    };
    let mut planes: HashMap<&str, u32> = HashMap::new();
    for border in BORDERS {
        let Contact::Face {
            tetrahedron,
            octahedron,
        } = border.contact
        else {
            continue;
        };
        for (shape, corners) in [(border.first, tetrahedron), (border.second, octahedron)] {
            let nodes = element(shape).corners();
            let sites = corners.map(|corner| nodes[usize::from(corner)]);
            let is_same = |of: fn([i32; 3]) -> i32| sites.iter().all(|&site| of(site) == of(sites[0]));
            let plane = match () {
                () if is_same(|[i, _, _]| i) => "i",
                () if is_same(|[_, j, _]| j) => "j",
                () if is_same(|[_, _, k]| k) => "k",
                () => "i + j + k",
            };
            assert!(plane != "i + j + k" || is_same(|site| site.iter().sum()));
            *planes.entry(plane).or_insert(0) += 1;
        }
    }
    assert_eq!(planes, HashMap::from([("i", 4), ("j", 4), ("k", 4), ("i + j + k", 4)]));
    assert_eq!(
        Shape::OF_BLOCK.iter().map(|shape| shape.node_count()).sum::<usize>(),
        14
    );
}

#[test]
fn opposite_corners_of_a_border_are_neighbours() {
    let element = |shape, anchor| Element { shape, size: 8, anchor };
    for border in BORDERS {
        let [first, second] = [
            (border.first, [0; 3]),
            (border.second, border.shift.map(|shift| 8 * shift)),
        ]
        .map(|(shape, anchor)| {
            let element = element(shape, anchor);
            let corners = element.corners();
            move |corner: u8| element.site(corners[usize::from(corner)])
        });
        let squared = |a: u8, b: u8| {
            let [a, b] = [first(a), second(b)];
            fcc::squared_length(std::array::from_fn(|axis| a[axis] - b[axis]))
        };
        match border.contact {
            Contact::Face {
                tetrahedron,
                octahedron,
            } => {
                (0..3).for_each(|corner| assert_eq!(squared(tetrahedron[corner], octahedron[corner]), 1));
            }
            Contact::Edges { first, second } => (0..2).for_each(|end| assert_eq!(squared(first[end], second[end]), 1)),
            Contact::FarEdges { first, second } => {
                (0..2).for_each(|end| assert_eq!(squared(first[end], second[end]), 2));
            }
            Contact::Tips { first, second } => assert_eq!(squared(first, second), 2),
        }
    }
}

#[test]
fn the_interfaces_listed_for_some_parts_are_theirs_among_all() {
    let slot = Range3 {
        from: [0, 12, 0],
        to: [6, 18, 12],
    };
    let mesh = blocks([24, 30, 12], 6, vec![], vec![slot]);
    let all = Interfaces::new(&mesh, 1.0);
    let groups = mesh.groups();
    for count in [2, 3] {
        let cut = |part: usize| {
            groups
                .get(part * groups.len() / count)
                .map_or(mesh.parts, |group| group.elements.start)
        };
        for part in 0..count {
            let mine = cut(part)..cut(part + 1);
            let some = Interfaces::listed_for(&mesh, 1.0, mine.clone());
            assert_eq!((&some.runs, &some.lonely), (&all.runs, &all.lonely));
            let is_mine = |part: &u32| mine.contains(&(*part as usize));
            for part in 0..mesh.parts {
                let expected = all.of(part).iter().copied();
                let expected = expected.filter(|&number| all.pair(number).iter().any(is_mine));
                assert!(some.of(part).iter().copied().eq(expected), "part {part} of {count}");
            }
        }
    }
}
