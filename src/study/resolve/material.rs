//! Potential, mass and thickness.

use super::{At, Check, about, nanometres};
use crate::study::{
    case::{AtCutoff, Material, Potential, PotentialShape, Sheet},
    defaults,
    file::{self, Smooth},
    finding::{Finding, Place},
    quantity::{Length, Mass},
    reader::Given,
};

/// A site of more than this, or less than its inverse, is a slip of a unit, u.
const MOST_MASS: f64 = 1e15;

impl Check<'_> {
    /// The material of a slab, and the distance at which two atoms rest (nm), which may be known although the whole is not.
    pub fn sheet(&self, given: &Given<file::Material>, case: Place) -> (Option<Sheet>, Option<f64>) {
        let Some((values, place)) = self.section(given, case) else {
            return (None, None);
        };
        let (atoms, spacing) = self.atoms(&values, place);
        let thickness = self.size(&values.thickness, place, "material.thickness");
        let parts = atoms.zip(thickness);
        (parts.map(|(atoms, (thickness, _))| Sheet { atoms, thickness }), spacing)
    }

    /// Potential and mass, and the distance at which two atoms rest, nm.
    pub fn atoms(&self, values: &file::Material, place: Place) -> (Option<Material>, Option<f64>) {
        let example = "{lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm}}";
        let potential = self.need(&values.potential, place, "material.potential", example);
        let potential = potential.and_then(|(potential, place)| self.potential(&potential, place));
        let spacing = potential.as_ref().map(|potential| minimum(&potential.shape));
        let mass = self.mass(&values.mass, place);
        let parts = potential.zip(mass);
        (
            parts.map(|(potential, (mass, _))| Material { potential, mass }),
            spacing,
        )
    }

    /// Of a site, u.
    fn mass(&self, given: &Given<Mass>, section: Place) -> Option<At<f64>> {
        let (mass, place) = self.size(given, section, "material.mass")?;
        if (1.0 / MOST_MASS..=MOST_MASS).contains(&mass) {
            return Some((mass, place));
        }
        let message = format!("a site of {mass:.1e} u is no atom");
        self.add(Finding::at(place, message).help("write the mass of one atom, such as 802 u"));
        None
    }

    fn potential(&self, given: &file::Potential, place: Place) -> Option<Potential> {
        let (shape, (cutoff, at_cutoff)) = match given {
            file::Potential::LennardJones(values) => {
                let epsilon = self.size(&values.epsilon, place, "lennard-jones.epsilon");
                let sigma = self.size(&values.sigma, place, "lennard-jones.sigma");
                let shape = epsilon.zip(sigma).map(|(e, s)| PotentialShape::LennardJones {
                    epsilon: e.0,
                    sigma: s.0,
                });
                (
                    shape,
                    self.end(&values.cutoff, &values.at_cutoff, place, "lennard-jones.cutoff"),
                )
            }
            file::Potential::Morse(values) => {
                let depth = self.size(&values.depth, place, "morse.depth");
                let decay = self.size(&values.decay, place, "morse.decay");
                let distance = self.size(&values.distance, place, "morse.distance");
                let shape = depth.zip(decay).zip(distance);
                let shape = shape.map(|((depth, decay), distance)| PotentialShape::Morse {
                    depth: depth.0,
                    decay: decay.0,
                    distance: distance.0,
                });
                (
                    shape,
                    self.end(&values.cutoff, &values.at_cutoff, place, "morse.cutoff"),
                )
            }
            file::Potential::HarmonicBond(values) => {
                let stiffness = self.size(&values.stiffness, place, "harmonic-bond.stiffness");
                let distance = self.size(&values.distance, place, "harmonic-bond.distance");
                let shape = stiffness.zip(distance);
                let shape = shape.map(|(stiffness, distance)| PotentialShape::HarmonicBond {
                    stiffness: stiffness.0,
                    distance: distance.0,
                });
                (
                    shape,
                    self.end(&values.cutoff, &values.at_cutoff, place, "harmonic-bond.cutoff"),
                )
            }
        };
        let (shape, (cutoff, place)) = (shape?, cutoff?);
        let minimum = minimum(&shape);
        if cutoff <= minimum {
            let message = format!(
                "the cutoff ({}) is not beyond the minimum of the potential ({}): no pair would ever attract",
                nanometres(cutoff),
                about(minimum)
            );
            self.add(Finding::at(place, message).help(format!("write a cutoff such as {}", about(1.33 * minimum))));
            return None;
        }
        let at_cutoff = at_cutoff?;
        if let AtCutoff::Smooth { from } = at_cutoff
            && from <= minimum
        {
            let message = format!(
                "`smooth` begins at {}, where the bonds of the crystal are at rest ({}) or shorter: it would change all of them",
                nanometres(from),
                about(minimum)
            );
            let begin = about(0.5 * (minimum + cutoff));
            self.add(
                Finding::at(beginning(given).unwrap_or(place), message)
                    .help(format!("let it begin beyond, such as `from: {begin}`")),
            );
            return None;
        }
        Some(Potential {
            shape,
            cutoff,
            at_cutoff,
        })
    }

    /// The cutoff and what happens there. For a smooth end the cutoff is where it has gone to zero.
    fn end(
        &self,
        cutoff: &Given<Length>,
        at_cutoff: &Given<file::AtCutoff>,
        potential: Place,
        path: &str,
    ) -> (Option<At<f64>>, Option<AtCutoff>) {
        match at_cutoff {
            Given::Right(file::AtCutoff::Smooth(values), place) => self.smooth_end(cutoff, values, *place, path),
            Given::Right(file::AtCutoff::Truncated, _) => {
                (self.size(cutoff, potential, path), Some(AtCutoff::Truncated))
            }
            Given::Right(file::AtCutoff::Shifted, _) => (self.size(cutoff, potential, path), Some(AtCutoff::Shifted)),
            Given::Absent => (self.size(cutoff, potential, path), Some(defaults::AT_CUTOFF)),
            // Whether a cutoff is needed hangs on what could not be read.
            Given::Wrong(_) => (self.size_if_given(cutoff, path).flatten(), None),
        }
    }

    fn smooth_end(
        &self,
        cutoff: &Given<Length>,
        smooth: &Smooth,
        place: Place,
        path: &str,
    ) -> (Option<At<f64>>, Option<AtCutoff>) {
        let from = self.size(&smooth.from, place, "smooth.from");
        let to = self.size(&smooth.to, place, "smooth.to");
        let cutoff = self.size_if_given(cutoff, path);
        if let (Some((from, at)), Some((to, until))) = (from, to)
            && from >= to
        {
            let message = format!(
                "`smooth` must end beyond its beginning: from {} to {}",
                nanometres(from),
                nanometres(to)
            );
            self.add(
                Finding::at(at, message)
                    .with(until, "ends here")
                    .help("make `from` the smaller one"),
            );
            return (None, None);
        }
        if let (Some(Some((cutoff, at))), Some((to, until))) = (cutoff, to)
            && cutoff != to
        {
            let message = format!(
                "the cutoff is {}, but `smooth` ends at {}",
                nanometres(cutoff),
                nanometres(to)
            );
            self.add(
                Finding::at(at, message)
                    .with(until, "ends here")
                    .help("leave the cutoff out: a smooth end sets it"),
            );
            return (None, None);
        }
        (to, from.map(|(from, _)| AtCutoff::Smooth { from }))
    }
}

/// Where a smooth end says from where on.
fn beginning(potential: &file::Potential) -> Option<Place> {
    let at_cutoff = match potential {
        file::Potential::LennardJones(values) => &values.at_cutoff,
        file::Potential::Morse(values) => &values.at_cutoff,
        file::Potential::HarmonicBond(values) => &values.at_cutoff,
    };
    match at_cutoff.right()? {
        file::AtCutoff::Smooth(smooth) => smooth.from.place(),
        file::AtCutoff::Truncated | file::AtCutoff::Shifted => None,
    }
}

/// Distance at which two atoms rest, nm.
fn minimum(shape: &PotentialShape) -> f64 {
    match *shape {
        PotentialShape::LennardJones { sigma, .. } => 2_f64.powf(1.0 / 6.0) * sigma,
        PotentialShape::Morse { distance, .. } | PotentialShape::HarmonicBond { distance, .. } => distance,
    }
}
