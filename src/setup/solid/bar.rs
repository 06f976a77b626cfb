//! A solid that is pulled or struck at a face, as a bar between that face and what is held opposite.

use super::material;
use super::plan::{ALONG_ITSELF, Laid, dot, lay_out};
use crate::material::{Cubic, Material};
use crate::study::case::Solid;
use crate::study::case::solid::Loading;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bar {
    /// Along the load, out of the loaded face, of length 1.
    pub along: [f64; 3],
    /// From what is held to the loaded face, along the load, nm.
    pub length: f64,
    /// Across the load, nm^2.
    pub cross_section: f64,
    /// eV ps^2/nm^5
    pub density: f64,
    /// Young's modulus of the crystal along it, eV/nm^3.
    pub young_modulus: f64,
}

/// What a solid is along its load.
pub fn bar(solid: &Solid) -> Option<Bar> {
    let material = material(solid).ok()?;
    lay_out(solid, material.spacing).ok()?.bar(solid, &material)
}

impl Laid {
    /// `None` under other loads, and where the load is along its face.
    pub fn bar(&self, solid: &Solid, material: &Material) -> Option<Bar> {
        let (Loading::Traction { face, .. } | Loading::Pulse { face, .. }) = solid.loading else {
            return None;
        };
        let pull = self.pull_direction(solid);
        let outward = dot(pull, self.outward(face));
        if outward.abs() <= ALONG_ITSELF {
            return None;
        }
        let held = solid.held.as_ref().filter(|held| held.faces.contains(&face.opposite()));
        let held = held.map_or(0.0, |held| self.depth(face.axis, held.depth));
        let [i, j, k] = self.plan.sites.frame.lattice(pull);
        let crystal = Cubic::of(material);
        Some(Bar {
            along: pull.map(|part| part * outward.signum()),
            length: (self.thickness(face.axis) - held) / outward.abs(),
            cross_section: self.area(face.axis) * outward.abs(),
            density: crystal.density,
            young_modulus: crystal.young_modulus([j + k, i + k, i + j]),
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::setup::solid::{lay_out, material};
    use crate::{plan, study};

    #[test]
    fn a_bar_of_blocks_is_as_long_as_its_free_blocks_and_as_wide_as_their_volume_says() {
        let text = "study: bar\nbase:\n  material:\n    potential: {lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: \
                    0.34 nm}}\n    mass: 63.546 u\n  specimen: {lattice: fcc, blocks: [2, 2, 9], block: 5}\n  resolution: \
                    {element: 5}\n  held: {faces: [a3-low]}\n  run: {until: {time: 5 ps}}\n  loading: {pulse: {face: a3-high, \
                    shape: half-sine, duration: 10 ps, stress: [-50 MPa, -28.8675 MPa, -81.6497 MPa]}}\n";
        let read = study::read_text("study.yaml", text).expect("it can be read");
        let planned = plan::plan(&read).unwrap_or_else(|error| panic!("{error}"));
        let case = &planned.cases[0].case;
        let solid = case.solid().expect("it is a solid");
        let material = material(solid).expect("it binds");
        let laid = lay_out(solid, material.spacing).expect("it can be laid out");
        let bar = laid.bar(solid, &material).expect("it is struck along itself");
        assert!((bar.length / (40.0 * material.spacing) - 1.0).abs() < 1e-6, "{bar:?}");
        let volume = laid.volume() / 9.0 * 8.0;
        assert!((bar.length * bar.cross_section / volume - 1.0).abs() < 1e-6, "{bar:?}");
        assert!(bar.along[2] > 0.8, "{bar:?}");
        // C11 = 2 C12 = 2 C44: 1/E = s11 - (s11 - s12 - s44/2)/2 along <110>, with S from C.
        let [c11, c12] = [2.0, 1.0];
        let whole = (c11 - c12) * (c11 + 2.0 * c12);
        let [s11, s12, s44] = [(c11 + c12) / whole, -c12 / whole, 1.0];
        let expected = 1.0 / (s11 - 0.5 * (s11 - s12 - 0.5 * s44));
        let c12 = crate::material::Cubic::of(&material).c12;
        assert!((bar.young_modulus / c12 / expected - 1.0).abs() < 1e-6, "{bar:?}");
    }
}
