//! What becomes of a pair potential at its cutoff, and of the faces of a crack that was cut on purpose.

use pulp::{Simd, WithSimd};

use super::PairShape;
use crate::lanes::Lanes;

/// The treatment of the cutoff.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AtCutoff {
    /// Cut where it stands: energy and force jump. The source and its MD reference do this.
    Truncated,
    /// The energy is shifted to zero at the cutoff; the force jumps, the energy of the system does not.
    Shifted,
    /// Taken to zero between `from` and the cutoff, with two continuous derivatives, by the factor
    /// (1 - s)^3 (1 + 3 s + 6 s^2), s = (r - from)/(cutoff - from); untouched below `from`.
    Smooth { from: f64 },
}

/// Energy of a pair, eV, and phi'(r)/r, eV/nm^2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairValue {
    pub energy: f64,
    /// phi'(r)/r: the force on the first of two sites is this times the vector from the first to the second.
    pub slope: f64,
}

/// A pair potential with its cutoff.
#[derive(Clone, Copy, Debug)]
pub struct CutPotential<S> {
    shape: S,
    at_cutoff: AtCutoff,
    cutoff: f64,
    squared_cutoff: f64,
    /// Beyond this squared distance the switch acts; infinite without one.
    squared_switch: f64,
    shift: f64,
}

impl<S: PairShape> CutPotential<S> {
    /// Zero from the cutoff on, nm.
    pub fn new(shape: S, cutoff: f64, at_cutoff: AtCutoff) -> Self {
        let (energy_at_cutoff, _) = shape.energy_and_slope(cutoff * cutoff);
        let (squared_switch, shift) = match at_cutoff {
            AtCutoff::Truncated => (f64::INFINITY, 0.0),
            AtCutoff::Shifted => (f64::INFINITY, energy_at_cutoff),
            AtCutoff::Smooth { from } => (from * from, 0.0),
        };
        Self {
            shape,
            at_cutoff,
            cutoff,
            squared_cutoff: cutoff * cutoff,
            squared_switch,
            shift,
        }
    }

    /// nm
    pub fn cutoff(&self) -> f64 {
        self.cutoff
    }

    /// nm^2
    #[inline(always)]
    pub fn squared_cutoff(&self) -> f64 {
        self.squared_cutoff
    }

    /// Energy and phi'/r; zero from the cutoff on.
    #[inline(always)]
    pub fn evaluate(&self, squared_distance: f64) -> PairValue {
        if squared_distance >= self.squared_cutoff {
            return PairValue::default();
        }
        let (energy, slope) = self.shape.energy_and_slope(squared_distance);
        if squared_distance > self.squared_switch {
            return self.switched(squared_distance, energy, slope);
        }
        PairValue {
            energy: energy - self.shift,
            slope,
        }
    }

    /// phi'/r alone; zero from the cutoff on.
    #[inline(always)]
    pub fn slope(&self, squared_distance: f64) -> f64 {
        self.evaluate(squared_distance).slope
    }

    /// phi'/r of several pairs at once; zero from the cutoff on.
    #[inline(always)]
    pub fn slopes<L: Simd>(&self, simd: L, squared_distances: Lanes<L>) -> Lanes<L> {
        let [_, slopes] = self.values(simd, squared_distances);
        slopes
    }

    /// phi'/r of several pairs that are known to be [within the untouched range](Self::squared_untouched).
    #[inline(always)]
    pub fn untouched_slopes<L: Simd>(&self, simd: L, squared_distances: Lanes<L>) -> Lanes<L> {
        self.shape.slopes(simd, squared_distances)
    }

    /// Up to this squared distance phi'/r is that without a cutoff, nm^2.
    pub fn squared_untouched(&self) -> f64 {
        self.squared_cutoff.min(self.squared_switch)
    }

    /// Energies and phi'/r of several pairs at once; zero from the cutoff on.
    #[inline(always)]
    pub fn values<L: Simd>(&self, simd: L, squared_distances: Lanes<L>) -> [Lanes<L>; 2] {
        let [energies, mut slopes] = self.shape.energies_and_slopes(simd, squared_distances);
        let mut shifted = energies - Lanes::all(simd, self.shift);
        if let AtCutoff::Smooth { from } = self.at_cutoff {
            let is_switched = squared_distances.is_above(self.squared_switch);
            if is_switched.any() {
                let switched = simd.vectorize(Switched {
                    law: *self,
                    from,
                    squared_distances,
                    uncut: [energies, slopes],
                });
                shifted = switched[0].where_or(is_switched, shifted);
                slopes = switched[1].where_or(is_switched, slopes);
            }
        }
        let is_within = squared_distances.is_below(self.squared_cutoff);
        let zero = Lanes::all(simd, 0.0);
        [shifted.where_or(is_within, zero), slopes.where_or(is_within, zero)]
    }

    /// The switching factor and its first two derivatives of several pairs within the range of the switch.
    #[inline(always)]
    fn switches<L: Simd>(&self, simd: L, from: f64, distances: Lanes<L>) -> [Lanes<L>; 3] {
        let one = Lanes::all(simd, 1.0);
        let inverse_width = 1.0 / (self.cutoff - from);
        let s = (distances - Lanes::all(simd, from)) * inverse_width;
        let rest = one - s;
        let polynomial = s.mul_add(s.times_add(6.0, Lanes::all(simd, 3.0)), one);
        let factor = rest * rest * rest * polynomial;
        let first = (s * rest) * (s * rest) * (-30.0 * inverse_width);
        let second = (s * rest) * (rest - s) * (-60.0 * inverse_width * inverse_width);
        [factor, first, second]
    }

