//! Pair potentials: the shape of the interaction, and apart from it what happens at the cutoff.
//!
//! A potential knows no particles. Distances in nm, energies in eV; every quantity only has to be consistent.

mod cutoff;
mod harmonic_bond;
mod lennard_jones;
mod morse;
#[cfg(test)]
mod tests;

pub use cutoff::{AtCutoff, CutPotential, PairValue};
pub use harmonic_bond::HarmonicBond;
pub use lennard_jones::LennardJones;
pub use morse::Morse;

use pulp::Simd;

use crate::lanes::Lanes;

/// The uncut interaction of one pair as a function of its squared distance.
pub trait PairShape: Copy + Send + Sync + std::fmt::Debug {
    /// Energy phi and phi'(r)/r.
    fn energy_and_slope(&self, squared_distance: f64) -> (f64, f64);
    /// Energies phi and phi'(r)/r of several pairs at once.
    #[inline(always)]
    fn energies_and_slopes<L: Simd>(&self, simd: L, squared_distances: Lanes<L>) -> [Lanes<L>; 2] {
        let pairs = squared_distances
            .numbers()
            .map(|squared| self.energy_and_slope(squared));
        [
            Lanes::each(simd, |lane| pairs[lane].0),
            Lanes::each(simd, |lane| pairs[lane].1),
        ]
    }
    /// phi'(r)/r of several pairs at once.
    #[inline(always)]
    fn slopes<L: Simd>(&self, simd: L, squared_distances: Lanes<L>) -> Lanes<L> {
        let [_, slopes] = self.energies_and_slopes(simd, squared_distances);
        slopes
    }
    /// Second derivative phi''.
    fn curvature(&self, distance: f64) -> f64;
    /// phi'' of several pairs at once.
    #[inline(always)]
    fn curvatures<L: Simd>(&self, simd: L, squared_distances: Lanes<L>) -> Lanes<L> {
        let curvatures = squared_distances
            .numbers()
            .map(|squared| self.curvature(squared.sqrt()));
        Lanes::each(simd, |lane| curvatures[lane])
    }
    /// Distance at which the energy is lowest.
    fn minimum(&self) -> f64;
}

/// Any of the potentials, cut. Inner loops take it apart once by `with_law!`, so that each
/// potential has its own compiled loop.
#[derive(Clone, Copy, Debug)]
pub enum Interaction {
    LennardJones(CutPotential<LennardJones>),
    Morse(CutPotential<Morse>),
    HarmonicBond(CutPotential<HarmonicBond>),
}

/// Runs an expression with the concrete potential inside an [`Interaction`].
macro_rules! with_law {
    ($interaction:expr, $law:ident => $body:expr) => {
        match $interaction {
            $crate::potential::Interaction::LennardJones($law) => $body,
            $crate::potential::Interaction::Morse($law) => $body,
            $crate::potential::Interaction::HarmonicBond($law) => $body,
        }
    };
}
pub(crate) use with_law;

impl Interaction {
    /// Distance beyond which a pair does not interact.
    pub fn cutoff(&self) -> f64 {
        with_law!(self, law => law.cutoff())
    }

    /// Energy and phi'/r of a pair at this squared distance; zero beyond the cutoff.
    pub fn evaluate(&self, squared_distance: f64) -> PairValue {
        with_law!(self, law => law.evaluate(squared_distance))
    }

    /// Energy and phi'/r of a pair that a cut severs, at this squared distance, in a crystal with this spacing.
    pub fn repulsion(&self, squared_distance: f64, spacing: f64) -> PairValue {
        with_law!(self, law => law.repulsion(squared_distance, spacing))
    }

    /// Up to this squared distance phi'/r is that without a cutoff.
    pub fn squared_untouched(&self) -> f64 {
        with_law!(self, law => law.squared_untouched())
    }

    /// Second derivative of the energy at this distance; zero beyond the cutoff.
    pub fn curvature(&self, distance: f64) -> f64 {
        with_law!(self, law => law.curvature(distance))
    }

    /// What one pair's energy jumps by when it comes within the cutoff (zero unless truncated).
    pub fn jump_at_cutoff(&self) -> f64 {
        with_law!(self, law => law.jump_at_cutoff())
    }

    /// Distance at which the energy of a pair is lowest.
    pub fn minimum(&self) -> f64 {
        with_law!(self, law => law.minimum())
    }
}
