//! The load at which a crack at rest starts, against Griffith's.

use cgaft::loading::Grip;
use cgaft::mesh::sites::Layout;

use super::statics::{Shape, Specimen, strain_storing};
use super::{SMOOTH, smooth};
use crate::verify::table::{Chapter, Gate};

/// Lattice trapping holds a crack up to 1.005 to 1.015 of Griffith's load.
const TRAPPING: f64 = 0.02;

/// K over Griffith's when the crack in a strip starts: the square root of the energy stored ahead over the energy of
/// two surfaces. The load rises by `step` from `from` until more bonds than `few` are broken.
fn start(shape: &Shape, crack_length: f64, [from, step]: [f64; 2], few: usize) -> f64 {
    let material = smooth();
    let mut specimen = Specimen::new(shape, crack_length);
    let mut load = from;
    loop {
        let stored = load * load * material.fracture_energy();
        specimen.stretch(strain_storing(shape, &material, stored));
        if specimen.breaks(few) {
            return load;
        }
        load += step;
        assert!(load < 4.0, "it does not break");
    }
}

fn strip(block: i32, rows: i32, triangles: i32, element: u16) -> Shape {
    Shape {
        layout: Layout { block, rows, triangles },
        element,
        grip_rows: block,
        grip: Grip::Clamped,
    }
}

#[test]
fn a_crack_between_atoms_starts_at_griffiths_load() {
    let mut gate = Gate::new(Chapter::Fracture, "6 toughness");
    // From so far below that a crack that starts too early fails too.
    let found = start(&strip(10, 8, 49, 1), 125.5, [0.9, 0.0025], 6);
    let setting = format!("{SMOOTH}, n = 1, strip of 275 x 53 r0");
    gate.near("static K_Ic over Griffith's", &setting, found, 1.0, TRAPPING);
    gate.close();
}

#[test]
fn the_load_at_which_cracks_between_triangles_start_is_reported() {
    let mut gate = Gate::new(Chapter::Fracture, "7 toughness of triangles");
    for size in [4, 10, 20] {
        let shape = strip(size, 16, 99, size as u16);
        // 40 % along, in the middle of an edge: it starts when that edge and more than the next one part.
        let crack = f64::from(20 * (size + 1)) + 0.5;
        let found = start(&shape, crack, [0.9, 0.01], 3 * size as usize);
        let setting = format!("{SMOOTH}, n = {size}, strip of 50 x 14 triangles");
        gate.report(
            "static K over Griffith's when one edge of a triangle has parted",
            &setting,
            found,
        );
    }
    gate.close();
}
