//! What must hold whatever the mesh, the potential and its cutoff.

mod bar;
mod crystal;
mod dispersion;
mod energy;
mod ledger;
mod models;
mod pulses;
mod running;
mod single_edge;
mod solid_pulses;
mod sponge;
mod statics;
mod strip;
mod symmetry;
mod torus;
mod toughness;
mod wrong_formulas;

use cgaft::forces::Planes;
use cgaft::material::Material;
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::potential::AtCutoff;

use crate::verify::specimens::lennard_jones;

/// Nearest neighbours only, with energy and force of the pairs that part going smoothly to zero.
fn smooth() -> Material {
    lennard_jones(1.9, AtCutoff::Smooth { from: 1.5 })
}

const SMOOTH: &str = "smooth 1.5 to 1.9";

/// Rows of triangles without crack.
fn block_mesh(block: i32, rows: i32, triangles: i32, element: u16, spacing: f64) -> Mesh {
    Mesh::new(&Plan {
        layout: Layout { block, rows, triangles },
        element,
        regions: vec![],
        crack: None,
        grip_rows: block,
        spacing,
    })
}

fn zeros(mesh: &Mesh) -> Planes {
    [vec![0.0; mesh.node_count()], vec![0.0; mesh.node_count()]]
}

fn largest(planes: &Planes) -> f64 {
    planes
        .iter()
        .flatten()
        .fold(0.0, |largest: f64, value| largest.max(value.abs()))
}
