//! How much of a slab will become atoms, before anything is computed.

use crate::lattice::triangular;
use crate::material::{Elasticity, Material};
use crate::study::case::{self, Slab};

/// What elements will have become by the end of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// How far to either side of the crack, nm.
    pub half_width: f64,
    pub atoms: f64,
}

/// The growth of a crack that runs straight to its end under the K of Griffith; `None` where nothing becomes atoms.
///
/// At a distance r from the tip the strain is about K/(E sqrt(2 pi r)), and from one element to the next, over a distance d, it
/// falls by d/(2 r) of that. Elements in which this is more than the allowed error of what bonds can bear become atoms, and so
/// many layers around them. A crack that runs under a larger K leaves more behind.
pub fn growth(slab: &Slab, until: &case::Until, material: &Material) -> Option<Growth> {
    let case::Refine { error, ahead } = slab.resolution.refine?;
    let crack = slab.crack.as_ref()?;
    // The crack runs through the smallest.
    let regions = slab.resolution.regions.iter().map(|region| region.element);
    let elements = regions.chain([slab.resolution.element]).filter(|&element| element > 1);
    let pitch = f64::from(elements.min()? + 1) * material.spacing;
    // Between the centres of triangles on both sides of an edge.
    let apart = pitch / 3f64.sqrt();
    let young = Elasticity::of(material).young_modulus();
    let strain_at_1_nm = (young * material.fracture_energy()).sqrt() / (young * std::f64::consts::TAU.sqrt());
    let radius = (0.5 * strain_at_1_nm * apart / (error * material.critical_strain())).powf(2.0 / 3.0);
    let layers = f64::from(ahead + 1) * pitch * triangular::ROW_HEIGHT;
    let half_width = (radius + layers).min(0.5 * slab.specimen.width);
    let face = match crack.edge {
        case::Edge::Left | case::Edge::Right => slab.specimen.length,
        case::Edge::None { .. } => 0.5 * slab.specimen.length,
    };
    let way = (until.crack_length.unwrap_or(face).min(face) - crack.measured()).max(0.0) + half_width;
    let of_an_atom = triangular::SITE_AREA * material.spacing * material.spacing;
    Some(Growth {
        half_width,
        atoms: 2.0 * half_width * way / of_an_atom,
    })
}
