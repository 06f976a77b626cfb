//! The stress intensity of a severed plane under a traction, before anything moves.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use super::plan::{Laid, dot};
use crate::analysis::stress_intensity::handbook::factor_under_stress;
use crate::material::{Cubic, Material};
use crate::study::case::Solid;
use crate::study::case::solid::{Loading, Notch, Pull};

/// A severed plane as an edge crack in a strip under a uniform stress at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intensity {
    /// Along the plane and at right angles to its front, through the crack and through the solid, nm.
    pub crack: f64,
    pub width: f64,
    /// K = F sigma sqrt(pi a) with the handbook factor of an edge crack, of the stress normal to the plane, eV/nm^2.5.
    pub k: f64,
    /// K at which as much energy would be released as two surfaces cost, sqrt(2 gamma E'), eV/nm^2.5.
    pub griffith: f64,
}

impl Laid {
    /// `None` where nothing is severed, where no traction opens the plane from a face parallel to it, and where the crack is longer
    /// than the handbook knows.
    pub fn intensity(&self, solid: &Solid, material: &Material) -> Option<Intensity> {
        let (Some(Notch::Plane { normal, from, .. }), Some(cut)) = (&solid.notch, self.plan.sites.cut) else {
            return None;
        };
        let Loading::Traction { face, pull, .. } = solid.loading else {
            return None;
        };
        let stress = match pull {
            Pull::Stress(parts) => dot(parts, self.outward(face)),
            Pull::Pressure(pressure) => -pressure,
        };
        if face.axis != *normal || stress <= 0.0 {
            return None;
        }
        let [depth, _] = self.severed(solid)?;
        let frame = &self.plan.sites.frame;
        let placed = cut.placed(&frame.vectors);
        // The faces at which it begins and which it runs to may be aslant to the plane.
        let slant = dot(placed.ahead, self.normal(from.axis)).abs();
        let [crack, width] = [depth.actual, self.thickness(from.axis)].map(|thickness| thickness / slant);
        let in_the_cube = |direction: [f64; 3]| {
            let [i, j, k] = frame.lattice(direction);
            [j + k, i + k, i + j].map(|half_edges| half_edges * FRAC_1_SQRT_2)
        };
        let [up, ahead] = [placed.up, placed.ahead].map(in_the_cube);
        let modulus = Cubic::of(material).release_modulus(up, ahead);
        Some(Intensity {
            crack,
            width,
            k: factor_under_stress(crack / width)? * stress * (PI * crack).sqrt(),
            griffith: (Cubic::parting_energy(material, up) * modulus).sqrt(),
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::setup::solid::{lay_out, material};
    use crate::{plan, study};

    #[test]
    fn the_block_of_the_source_has_its_stress_intensity_by_the_edge_crack_over_that_of_griffith() {
        // [Deng2011] Fig. 6-10: 1.6 GPa on a block of 48 x 48 x 48 blocks of ten; severed over 19 of 48.
        let text = "study: block\nbase:\n  material:\n    potential: {lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, \
                    cutoff: 0.34 nm}}\n    mass: 802 u\n  specimen: {lattice: fcc, blocks: [48, 48, 48], block: 10}\n  \
                    resolution: {element: 10}\n  held: {faces: [a3-low]}\n  notch: {plane: {normal: a3, at: 50 nm, from: \
                    a1-low, depth: 39.7 nm}}\n  run: {until: {time: 5 ps}}\n  loading: {traction: {face: a3-high, stress: \
                    [0 GPa, 0 GPa, 1.6 GPa]}}\n";
        let read = study::read_text("study.yaml", text).expect("it can be read");
        let planned = plan::plan(&read).unwrap_or_else(|error| panic!("{error}"));
        let solid = planned.cases[0].case.solid().expect("it is a solid");
        let material = material(solid).expect("it binds");
        let laid = lay_out(solid, material.spacing).expect("it can be laid out");
        let found = laid.intensity(solid, &material).expect("a traction opens it");
        // Blocks of ten spacings, 60 degrees between the edges of the plane.
        let edge = 10.0 * material.spacing * 0.75_f64.sqrt();
        assert!((found.crack / (19.0 * edge) - 1.0).abs() < 1e-9 && (found.width / (48.0 * edge) - 1.0).abs() < 1e-9);
        // The factor by hand: 2.081 at 19/48.
        let by_hand = 2.081 * 1.6e3 * (std::f64::consts::PI * 19.0 * edge * 1e-9).sqrt();
        let megapascal = found.k * crate::units::EV_PER_NM3_SQRT_NM_IN_MPA_SQRT_M;
        assert!((megapascal / by_hand - 1.0).abs() < 1e-3, "{megapascal} {by_hand}");
        // Two (111) surfaces of three bonds a site cost 3 (phi(r_c) - phi(r0)) each 0.866 r0^2.
        let bond =
            material.interaction.jump_at_cutoff() - material.interaction.evaluate(material.spacing.powi(2)).energy;
        let surfaces = 3.0 * bond / (0.75_f64.sqrt() * material.spacing.powi(2));
        let modulus = found.griffith.powi(2) / surfaces;
        let c44 = crate::material::Cubic::of(&material).c44;
        // Young's modulus along [111] and along [100] of C11 = 2 C12 = 2 C44, over 1 - nu^2 with nu near 0.3.
        assert!((2.0..3.0).contains(&(modulus / c44)), "{}", modulus / c44);
    }
}
