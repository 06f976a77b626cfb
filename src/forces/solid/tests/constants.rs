//! What closed forms say of the crystal, found from forces and energies of bodies.

use super::*;
use crate::material::Cubic;

/// Energy of all elements.
fn energy(forces: &mut Forces, position: &mut Planes) -> f64 {
    let mut force = position.clone();
    let mut measure = Measure::default();
    forces
        .compute_and_measure(position, &mut force, &mut measure)
        .expect("nothing flies away");
    (0..forces.mesh().elements.len())
        .map(|element| measure.energy(element))
        .sum()
}

/// The virial of the sites of the innermost part of a body under a small strain, over its volume: the stress there.
fn stress(material: Material, size: u16, gradient: [[f64; 3]; 3]) -> [f64; 6] {
    let n = i32::from(size.max(5));
    let frame = Frame::along([[1, 0, 0], [0, 1, 0], [0, 0, 1]], material.spacing);
    let sites = Sites {
        outline: Outline::Rhombohedron([5 * n, 5 * n, 5 * n]),
        frame,
        removed: vec![],
        cut: None,
    };
    let mesh = Solid::new(&Plan {
        sites,
        element: size,
        regions: vec![],
        spacing: material.spacing,
    });
    let mut position = displaced(&mesh, gradient, 0.0);
    let mut forces = Forces::new(mesh.clone(), material);
    let mut force = position.clone();
    let mut measure = Measure::default();
    forces
        .compute_and_measure(&mut position, &mut force, &mut measure)
        .expect("nothing flies away");
    let inner = |element: &usize| {
        mesh.elements[*element]
            .anchor
            .iter()
            .all(|&component| (2 * n..3 * n).contains(&component))
    };
    let inner: Vec<usize> = (0..mesh.elements.len()).filter(inner).collect();
    let sites: u64 = inner.iter().map(|&element| mesh.elements[element].site_count()).sum();
    let volume = sites as f64 * crate::lattice::fcc::SITE_VOLUME * material.spacing.powi(3);
    let mut sum = [0.0; 6];
    for element in inner {
        sum.iter_mut()
            .zip(measure.virial(element))
            .for_each(|(sum, part)| *sum += part / volume);
        // The patch test: an even strain leaves no force inside, whatever carries the sites.
        for node in mesh.nodes_of(element) {
            assert!(
                (0..3).all(|axis| force[axis][node].abs() < 1e-9),
                "{size}: {}",
                force[0][node]
            );
        }
    }
    sum
}

#[test]
fn blocks_and_atoms_have_the_elastic_constants_of_the_crystal() {
    // Lattice sums; 72, 36 and 36 with nearest neighbours.
    const STRAIN: f64 = 1e-6;
    const TOLERANCE: f64 = 1e-6;
    for cutoff in [SHORT, 2.5] {
        let material = material(cutoff);
        let Cubic { c11, c12, c44, .. } = Cubic::of(&material);
        for size in [1, 5] {
            let of = |gradient: [[f64; 3]; 3]| {
                let opposite = gradient.map(|row| row.map(|entry| -entry));
                let [more, less] = [gradient, opposite].map(|gradient| stress(material, size, gradient));
                std::array::from_fn::<f64, 6, _>(|part| (more[part] - less[part]) / (2.0 * STRAIN))
            };
            let stretched = of([[STRAIN, 0.0, 0.0], [0.0; 3], [0.0; 3]]);
            let sheared = of([[0.0, STRAIN, 0.0], [0.0; 3], [0.0; 3]]);
            for (found, expected) in [
                (stretched[0], c11),
                (stretched[1], c12),
                (stretched[2], c12),
                (sheared[5], c44),
            ] {
                assert!(
                    (found / expected - 1.0).abs() < TOLERANCE,
                    "{cutoff}, {size}: {found} for {expected}"
                );
            }
        }
    }
}

