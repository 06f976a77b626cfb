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
mod tests {
    use super::super::{HarmonicBond, LennardJones, Morse};
    use super::*;

    /// Central differences with a step of 1e-5 leave step^2/6 of the third derivative, which reaches 1e4 in the switch.
    const DIFFERENCE_ERROR: f64 = 1e-6;
    /// A few roundings, of which differences of nearly equal terms keep more.
    const ORDER_OF_OPERATIONS: f64 = 1e-13;
    const LJ: LennardJones = LennardJones {
        epsilon: 1.0,
        sigma: 1.0,
    };

    fn check_derivatives<S: PairShape>(shape: S, cutoff: f64, from: f64) {
        for at_cutoff in [AtCutoff::Truncated, AtCutoff::Shifted, AtCutoff::Smooth { from }] {
            let law = CutPotential::new(shape, cutoff, at_cutoff);
            let energy = |r: f64| law.evaluate(r * r).energy;
            let force = |r: f64| law.evaluate(r * r).slope * r;
            for k in 0..50 {
                let r = 0.95 + (cutoff - 0.96) * f64::from(k) / 50.0 + 1e-3;
                let step = 1e-5;
                let first = (energy(r + step) - energy(r - step)) / (2.0 * step);
                let second = (force(r + step) - force(r - step)) / (2.0 * step);
                assert!(
                    (first - force(r)).abs() < DIFFERENCE_ERROR * (1.0 + first.abs()),
                    "{shape:?} {at_cutoff:?} {r}"
                );
                assert!(
                    (second - law.curvature(r)).abs() < DIFFERENCE_ERROR * (1.0 + second.abs()),
                    "{at_cutoff:?} {r}"
                );
            }
            assert_eq!(law.evaluate(cutoff * cutoff), PairValue::default());
        }
    }

    #[test]
    fn slopes_and_curvatures_are_the_derivatives_of_the_energy_for_every_cutoff() {
        check_derivatives(LJ, 1.9, 1.5);
        check_derivatives(
            Morse {
                depth: 1.0,
                decay: 5.0,
                distance: 1.1,
            },
            1.8,
            1.5,
        );
        check_derivatives(
            HarmonicBond {
                stiffness: 60.0,
                distance: 1.1,
            },
            1.4,
            1.25,
        );
    }

    /// Compares what pairs at some distances are worth at once with what each is alone.
    struct AtOnce<S> {
        law: CutPotential<S>,
        distances: [f64; 8],
    }

    impl<S: PairShape> pulp::WithSimd for AtOnce<S> {
        type Output = ();

        fn with_simd<L: Simd>(self, simd: L) {
            let Self { law, distances } = self;
            let squared = distances.map(|distance| distance * distance);
            for from in (0..squared.len()).step_by(Lanes::<L>::COUNT) {
                let several = Lanes::load(simd, &squared, from);
                let [energies, slopes] = law.values(simd, several).map(Lanes::numbers);
                let curvatures = law.curvatures(simd, several).numbers();
                assert_eq!(slopes, law.slopes(simd, several).numbers());
                for lane in 0..Lanes::<L>::COUNT {
                    let alone = law.evaluate(squared[from + lane]);
                    let curvature = law.curvature(distances[from + lane]);
                    let expected = [alone.energy, alone.slope, curvature];
                    for (found, expected) in [energies[lane], slopes[lane], curvatures[lane]]
                        .into_iter()
                        .zip(expected)
                    {
                        let error = (found - expected).abs();
                        assert!(
                            error <= ORDER_OF_OPERATIONS * expected.abs(),
                            "{law:?}: {found} for {expected}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn several_pairs_at_once_are_worth_what_each_is_alone() {
        // Before the switch, within it and beyond the cutoff, apart and together.
        let all = [
            [0.9, 1.0, 1.2, 1.4, 1.0, 1.2, 0.95, 1.3],
            [1.0, 1.6, 1.75, 1.0, 1.4, 1.9, 2.5, 1.7],
        ];
        let morse = Morse {
            depth: 1.0,
            decay: 5.0,
            distance: 1.1,
        };
        for at_cutoff in [AtCutoff::Truncated, AtCutoff::Shifted, AtCutoff::Smooth { from: 1.5 }] {
            for distances in all {
                for arch in [pulp::Arch::new(), pulp::Arch::Scalar] {
                    let law = CutPotential::new(LJ, 1.9, at_cutoff);
                    arch.dispatch(AtOnce { law, distances });
                    let law = CutPotential::new(morse, 1.9, at_cutoff);
                    arch.dispatch(AtOnce { law, distances });
                }
            }
        }
    }

    #[test]
    fn the_nearest_neighbour_stiffness_is_72_over_the_squared_spacing() {
        let r0 = LJ.minimum();
        let law = CutPotential::new(LJ, 1.5, AtCutoff::Truncated);
        assert!((law.curvature(r0) - 72.0 / (r0 * r0)).abs() < 1e-12);
        assert!((law.evaluate(r0 * r0).energy + 1.0).abs() < 1e-15);
    }

    #[test]
    fn truncation_at_0_34_nm_jumps_by_a_third_of_the_well() {
        let law = CutPotential::new(LJ, 0.34 / 0.2277, AtCutoff::Truncated);
        assert!((law.jump_at_cutoff() + 0.328).abs() < 5e-4);
        assert!((law.evaluate((0.34f64 / 0.2277).powi(2) - 1e-12).slope * 0.34 / 0.2277 - 1.19).abs() < 5e-3);
    }

    #[test]
    fn the_smooth_cutoff_ends_without_energy_force_or_curvature_and_leaves_the_well_alone() {
        let law = CutPotential::new(LJ, 1.9, AtCutoff::Smooth { from: 1.5 });
        let end = law.evaluate((1.9f64 - 1e-6).powi(2));
        assert!(end.energy.abs() < 1e-14 && end.slope.abs() < 1e-9 && law.curvature(1.9 - 1e-6).abs() < 1e-3);
        let uncut = CutPotential::new(LJ, 9.0, AtCutoff::Truncated);
        assert_eq!(law.evaluate(2.1), uncut.evaluate(2.1));
        assert_eq!(law.jump_at_cutoff(), 0.0);
    }

    #[test]
    fn faces_of_a_cut_push_but_never_pull() {
        let law = CutPotential::new(LJ, 2.5, AtCutoff::Truncated);
        let spacing = 1.1132;
        assert_eq!(law.repulsion(spacing * spacing, spacing), PairValue::default());
        let pressed = law.repulsion(1.0, spacing);
        assert!(pressed.energy > 0.0 && pressed.slope < 0.0);
        let near = law.repulsion((spacing - 1e-7).powi(2), spacing);
        assert!(near.energy.abs() < 1e-12 && near.slope.abs() < 1e-4);
    }
}
