//! The long strip between fixed grips, whose energy release rate is known exactly.

use cgaft::analysis::stress_intensity::RING_CLEAR_SHARE;
use cgaft::lattice::triangular;
use cgaft::loading::Grip;
use cgaft::mesh::sites::Layout;

use super::statics::{Shape, Specimen, release, stored, strain_storing};
use super::{SMOOTH, smooth};
use crate::verify::table::{Chapter, Gate};

/// Ends that are a few heights away still feel the tip a little.
const STRIP: f64 = 1e-2;

#[test]
fn a_strip_between_fixed_grips_releases_what_it_stores_ahead_of_the_crack() {
    let mut gate = Gate::new(Chapter::Fracture, "1 strip");
    let material = smooth();
    for element in [1, 10] {
        let layout = Layout {
            block: 10,
            rows: 6,
            triangles: 59,
        };
        let shape = Shape {
            layout,
            element,
            grip_rows: 10,
            grip: Grip::Clamped,
        };
        // Half of what Griffith asks for: the crack stays where it is.
        let strain = strain_storing(&shape, &material, 0.5 * material.fracture_energy());
        // One cell of triangles apart.
        let (released, _) = release(&shape, strain, [150.5, 161.5]);
        let expected = stored(&shape, &material, strain);
        let setting = format!("{SMOOTH}, n = {element}, 330 x 35 r0, half of Griffith's energy");
        gate.within("G = 2 h W(strain)", &setting, released, expected, STRIP);
    }
    gate.close();
}

/// A crack at 0.45 of a strip five heights long still feels its ends a little.
const RELEASED: f64 = 5e-3;
/// The rings see the same field at rest; what is left is the curvature of the field within a triangle.
const PATH: f64 = 1e-3;

#[test]
fn the_j_integral_in_a_strip_is_what_it_stores_ahead_whatever_the_ring() {
    let mut gate = Gate::new(Chapter::Fracture, "1 strip, J-integral");
    let material = smooth();
    // As many triangles of ten atoms per edge between tip and grips as there are rings and more, five heights long.
    for (element, rows, triangles) in [(1, 10, 69), (10, 22, 149)] {
        let shape = Shape {
            layout: Layout {
                block: 10,
                rows,
                triangles,
            },
            element,
            grip_rows: 10,
            grip: Grip::Clamped,
        };
        let strain = strain_storing(&shape, &material, 0.5 * material.fracture_energy());
        let mut specimen = Specimen::new(&shape, 0.45 * shape.layout.length());
        specimen.stretch(strain);
        specimen.relax();
        let half_height = 0.5 * f64::from(shape.gaps()) * triangular::ROW_HEIGHT;
        let found = specimen.j_integral(RING_CLEAR_SHARE * half_height);
        let expected = stored(&shape, &material, strain);
        let setting =
            format!("{SMOOTH}, n = {element}, strip of half height {half_height:.0} r0, half of Griffith's energy");
        for (ring, j) in ["inner", "middle", "outer"].into_iter().zip(found) {
            gate.within(
                &format!("J over the {ring} ring = 2 h W(strain)"),
                &setting,
                j,
                expected,
                RELEASED,
            );
        }
        let [low, high] = [
            found.into_iter().fold(f64::INFINITY, f64::min),
            found.into_iter().fold(0.0, f64::max),
        ];
        gate.below(
            "largest J over the smallest, less one",
            &setting,
            high / low - 1.0,
            PATH,
        );
    }
    gate.close();
}