#[test]
fn parting_a_body_costs_the_surface_energy_of_its_bonds() {
    // [111]: planes of constant k. The energy of the cut is told without the jump that truncation makes.
    const TOLERANCE: f64 = 1e-8;
    let smooth = {
        let shape = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let law = CutPotential::new(shape, 1.5, AtCutoff::Smooth { from: 1.4 });
        Material::face_centred_cubic(Interaction::LennardJones(law), 1.0).expect("the potential binds")
    };
    let area_of = |n: i32| f64::from(n * n) * 0.75f64.sqrt() * smooth.spacing.powi(2);
    for size in [1, 5] {
        let parted = |n: i32| {
            let mesh = solid([n, n, 10], size, vec![], vec![], smooth.spacing);
            let mut forces = Forces::new(mesh.clone(), smooth);
            let mut position = mesh.node_positions();
            let before = energy(&mut forces, &mut position);
            for element in (0..mesh.elements.len()).filter(|&element| mesh.elements[element].anchor[2] >= 5) {
                mesh.nodes_of(element).for_each(|node| position[2][node] += 2.0);
            }
            energy(&mut forces, &mut position) - before
        };
        // The rims of a body have fewer bonds: second differences of the number of sites leave the face alone.
        let [small, middle, large] = [5, 10, 15].map(parted);
        let of_area = (large - 2.0 * middle + small) / (area_of(15) - 2.0 * area_of(10) + area_of(5));
        let expected = Cubic::parting_energy(&smooth, [1.0, 1.0, 1.0]);
        assert!(
            (of_area / expected - 1.0).abs() < TOLERANCE,
            "{size}: {of_area} for {expected}"
        );
    }
}

#[test]
fn parting_boxes_of_atoms_along_three_planes_costs_the_surface_energies_of_the_crystal() {
    // The number of bonds of a vector through a plane of m x n cells is bilinear in m and n: mixed second differences leave the
    // plane alone, without its rims.
    const TOLERANCE: f64 = 1e-8;
    let planes = [
        ([1, 1, 1], [-1, -1, 2], [1.0, 3f64.sqrt()]),
        ([1, 0, 0], [0, 0, 1], [2f64.sqrt(); 2]),
        ([1, 1, 0], [0, 0, 1], [1.0, 2f64.sqrt()]),
    ];
    for (cutoff, at_cutoff) in [(1.5, AtCutoff::Smooth { from: 1.4 }), (2.5, AtCutoff::Shifted)] {
        let shape = LennardJones {
            epsilon: 1.0,
            sigma: 1.0,
        };
        let law = CutPotential::new(shape, cutoff, at_cutoff);
        let material = Material::face_centred_cubic(Interaction::LennardJones(law), 1.0).expect("the potential binds");
        for (normal, z, periods) in planes {
            let y = [
                z[1] * normal[2] - z[2] * normal[1],
                z[2] * normal[0] - z[0] * normal[2],
                z[0] * normal[1] - z[1] * normal[0],
            ];
            let parted = |cells: [f64; 2]| {
                let [height, width] = [0, 1].map(|axis| cells[axis] * periods[axis] - 0.1);
                let mesh = Solid::new(&Plan {
                    sites: Sites {
                        outline: Outline::Box([8.0, height, width].map(|side| side * material.spacing)),
                        frame: Frame::along([normal, y, z], material.spacing),
                        removed: vec![],
                        cut: None,
                    },
                    element: 1,
                    regions: vec![],
                    spacing: material.spacing,
                });
                let mut position = mesh.node_positions();
                let mut forces = Forces::new(mesh, material);
                let before = energy(&mut forces, &mut position);
                let beyond = |place: &&mut f64| **place > 4.1 * material.spacing;
                position[0].iter_mut().filter(beyond).for_each(|place| *place += 4.0);
                energy(&mut forces, &mut position) - before
            };
            let [few, many] = [4.0, 6.0];
            let of_cells = parted([many, many]) - parted([many, few]) - parted([few, many]) + parted([few, few]);
            let area = (many - few).powi(2) * periods[0] * periods[1] * material.spacing.powi(2);
            let expected = Cubic::parting_energy(&material, normal.map(f64::from));
            assert!(
                (of_cells / area / expected - 1.0).abs() < TOLERANCE,
                "{normal:?}, {cutoff}: {} for {expected}",
                of_cells / area
            );
        }
    }
}