    #[cold]
    fn switched(&self, squared_distance: f64, energy: f64, slope: f64) -> PairValue {
        let distance = squared_distance.sqrt();
        let [factor, derivative, _] = self.switch(distance);
        PairValue {
            energy: energy * factor,
            slope: slope * factor + energy * derivative / distance,
        }
    }

    /// The switching factor and its first two derivatives.
    fn switch(&self, distance: f64) -> [f64; 3] {
        let AtCutoff::Smooth { from } = self.at_cutoff else {
            return [1.0, 0.0, 0.0];
        };
        if distance <= from {
            return [1.0, 0.0, 0.0];
        }
        let width = self.cutoff - from;
        let s = (distance - from) / width;
        let rest = 1.0 - s;
        let factor = rest * rest * rest * (1.0 + 3.0 * s + 6.0 * s * s);
        let first = -30.0 * s * s * rest * rest / width;
        let second = -60.0 * s * rest * (1.0 - 2.0 * s) / (width * width);
        [factor, first, second]
    }

    /// phi'' of the cut potential; zero from the cutoff on.
    pub fn curvature(&self, distance: f64) -> f64 {
        if distance >= self.cutoff {
            return 0.0;
        }
        let [factor, first, second] = self.switch(distance);
        let (energy, slope) = self.shape.energy_and_slope(distance * distance);
        self.shape.curvature(distance) * factor + 2.0 * slope * distance * first + energy * second
    }

    /// phi'' of several pairs at once; zero from the cutoff on.
    #[inline(always)]
    pub fn curvatures<L: Simd>(&self, simd: L, squared_distances: Lanes<L>) -> Lanes<L> {
        let mut curvatures = self.shape.curvatures(simd, squared_distances);
        if let AtCutoff::Smooth { from } = self.at_cutoff {
            let is_switched = squared_distances.is_above(self.squared_switch);
            if is_switched.any() {
                let distances = squared_distances.square_root();
                let [factor, first, second] = self.switches(simd, from, distances);
                let [energies, slopes] = self.shape.energies_and_slopes(simd, squared_distances);
                let of_slopes = slopes * distances * first * 2.0;
                let switched = curvatures.mul_add(factor, energies.mul_add(second, of_slopes));
                curvatures = switched.where_or(is_switched, curvatures);
            }
        }
        curvatures.where_or(squared_distances.is_below(self.squared_cutoff), Lanes::all(simd, 0.0))
    }

    /// Repulsion between the faces of a cut: the potential up to its minimum, zero beyond, stretched so that the
    /// minimum falls on `spacing` and nothing is pushed at the start.
    #[inline(always)]
    pub fn repulsion(&self, squared_distance: f64, spacing: f64) -> PairValue {
        if squared_distance >= spacing * spacing {
            return PairValue::default();
        }
        let minimum = self.shape.minimum();
        let scale = (minimum / spacing) * (minimum / spacing);
        let (energy, slope) = self.shape.energy_and_slope(squared_distance * scale);
        let (well, _) = self.shape.energy_and_slope(minimum * minimum);
        PairValue {
            energy: energy - well,
            slope: slope * scale,
        }
    }

    /// Energies and phi'/r of the repulsion of several pairs at once.
    #[inline(always)]
    pub fn repulsions<L: Simd>(&self, simd: L, squared_distances: Lanes<L>, spacing: f64) -> [Lanes<L>; 2] {
        let minimum = self.shape.minimum();
        let scale = (minimum / spacing) * (minimum / spacing);
        let [energies, slopes] = self.shape.energies_and_slopes(simd, squared_distances * scale);
        let (well, _) = self.shape.energy_and_slope(minimum * minimum);
        let is_near = squared_distances.is_below(spacing * spacing);
        let zero = Lanes::all(simd, 0.0);
        [
            (energies - Lanes::all(simd, well)).where_or(is_near, zero),
            (slopes * scale).where_or(is_near, zero),
        ]
    }

    /// Second derivative of the repulsion.
    pub fn repulsion_curvature(&self, distance: f64, spacing: f64) -> f64 {
        let scale = self.shape.minimum() / spacing;
        if distance < spacing {
            scale * scale * self.shape.curvature(distance * scale)
        } else {
            0.0
        }
    }

    /// What one pair's energy jumps by when it comes within the cutoff, eV.
    pub fn jump_at_cutoff(&self) -> f64 {
        match self.at_cutoff {
            AtCutoff::Truncated => self.shape.energy_and_slope(self.squared_cutoff).0,
            AtCutoff::Shifted | AtCutoff::Smooth { .. } => 0.0,
        }
    }

    /// Distance at which the energy is least, nm.
    pub fn minimum(&self) -> f64 {
        self.shape.minimum()
    }
}

/// Pairs in the range of the switch. They have a function of their own, so that the others do not pay for its roots.
struct Switched<S, T: Simd> {
    law: CutPotential<S>,
    from: f64,
    squared_distances: Lanes<T>,
    /// Energies and phi'/r without a cutoff.
    uncut: [Lanes<T>; 2],
}

impl<S: PairShape, T: Simd> WithSimd for Switched<S, T> {
    type Output = [Lanes<T>; 2];

    #[inline(always)]
    fn with_simd<L: Simd>(self, _: L) -> [Lanes<T>; 2] {
        let [energies, slopes] = self.uncut;
        let distances = self.squared_distances.square_root();
        let [factor, first, _] = self.law.switches(distances.simd(), self.from, distances);
        let of_slopes = slopes.mul_add(factor, energies * first * distances.inverse());
        [energies * factor, of_slopes]
    }
}

#[cfg(test)]
mod tests;
