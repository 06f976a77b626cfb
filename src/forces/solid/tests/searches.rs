//! Neighbours are searched where something may meet, and only when it may.

use super::*;
use crate::domain::{Domain, Ranks};

/// Everything beyond a plane is lifted, the more the farther it is behind a front that moves along a1.
fn torn(mesh: &Solid, front: f64, beyond: i32) -> Planes {
    let mut position = mesh.node_positions();
    let spacing = mesh.spacing;
    for element in (0..mesh.elements.len()).filter(|&element| mesh.elements[element].anchor[2] >= beyond) {
        for node in mesh.nodes_of(element) {
            let behind = (front - position[0][node] / spacing).max(0.0);
            position[2][node] += spacing * (0.08 * behind).min(2.0);
        }
    }
    position
}

#[test]
fn a_crack_that_runs_is_summed_as_over_all_pairs_with_few_searches() {
    let material = material(SHORT);
    let ball = Region {
        shape: RegionShape::Ball {
            center: [15.0, 4.0, 4.0],
            radius: 2.0,
        },
        element: 1,
    };
    for regions in [vec![], vec![ball]] {
        let mesh = solid([30, 10, 10], 5, regions, vec![], material.spacing);
        let mut forces = Forces::new(mesh.clone(), material);
        let (mut openings, mut open) = (0, 0);
        for step in 0..60 {
            let mut position = torn(&mesh, 0.5 * f64::from(step), 5);
            let mut force = [0, 1, 2].map(|_| vec![0.0; mesh.node_count()]);
            forces.compute(&mut position, &mut force).expect("nothing flies away");
            openings += u64::from(forces.open_interfaces().len() > open);
            open = forces.open_interfaces().len();
            let mut anew = Forces::new(mesh.clone(), material);
            anew.restore_open_interfaces(&forces.open_interfaces());
            let mut again = force.clone();
            anew.compute(&mut position, &mut again).expect("nothing flies away");
            assert!(force == again, "step {step}");
            let (expected, _) = referee::forces(&mesh, &material, Summation::Exact, &position);
            let largest = expected
                .iter()
                .flatten()
                .fold(1.0, |most: f64, force| most.max(force.abs()));
            for (found, expected) in force.iter().flatten().zip(expected.iter().flatten()) {
                assert!((found - expected).abs() < ROUNDING * largest, "step {step}");
            }
        }
        let (searches, _) = forces.search_cost();
        assert!(openings > 15, "{openings}");
        assert!(searches < openings, "{searches} searches, {openings} openings");
    }
}

#[test]
fn faces_that_were_always_free_are_seen_when_they_meet() {
    let material = material(SHORT);
    let spacing = material.spacing;
    let slot = Range3 {
        from: [0, 0, 5],
        to: [15, 15, 10],
    };
    let mesh = solid([15, 15, 15], 5, vec![], vec![slot], spacing);
    let layers = mesh.sites.frame.vectors[2];
    let mut position = mesh.node_positions();
    let above = (0..mesh.elements.len()).filter(|&element| mesh.elements[element].anchor[2] >= 10);
    for node in above.flat_map(|element| mesh.nodes_of(element)) {
        (0..3).for_each(|axis| position[axis][node] -= 5.05 * layers[axis]);
    }
    assert_eq!(check_against_referee(mesh, material, position), 0);
}

#[test]
fn a_notched_film_that_is_whole_exposes_no_sites() {
    let material = material(SHORT);
    let slot = Range3 {
        from: [0, 20, 0],
        to: [10, 30, 10],
    };
    let mesh = solid([40, 40, 10], 10, vec![], vec![slot], material.spacing);
    let stretched = [[-0.005, 0.01, 0.0], [0.0, 0.02, 0.005], [0.0, 0.0, -0.02]];
    for gradient in [NONE, stretched] {
        let position = displaced(&mesh, gradient, 0.0);
        let interfaces = Interfaces::new(&mesh, 1.4);
        let domain = Domain::new(Ranks::alone(), &mesh, |_| 1.0);
        let scene = exposed::Scene {
            mesh: &mesh,
            interfaces: &interfaces,
            domain: &domain,
            position: &position,
            not_firm: &[],
            radius: drift::Lengths::new(material.interaction.cutoff(), material.spacing).radius,
        };
        let sides = exposed::Sides::new(&interfaces, &[]);
        let exposed = exposed::Exposed::new(&scene, sides);
        assert!(exposed.sites.is_empty() && exposed.parts.len() == mesh.parts);
    }
}
