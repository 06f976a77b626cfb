use super::*;
use crate::mesh::Plan;
use crate::mesh::cut::Crack;
use crate::mesh::sites::Layout;

fn mesh(element: u16, crack_length: Option<f64>) -> Mesh {
    let layout = Layout {
        block: 10,
        rows: 6,
        triangles: 13,
    };
    Mesh::new(&Plan {
        layout,
        element,
        regions: vec![],
        crack: crack_length.map(Crack::of_length),
        grip_rows: 10,
        spacing: 1.0,
    })
}

#[test]
fn a_cell_of_two_55_site_triangles_has_57_bonds_along_edges_and_3_at_corners() {
    let mesh = mesh(10, None);
    let interfaces = Interfaces::new(&mesh, 1.4);
    let bonds = |number: usize| interfaces.strings(number).iter().map(|s| s.count).sum::<i32>();
    let counts: Vec<i32> = (0..interfaces.pairs.len()).map(bonds).collect();
    assert!(counts.iter().all(|count| [0, 1, 19].contains(count)), "{counts:?}");
    // All bonds of the site set: those inside elements and those across, found site by site.
    let across = mesh
        .sites
        .iter()
        .flat_map(|a| triangular::NEAREST.map(|v| (a, [a[0] + v[0], a[1] + v[1]])));
    let across = across.filter(|&(a, b)| mesh.owner_of(b).is_some_and(|owner| Some(owner) != mesh.owner_of(a)));
    assert_eq!(counts.iter().sum::<i32>() as usize, across.count());
    // An upright triangle in the middle of a row: three edges of 19 bonds, three corner bonds; half of each belongs to it.
    let inner = 2 * 13 + 3;
    let own: i32 = interfaces.of(inner).iter().map(|&number| bonds(number as usize)).sum();
    assert_eq!(own, 57 + 3);
}

#[test]
fn long_bonds_between_unlike_triangles_are_all_listed_once() {
    for element in [7, 10, 4] {
        let mesh = mesh(element, None);
        let interfaces = Interfaces::new(&mesh, 2.4);
        let mut listed = 0;
        for (number, pair) in interfaces.pairs.iter().enumerate() {
            let [first, second] = pair.both().map(|e| mesh.elements[e as usize]);
            for string in interfaces.strings(number) {
                for t in 0..string.count {
                    let [a, b] = string.ends(t);
                    let [a, b] = [first.site(a), second.site(b)];
                    assert_eq!(shift(a, string.bond, 1), b);
                    assert!(first.contains(a) && second.contains(b));
                    listed += 1;
                }
            }
        }
        let triangle = |site| mesh.owner_of(site).filter(|&owner| owner < mesh.triangles);
        let half = triangular::half_vectors_within(2.4);
        let across = mesh
            .sites
            .iter()
            .flat_map(|a| half.iter().map(move |v| (a, shift(a, *v, 1))));
        let expected = across.filter(|&(a, b)| match (triangle(a), triangle(b)) {
            (Some(first), Some(second)) => first != second,
            _ => false,
        });
        assert_eq!(listed, expected.count(), "element {element}");
    }
}

#[test]
fn every_triangle_meets_its_neighbours_in_rising_order_and_alike_ones_follow_each_other() {
    let mesh = mesh(10, Some(30.0));
    let interfaces = Interfaces::new(&mesh, 1.4);
    for triangle in 0..mesh.triangles {
        let pairs = interfaces
            .of(triangle)
            .iter()
            .map(|&number| interfaces.pairs[number as usize]);
        let met: Vec<u32> = pairs.map(|pair| pair.first ^ pair.second ^ triangle as u32).collect();
        assert!(met.is_sorted() && met.len() > 2);
    }
    let has_strings = |pair: &Interface| !interfaces.kinds[pair.kind as usize].strings.is_empty();
    assert!(interfaces.pairs.is_sorted_by_key(|pair| !has_strings(pair)));
    let runs = interfaces
        .pairs
        .chunk_by(|a, b| a.kind == b.kind && b.first == a.first + 1);
    assert!(8 * runs.count() < interfaces.pairs.len() * 3, "long runs");
}

#[test]
fn interfaces_along_the_cut_are_severed_and_their_triangles_exposed() {
    let mesh = mesh(10, Some(30.0));
    let interfaces = Interfaces::new(&mesh, 1.4);
    let severed = interfaces.pairs.iter().filter(|pair| pair.severed).count();
    assert!(severed > 4 && severed < interfaces.pairs.len() / 4);
    let across = |pair: &Interface| {
        let rows = pair
            .both()
            .map(|e| mesh.elements[e as usize].row < mesh.cut.unwrap().row);
        rows[0] != rows[1]
    };
    assert!(interfaces.pairs.iter().filter(|pair| pair.severed).all(across));
}

#[test]
fn the_interfaces_of_some_triangles_are_those_of_all_with_the_same_numbers_in_the_same_order() {
    for (element, crack) in [(10, Some(30.0)), (7, None), (4, Some(20.0))] {
        let mesh = mesh(element, crack);
        let all = Interfaces::new(&mesh, 1.4);
        let groups = mesh.groups.all();
        for count in [2, 3, 5] {
            let cut = |part: usize| match groups.get(part * groups.len() / count) {
                Some(group) => group.elements.start,
                None => mesh.triangles,
            };
            // Surveys of equal shares, whatever groups they cut, tell what one of all does.
            let share = |part: usize| part * mesh.triangles / count..(part + 1) * mesh.triangles / count;
            let mut surveys: Vec<Survey> = (0..count).map(|part| Survey::new(&mesh, 1.4, share(part))).collect();
            let told: Vec<Told> = surveys.iter_mut().map(Survey::tell).collect();
            let told = Told::joined(&told);
            assert_eq!(told, all.told, "element {element}, {count} parts");
            for (part, survey) in surveys.into_iter().enumerate() {
                let mine = cut(part)..cut(part + 1);
                let some = Interfaces::of_triangles(&mesh, survey, told.clone(), mine.clone());
                let is_mine = |pair: &Interface| pair.both().iter().any(|&t| mine.contains(&(t as usize)));
                let expected = all.pairs.iter().enumerate().filter(|(_, pair)| is_mine(pair));
                let expected: Vec<(usize, Interface)> = expected.map(|(number, pair)| (number, *pair)).collect();
                let found = some.pairs.iter().enumerate();
                let found: Vec<(usize, Interface)> = found
                    .map(|(place, pair)| (some.number_of(place) as usize, *pair))
                    .collect();
                assert_eq!(found, expected, "element {element}, part {part} of {count}");
                assert_eq!((some.count(), &some.kinds), (all.pairs.len(), &all.kinds));
                for number in 0..all.pairs.len() {
                    let place = some.place_of(number as u32).map(|place| some.pairs[place]);
                    assert_eq!(place, Some(all.pairs[number]).filter(is_mine));
                }
                for triangle in mine.clone() {
                    let numbers = some.of(triangle).iter().map(|&place| some.number_of(place as usize));
                    assert!(numbers.eq(all.of(triangle).iter().copied()));
                }
            }
        }
    }
}
