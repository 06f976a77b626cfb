//! How much stiffer than in the crystal a site is whose neighbours have come close.
//!
//! A bond between two elements stores at most twice what its two ends would store each against a wall. So what close
//! bonds add to the stiffness of a site is at most twice the sum of what each is stiffer than a bond of the crystal, and
//! what they add to the squared frequency of an element at most the largest such sum over the mass of a site: the shares
//! of a node in the sites of its element add up to no more than its lumped mass.

use super::regular::Regular;
use crate::domain::Ranks;
use crate::material::Material;
use crate::potential::{CutPotential, PairShape, with_law};

/// What close bonds do to some sites.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crowd {
    /// What they add to the stiffness of a site, in stiffnesses of a bond of the crystal: the most.
    pub excess: f64,
    /// The square of the shortest, nm^2; infinite where there is none.
    pub shortest: f64,
}

impl Crowd {
    pub const NONE: Self = Self {
        excess: 0.0,
        shortest: f64::INFINITY,
    };

    /// Of the sites of both.
    pub fn and(self, other: Self) -> Self {
        Self {
            excess: self.excess.max(other.excess),
            shortest: self.shortest.min(other.shortest),
        }
    }

    /// Takes note of a bond of the site that counts so many times.
    pub fn add<S: PairShape>(&mut self, close: Close, law: &CutPotential<S>, squared: f64, severed: bool, count: f64) {
        if squared < close.squared_length {
            self.excess += count * close.excess(law, squared, severed);
            self.shortest = self.shortest.min(squared);
        }
    }
}

/// What the close neighbours of a site are compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Close {
    /// Shorter bonds are close, nm^2.
    pub squared_length: f64,
    /// nm
    pub spacing: f64,
    /// phi'' of a bond of the crystal, eV/nm^2.
    stiffness: f64,
}

/// Levels of stiffness, each [`RATIO`] times the one before: as many as a word has bits for.
const LEVELS: u32 = 59;

/// Four levels double the stiffness. A step is at most 9 % shorter than it has to be.
const RATIO: f64 = 1.189_207_115_002_721;

impl Close {
    /// Bonds shorter than those of a regular lattice: these are found by search whatever has happened before, so that what
    /// is known of them depends on where the sites are and on nothing else.
    pub fn new(material: &Material) -> Self {
        let spacing = material.spacing;
        Self {
            squared_length: (Regular::LEAST * spacing).powi(2),
            spacing,
            stiffness: with_law!(material.interaction, law => law.curvature(spacing)),
        }
    }

    /// What a bond of this squared length adds to the stiffness of the sites at its ends, in stiffnesses of a bond of the
    /// crystal; `severed` by a cut.
    fn excess<S: PairShape>(&self, law: &CutPotential<S>, squared: f64, severed: bool) -> f64 {
        let along = match severed {
            true => law.repulsion_curvature(squared.sqrt(), self.spacing),
            false => law.curvature(squared.sqrt()),
        };
        2.0 * (along / self.stiffness - 1.0).max(0.0)
    }
}

/// The close bonds of a specimen as a rank knows them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CloseBonds {
    pub close: Close,
    /// eV ps^2/nm^2
    site_mass: f64,
    /// How much they stiffen the sites of all ranks at the positions of the last forces.
    level: u32,
    /// The shortest of this rank so far, nm; infinite before there is one.
    shortest: f64,
}

impl CloseBonds {
    pub fn new(material: &Material) -> Self {
        Self {
            close: Close::new(material),
            site_mass: material.site_mass,
            level: 0,
            shortest: f64::INFINITY,
        }
    }

    /// Takes note of what this rank has found in the last forces, and of what all have.
    pub fn note(&mut self, crowd: Crowd, level_of_all: u32) {
        self.shortest = self.shortest.min(crowd.shortest.sqrt());
        self.level = level_of_all;
    }

    /// What they may have added to the squared highest frequency when forces were last computed, 1/ps^2, the same on all ranks;
    /// with lumped masses.
    pub fn squared_frequency(&self) -> f64 {
        most(self.level) * self.close.stiffness / self.site_mass
    }

    /// The length of the shortest that any rank has seen so far, nm; infinite before there is one. All ranks must ask together.
    pub fn closest_approach(&self, ranks: Ranks) -> f64 {
        // The least of all ranks to the bit.
        -ranks.largest(-self.shortest)
    }

    /// Goes on from what was seen before, nm.
    pub fn restore_closest_approach(&mut self, length: f64) {
        self.shortest = length;
    }
}

/// The lowest level that holds an excess; 0 where there is none.
pub fn level(excess: f64) -> u32 {
    (0..LEVELS).find(|&level| excess <= most(level)).unwrap_or(LEVELS)
}

/// The largest excess of a level.
fn most(level: u32) -> f64 {
    (0..level).fold(1.0, |stiffness, _| stiffness * RATIO) - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_holds_every_excess_up_to_its_own_and_no_lower_one_does() {
        assert_eq!([level(0.0), level(1e-9), level(1e300)], [0, 1, LEVELS]);
        for number in 1..LEVELS {
            assert_eq!(level(most(number)), number);
            assert_eq!(level(most(number) * 1.001), number + 1);
        }
        assert!((most(4) - 1.0).abs() < 1e-12, "four levels double the stiffness");
    }
}
