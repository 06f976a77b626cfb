//! What the analysis must know of a specimen.

use super::probe;
use crate::analysis::series::Setting;
use crate::loading::Stretching;
use crate::material::{Elasticity, Material, WaveSpeeds};
use crate::mesh::Mesh;

/// Gathers what the analysis must know.
pub fn setting(mesh: &Mesh, material: &Material, loading: &Stretching, thickness: f64) -> Setting {
    let elasticity = Elasticity::of(material);
    let speeds = WaveSpeeds::of(material);
    let left = mesh.sites.left();
    let [low, high] = mesh.grip_edges();
    Setting {
        spacing: mesh.spacing,
        length: mesh.sites.layout.length() * mesh.spacing,
        left_x: left * mesh.spacing,
        height: high - low,
        crack_row: mesh.cut.map(|cut| cut.row),
        crack_length: mesh.cut.map_or(0.0, |cut| (cut.to - left) * mesh.spacing),
        strain_rate: loading.rate,
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
