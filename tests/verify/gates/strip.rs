//! The long strip between fixed grips, whose energy release rate is known exactly.

use cgaft::loading::Grip;
use cgaft::mesh::sites::Layout;

use super::statics::{Shape, release, stored, strain_storing};
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
