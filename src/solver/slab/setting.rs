//! What the analysis must know of a specimen.

use super::probe;
use crate::analysis::series::{CrackFrom, Setting};
use crate::loading::SlabLoad;
use crate::material::{Elasticity, Material, WaveSpeeds};
use crate::mesh::Mesh;
use crate::mesh::cut::Side;

/// Gathers what the analysis must know.
pub fn setting(mesh: &Mesh, material: &Material, loading: &SlabLoad, thickness: f64) -> Setting {
    let elasticity = Elasticity::of(material);
    let speeds = WaveSpeeds::of(material);
    let left = mesh.sites.left();
    let [low, high] = mesh.grip_edges();
    let side = mesh.cut.map_or(Side::Left, |cut| cut.side(mesh));
    let length = mesh.cut.map_or(0.0, |cut| cut.length(mesh));
    let (crack_from, measured) = match side {
        Side::Left => (CrackFrom::Left, length),
        Side::Right => {
            let edge = (mesh.sites.right() - left) * mesh.spacing;
            (CrackFrom::Right { edge }, length)
        }
        Side::Inside { center } => {
            let center = center * mesh.spacing;
            (CrackFrom::Inside { center }, 0.5 * length)
        }
    };
    Setting {
        spacing: mesh.spacing,
        length: mesh.sites.layout.length() * mesh.spacing,
        left_x: left * mesh.spacing,
        height: high - low,
        crack_row: mesh.cut.map(|cut| cut.row),
        crack_from,
        crack_length: measured * mesh.spacing,
        strain_rate: loading.strain_rate(),
        thickness,
        longitudinal_speed: speeds.longitudinal,
        transverse_speed: speeds.transverse,
        rayleigh_speed: speeds.rayleigh,
        young_modulus: elasticity.young_modulus(),
        poisson_ratio: elasticity.poisson_ratio(),
        fracture_energy: material.fracture_energy(),
        element_at_crack: probe::element_at_crack(mesh),
        nodes: mesh.node_count() as u64,
        elements: mesh.elements.len() as u64,
        represented_atoms: mesh.sites.len() as u64,
    }
}
