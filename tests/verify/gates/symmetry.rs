//! A symmetric problem has a symmetric answer.
//!
//! The rows of a specimen have no mirror in common, neither in x nor in y: its symmetry, with an even number of element
//! rows, is the half turn about its centre.

use std::collections::HashMap;

use cgaft::forces::Forces;
use cgaft::integrator::{kick, kick_and_drift, leap};
use cgaft::lattice::triangular;
use cgaft::loading::{Grip, Stretching};
use cgaft::mesh::Mesh;
use cgaft::mesh::cut::Cut;
use cgaft::mesh::element::Element;
use cgaft::state::State;

use super::{SMOOTH, block_mesh, smooth};
use crate::verify::table::{Chapter, Gate};

/// Rounding grows at a crack that is about to start.
const UNTIL_START: f64 = 1e-9;
const RATE: f64 = 2e-4;
/// Share of the stability limit.
const FRACTION: f64 = 0.5;

/// The node that a half turn brings every node to.
fn partners(mesh: &Mesh) -> Vec<usize> {
    let [first, last] = [mesh.sites.iter().next(), mesh.sites.iter().last()].map(|site| site.expect("there are sites"));
    let sum = [first[0] + last[0], first[1] + last[1]];
    let numbers: HashMap<Element, usize> = super::torus::numbered(mesh);
    let mut partners = vec![0; mesh.node_count()];
    for (number, element) in mesh.elements.iter().enumerate() {
        let turned = Element {
            sign: if element.is_atom() { 1 } else { -element.sign },
            column: sum[0] - element.column,
            row: sum[1] - element.row,
            ..*element
        };
        let other = numbers[&turned];
        for (node, partner) in mesh.nodes_of(number).zip(mesh.nodes_of(other)) {
            partners[node] = partner;
        }
    }
    partners
}

/// Largest departure from the half turn of the displacements, in spacings.
fn departure(state: &State, reference: &State, partners: &[usize], spacing: f64) -> f64 {
    let mut largest = 0.0f64;
    for axis in 0..2 {
        let displacement = |node: usize| state.position[axis][node] - reference.position[axis][node];
        for (node, &partner) in partners.iter().enumerate() {
            largest = largest.max((displacement(node) + displacement(partner)).abs());
        }
    }
    largest / spacing
}

#[test]
fn a_centre_crack_stays_symmetric_until_it_starts() {
    let mut gate = Gate::new(Chapter::Fracture, "9 symmetry");
    for element in [1, 10] {
        let material = smooth();
        let mut mesh = block_mesh(10, 8, 25, element, material.spacing);
        let [first, last] =
            [mesh.sites.iter().next(), mesh.sites.iter().last()].map(|site| site.expect("there are sites"));
        let centre = 0.5 * (triangular::position(first)[0] + triangular::position(last)[0]);
        // Bonds cross the cut at quarters of a spacing from the centre, never at its ends.
        mesh.cut = Some(Cut {
            row: mesh.sites.middle_row(),
            from: centre - 30.1,
            to: centre + 30.1,
        });
        let partners = partners(&mesh);
        let mut state = State::at_rest(mesh.node_positions(), mesh.lumped_masses());
        let loading = Stretching::new(&mesh, RATE, Grip::Clamped, true);
        loading.start(&mesh, &mut state);
        let reference = state.clone();
        let mut forces = Forces::new(mesh, material);
        forces.refresh(&state.position).expect("the lattice is sound");
        let bound = forces.squared_frequency_bound(&state);
        let step = FRACTION * cgaft::integrator::stability_limit(bound);
        let mut compute = |state: &mut State| {
            forces
                .compute(&mut state.position, &mut state.force)
                .expect("it stays sound");
            forces.broken_bonds(&state.position).len()
        };
        compute(&mut state);
        let nodes = state.every_node();
        let [mut until_start, mut later, mut time, mut broken] = [0.0f64, 0.0, 0.0, 0.0];
        while broken < 40.0 && time * RATE < 0.1 {
            kick_and_drift(&mut state, &nodes, leap(1, step));
            broken = compute(&mut state) as f64;
            kick(&mut state, &nodes, 0.5 * step);
            time += step;
            let departure = departure(&state, &reference, &partners, material.spacing);
            if broken == 0.0 {
                until_start = until_start.max(departure);
            }
            later = departure;
        }
        assert!(broken >= 40.0, "the crack starts");
        let setting = format!("{SMOOTH}, n = {element}, crack of 60 r0 in 143 x 69 r0");
        gate.below(
            "departure from a half turn until a bond breaks, over r0",
            &setting,
            until_start,
            UNTIL_START,
        );
        gate.report("the same after 40 bonds broke", &setting, later);
    }
    gate.close();
}
