//! The sums over pairs of points along their lists, as many points at a time as the processor takes.

use pulp::{Simd, WithSimd};

use super::inside::within;
use super::lists::Lists;
use super::measure::{Held, PARTS};
use super::vector::Vector;
use crate::lanes::{Lanes, MOST, Mask};
use crate::potential::{CutPotential, PairShape};

/// As many numbers as there may be lanes.
pub type Side = [f64; MOST];

/// The sums of some groups of points.
pub struct Sum<'a, S, const MEASURED: bool> {
    pub law: CutPotential<S>,
    /// Shorter bonds are close, nm^2.
    pub close: f64,
    /// Number of the first group.
    pub first: usize,
    pub bonded: &'a Lists,
    pub severed: &'a Lists,
    /// Severed pairs repel each other when nearer than this, nm.
    pub spacing: f64,
    /// Whether points stand for other numbers of sites than one each.
    pub weighted: bool,
    /// Where each point is, and how many sites it stands for.
    pub places: &'a [[f64; 4]],
    pub force: &'a mut [[Side; 3]],
    pub held: &'a mut [[Side; PARTS]],
}

impl<S: PairShape, const MEASURED: bool> WithSimd for Sum<'_, S, MEASURED> {
    /// Groups with close bonds.
    type Output = Vec<usize>;

    #[inline(always)]
    fn with_simd<L: Simd>(self, simd: L) -> Vec<usize> {
        let Self {
            law,
            close,
            first,
            bonded,
            severed,
            spacing,
            weighted,
            places,
            force,
            held,
        } = self;
        let lanes = Lanes::<L>::COUNT;
        let one = Lanes::all(simd, 1.0);
        let mut crowded = Vec::new();
        for (number, force) in force.iter_mut().enumerate() {
            let group = first + number;
            let [bonded, severed] = [bonded, severed].map(|lists| lists.of_group(group));
            if bonded.is_empty() && severed.is_empty() {
                continue;
            }
            let mut is_crowded = Mask::all(simd, false);
            let mut lane = 0;
            while lane < MOST {
                let own = |k: usize| group * MOST + lane + k;
                let here = gather(simd, places, own);
                let weight = weights(simd, places, own);
                let mut sum = Vector::zero(simd);
                let mut of_pairs = Held::<L, MEASURED>::new(simd);
                for partners in bonded.chunks_exact(MOST) {
                    let partner = |k: usize| partners[lane + k] as usize;
                    let bond = gather(simd, places, partner) - here;
                    let squared = bond.squared();
                    is_crowded = is_crowded.or(squared.is_below(close));
                    let count = if weighted {
                        counts(simd, places, weight, partner)
                    } else {
                        one
                    };
                    let slope = if MEASURED {
                        let values = law.values(simd, squared);
                        of_pairs.add(values, bond, within(simd, &law, squared), count);
                        values[1]
                    } else {
                        law.slopes(simd, squared)
                    };
                    let slope = if weighted { slope * count } else { slope };
                    sum = bond.times_add(slope, sum);
                }
                for partners in severed.chunks_exact(MOST) {
                    let partner = |k: usize| partners[lane + k] as usize;
                    let bond = gather(simd, places, partner) - here;
                    let squared = bond.squared();
                    is_crowded = is_crowded.or(squared.is_below(close));
                    let count = if weighted {
                        counts(simd, places, weight, partner)
                    } else {
                        one
                    };
                    let values = law.repulsions(simd, squared, spacing);
                    if MEASURED {
                        of_pairs.add(values, bond, Lanes::all(simd, 0.0), count);
                    }
                    let slope = if weighted { values[1] * count } else { values[1] };
                    sum = bond.times_add(slope, sum);
                }
                for (plane, part) in force.iter_mut().zip([sum.x, sum.y, sum.z]) {
                    part.store(plane, lane, lanes);
                }
                if MEASURED {
                    let mut planes = held[number].each_mut().map(|plane| &mut plane[..]);
                    of_pairs.store(&mut planes, lane, lanes);
                }
                lane += lanes;
            }
            if is_crowded.any() {
                crowded.push(group);
            }
        }
        crowded
    }
}

/// How many sites some points stand for.
#[inline(always)]
fn weights<L: Simd>(simd: L, places: &[[f64; 4]], place: impl Fn(usize) -> usize) -> Lanes<L> {
    Lanes::each(simd, |k| {
        if k < Lanes::<L>::COUNT {
            places[place(k)][3]
        } else {
            0.0
        }
    })
}

/// How many bonds those of points that stand for so many sites with others stand for: half of the energy belongs to either end.
#[inline(always)]
fn counts<L: Simd>(simd: L, places: &[[f64; 4]], weight: Lanes<L>, partner: impl Fn(usize) -> usize) -> Lanes<L> {
    (weight + weights(simd, places, partner)) * 0.5
}

#[inline(always)]
fn gather<L: Simd>(simd: L, places: &[[f64; 4]], place: impl Fn(usize) -> usize) -> Vector<L> {
    let mut planes = [[0.0; MOST]; 3];
    for k in 0..Lanes::<L>::COUNT {
        let [x, y, z, _] = places[place(k)];
        planes[0][k] = x;
        planes[1][k] = y;
        planes[2][k] = z;
    }
    Vector {
        x: Lanes::load(simd, &planes[0], 0),
        y: Lanes::load(simd, &planes[1], 0),
        z: Lanes::load(simd, &planes[2], 0),
    }
}
