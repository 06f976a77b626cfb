//! The strings of intact interfaces, several alike side by side.

use std::ops::Range;

use pulp::{Simd, WithSimd};
use rayon::prelude::*;

use crate::forces::Forces;
use crate::forces::interface;
use crate::forces::maps::squared;
use crate::forces::summation::Sample;
use crate::lanes::Lanes;
use crate::mesh::interfaces::Interface;
use crate::potential::{CutPotential, PairShape};

/// What the strings of consecutive interfaces hold.
#[derive(Default)]
pub struct StringSums {
    pub energy: f64,
    pub pairs: f64,
    /// For every interface the sum of phi'/r d d, xx, yy, xy; zero for one that is open.
    pub virial: Vec<[f64; 3]>,
}

/// Interfaces in one parallel task, which sets the order of summation.
const BLOCK: usize = 1024;

/// The sums over all interfaces that have strings, which come before those that have none.
pub fn sum<S: PairShape>(forces: &Forces, law: &CutPotential<S>) -> StringSums {
    let interfaces = &forces.interfaces;
    let has_strings = |pair: &Interface| !interfaces.kinds[pair.kind as usize].strings.is_empty();
    let count = interfaces.pairs.partition_point(has_strings);
    let blocks = (0..count.div_ceil(BLOCK)).into_par_iter();
    let blocks = blocks.map(|block| {
        forces.arch.dispatch(BlockSum {
            forces,
            law: *law,
            numbers: block * BLOCK..count.min((block + 1) * BLOCK),
        })
    });
    let parts: Vec<StringSums> = blocks.collect();
    let mut total = StringSums {
        virial: Vec::with_capacity(count),
        ..StringSums::default()
    };
    for part in parts {
        total.energy += part.energy;
        total.pairs += part.pairs;
        total.virial.extend(part.virial);
    }
    total
}

/// The sums of consecutive interfaces.
struct BlockSum<'a, S> {
    forces: &'a Forces,
    law: CutPotential<S>,
    numbers: Range<usize>,
}

impl<S: PairShape> WithSimd for BlockSum<'_, S> {
    type Output = StringSums;

    #[inline(always)]
    fn with_simd<L: Simd>(self, simd: L) -> StringSums {
        let mut sums = StringSums {
            virial: Vec::with_capacity(self.numbers.len()),
            ..StringSums::default()
        };
        let mut at = self.numbers.start;
        while at < self.numbers.end {
            let pairs = &self.forces.interfaces.pairs[at..self.numbers.end.min(at + Lanes::<L>::COUNT)];
            let count = alike(pairs);
            let sum = self.sum_alike(simd, pairs[0]).map(Lanes::numbers);
            for lane in 0..count {
                let [energy, pairs, xx, yy, xy] = sum.map(|component| component[lane]);
                if self.forces.is_open(at + lane) {
                    sums.virial.push([0.0; 3]);
                } else {
                    sums.energy += energy;
                    sums.pairs += pairs;
                    sums.virial.push([xx, yy, xy]);
                }
            }
            at += count;
        }
        sums
    }
}

/// How many interfaces from the first on are of one kind and between triangles that follow each other.
#[inline(always)]
fn alike(pairs: &[Interface]) -> usize {
    let start = pairs[0];
    let follows = |&(lane, pair): &(u32, &Interface)| {
        [pair.kind, pair.first, pair.second] == [start.kind, start.first + lane, start.second + lane]
    };
    (0..).zip(pairs).take_while(follows).count()
}

/// Energy, pairs within the cutoff, and phi'/r d d: xx, yy, xy.
pub type BondSums<L> = [Lanes<L>; 5];

impl<S: PairShape> BlockSum<'_, S> {
    /// The sums over the strings of interfaces that are alike from this one on.
    #[inline(always)]
    fn sum_alike<L: Simd>(&self, simd: L, pair: Interface) -> BondSums<L> {
        let forces = self.forces;
        let first = forces.maps.lanes(simd, pair.first as usize);
        let second = forces.maps.lanes(simd, pair.second as usize);
        let mut sums = [Lanes::all(simd, 0.0); 5];
        for sampled in &forces.strings.of(pair.kind).strings {
            let [start, step] = interface::bonds_along(sampled, [&first, &second]);
            let squared_bend = squared(step) * (sampled.length * sampled.length);
            for (samples, share) in sampled.looks(simd, forces.material.spacing, squared_bend) {
                if !share.is_above(0.0).any() {
                    continue;
                }
                for &Sample { at, weight } in samples {
                    let vector = [step[0].times_add(at, start[0]), step[1].times_add(at, start[1])];
                    add_bond(simd, &self.law, vector, share * weight, &mut sums);
                }
            }
        }
        sums
    }
}

/// Adds bonds that count so many times.
#[inline(always)]
pub fn add_bond<S: PairShape, L: Simd>(
    simd: L,
    law: &CutPotential<S>,
    [x, y]: [Lanes<L>; 2],
    count: Lanes<L>,
    [energies, pairs, xx, yy, xy]: &mut BondSums<L>,
) {
    let squared = squared([x, y]);
    let [energy, slope] = law.values(simd, squared);
    let pull = slope * count;
    *energies = energy.mul_add(count, *energies);
    *pairs = *pairs + count.where_or(squared.is_below(law.squared_cutoff()), Lanes::all(simd, 0.0));
    *xx = (pull * x).mul_add(x, *xx);
    *yy = (pull * y).mul_add(y, *yy);
    *xy = (pull * x).mul_add(y, *xy);
}
