//! The strings of intact interfaces, several alike side by side.

use std::ops::Range;

use multiversion::multiversion;
use rayon::prelude::*;

use crate::forces::Forces;
use crate::forces::interface;
use crate::forces::lanes::Lanes;
use crate::forces::maps::MapLanes;
use crate::forces::summation::{Sample, SampledString};
use crate::potential::{CutPotential, PairShape};

/// What the strings of consecutive interfaces hold.
#[derive(Default)]
pub struct StringSums {
    pub energy: f64,
    pub pairs: f64,
    /// For every interface the sum of phi'/r d d, xx, yy, xy; zero for one that is open.
    pub virial: Vec<[f64; 3]>,
}

/// Interfaces computed at a time, and in one parallel task, which sets the order of summation.
const WIDTH: usize = 8;
const BLOCK: usize = 1024;

/// The sums over all interfaces that have strings, which come before those that have none.
pub fn sum<S: PairShape>(forces: &Forces, law: &CutPotential<S>) -> StringSums {
    let pairs = &forces.interfaces.pairs;
    let count = pairs.partition_point(|pair| forces.strings.are_there(pair.kind));
    let blocks = (0..count.div_ceil(BLOCK)).into_par_iter();
    let blocks = blocks.map(|block| sum_block(forces, law, block * BLOCK..count.min((block + 1) * BLOCK)));
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

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
fn sum_block<S: PairShape>(forces: &Forces, law: &CutPotential<S>, numbers: Range<usize>) -> StringSums {
    let mut sums = StringSums {
        virial: Vec::with_capacity(numbers.len()),
        ..StringSums::default()
    };
    let mut at = numbers.start;
    while at < numbers.end {
        if at + WIDTH <= numbers.end && are_alike(forces, at) {
            add_lanes::<S, WIDTH>(forces, law, at, &mut sums);
            at += WIDTH;
        } else {
            add_lanes::<S, 1>(forces, law, at, &mut sums);
            at += 1;
        }
    }
    sums
}

/// Whether the interfaces from this number on are of one kind and between triangles that follow each other.
fn are_alike(forces: &Forces, number: usize) -> bool {
    let pairs = &forces.interfaces.pairs[number..number + WIDTH];
    let start = pairs[0];
    (0..).zip(pairs).all(|(lane, pair)| {
        [pair.kind, pair.first, pair.second] == [start.kind, start.first + lane, start.second + lane]
    })
}

#[inline(always)]
fn add_lanes<S: PairShape, const W: usize>(
    forces: &Forces,
    law: &CutPotential<S>,
    number: usize,
    sums: &mut StringSums,
) {
    let pair = forces.interfaces.pairs[number];
    let kind = &forces.interfaces.kinds[pair.kind as usize];
    let first: MapLanes<W> = forces.maps.lanes(pair.first as usize);
    let second: MapLanes<W> = forces.maps.lanes(pair.second as usize);
    let hardly_open = forces.strings.hardly_open(forces.material.spacing);
    let squared_gap = interface::squared_gap(kind, &first, &second);
    let is_hardly_open = |lane: usize| squared_gap[lane] <= hardly_open;
    let alike = (1..W).all(|lane| is_hardly_open(lane) == is_hardly_open(0));
    let sum = if alike {
        Sums::of(law, [&first, &second], forces.strings.of(pair.kind, is_hardly_open(0)))
    } else {
        let mut all = Sums::default();
        for lane in 0..W {
            let strings = forces.strings.of(pair.kind, is_hardly_open(lane));
            let alone = Sums::<1>::of(law, [&first.lane(lane), &second.lane(lane)], strings);
            (0..5).for_each(|k| all.0[k].0[lane] = alone.0[k][0]);
        }
        all
    };
    for lane in 0..W {
        let [energy, pairs, xx, yy, xy] = sum.0.map(|component| component[lane]);
        if forces.is_open(number + lane) {
            sums.virial.push([0.0; 3]);
        } else {
            sums.energy += energy;
            sums.pairs += pairs;
            sums.virial.push([xx, yy, xy]);
        }
    }
}

/// Energy, pairs within the cutoff, and phi'/r d d: xx, yy, xy.
#[derive(Clone, Copy, Default)]
struct Sums<const W: usize>([Lanes<W>; 5]);

impl<const W: usize> Sums<W> {
    #[inline(always)]
    fn of<S: PairShape>(law: &CutPotential<S>, [first, second]: [&MapLanes<W>; 2], strings: &[SampledString]) -> Self {
        let mut sums = [Lanes::default(); 5];
        for SampledString { string, samples } in strings {
            let [a, b] = [first.at(string.first), second.at(string.second)];
            let [da, db] = [first.vector(string.first_step), second.vector(string.second_step)];
            let start = [b[0] - a[0], b[1] - a[1]];
            let step = [db[0] - da[0], db[1] - da[1]];
            for &Sample { at, weight } in samples {
                let vector = [step[0].times_add(at, start[0]), step[1].times_add(at, start[1])];
                add_bond(law, vector, weight, &mut sums);
            }
        }
        Self(sums)
    }
}

/// Adds a bond that counts so many times.
#[inline(always)]
pub fn add_bond<S: PairShape, const W: usize>(
    law: &CutPotential<S>,
    [x, y]: [Lanes<W>; 2],
    count: f64,
    [energies, pairs, xx, yy, xy]: &mut [Lanes<W>; 5],
) {
    let squared = x.mul_add(x, y * y);
    let [energy, slope] = law.values(squared.0).map(Lanes);
    let limit = law.squared_cutoff();
    let within = Lanes::<W>::each(|lane| if squared[lane] < limit { count } else { 0.0 });
    let pull = slope * count;
    *energies = energy.times_add(count, *energies);
    *pairs += within;
    *xx = (pull * x).mul_add(x, *xx);
    *yy = (pull * y).mul_add(y, *yy);
    *xy = (pull * x).mul_add(y, *xy);
}
