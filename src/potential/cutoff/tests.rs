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

/// Pairs that a cut severs repel each other when nearer; their energies are differences from a well of depth 1.
const SPACING: f64 = 1.15;
const WELL: f64 = 1.0;

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
            let repulsions = law.repulsions(simd, several, SPACING).map(Lanes::numbers);
            for lane in 0..Lanes::<L>::COUNT {
                let alone = law.evaluate(squared[from + lane]);
                let curvature = law.curvature(distances[from + lane]);
                let severed = law.repulsion(squared[from + lane], SPACING);
                let [repelled, pushed] = repulsions.map(|of| of[lane]);
                assert!((repelled - severed.energy).abs() <= ORDER_OF_OPERATIONS * severed.energy.max(WELL));
                let expected = [alone.energy, alone.slope, curvature, severed.slope];
                let found = [energies[lane], slopes[lane], curvatures[lane], pushed];
                for (found, expected) in found.into_iter().zip(expected) {
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
