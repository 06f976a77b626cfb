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
            places,
            force,
            held,
        } = self;
        let lanes = Lanes::<L>::COUNT;
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
                let here = gather(simd, places, |k| group * MOST + lane + k);
                let mut sum = Vector::zero(simd);
                let mut of_pairs = Held::<L, MEASURED>::new(simd);
                for partners in bonded.chunks_exact(MOST) {
                    let bond = gather(simd, places, |k| partners[lane + k] as usize) - here;
                    let squared = bond.squared();
                    is_crowded = is_crowded.or(squared.is_below(close));
                    if MEASURED {
                        let values = law.values(simd, squared);
                        of_pairs.add(values, bond, within(simd, &law, squared), Lanes::all(simd, 1.0));
                        sum = bond.times_add(values[1], sum);
                    } else {
                        sum = bond.times_add(law.slopes(simd, squared), sum);
                    }
                }
                for partners in severed.chunks_exact(MOST) {
                    let bond = gather(simd, places, |k| partners[lane + k] as usize) - here;
                    let squared = bond.squared();
                    is_crowded = is_crowded.or(squared.is_below(close));
                    let values = law.repulsions(simd, squared, spacing);
                    if MEASURED {
                        of_pairs.add(values, bond, Lanes::all(simd, 0.0), Lanes::all(simd, 1.0));
                    }
                    sum = bond.times_add(values[1], sum);
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
