//! The forces on sites, several sites side by side.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::ahead::Task;
use super::partners::{Part, Partner, Step};
use super::{Contacts, SUMS, SumField};
use crate::forces::measure::Count;
use crate::forces::regular::Regular;
use crate::forces::vector::Vector;
use crate::lanes::{Lanes, MOST, Mask};
use crate::potential::{CutPotential, PairShape};

/// Forces on some consecutive sites, x and y, and half of what their bonds hold if it is to be `MEASURED`; returns what
/// is found of them. `atoms`: where they are.
pub fn sum_sites<S: PairShape, const MEASURED: bool>(
    field: &SumField<S>,
    contacts: &Contacts,
    atoms: [&[f64]; 2],
    sites: Range<usize>,
    sums: [&mut [f64]; SUMS],
    ahead: Option<Task>,
) -> Found {
    field.arch.dispatch(Sum::<S, MEASURED> {
        contacts,
        law: *field.law,
        regular: field.regular,
        untouched: field.untouched,
        close: field.close.squared_length,
        atoms,
        sites,
        sums,
        ahead,
    })
}

/// What the sums of some sites have found.
#[derive(Default)]
pub struct Found {
    /// Sites with a watched bond that is not that of a regular lattice.
    pub irregular: Vec<u32>,
    /// Those that do not move ahead.
    pub left: Vec<Range<usize>>,
    /// Those with close neighbours.
    pub close: Vec<u32>,
}

struct Sum<'a, S, const MEASURED: bool> {
    contacts: &'a Contacts,
    law: CutPotential<S>,
    regular: Option<Regular>,
    untouched: Option<Regular>,
    /// Shorter bonds are close, nm^2.
    close: f64,
    atoms: [&'a [f64]; 2],
    sites: Range<usize>,
    sums: [&'a mut [f64]; SUMS],
    ahead: Option<Task<'a>>,
}

/// The sums of several sites.
struct SiteSum<L: Simd, const MEASURED: bool> {
    force: [Lanes<L>; 2],
    count: Count<L, MEASURED>,
    /// xx, yy, xy.
    virial: [Lanes<L>; 3],
    regular: Mask<L>,
    close: Mask<L>,
}

impl<L: Simd, const MEASURED: bool> SiteSum<L, MEASURED> {
    #[inline(always)]
    fn new(simd: L) -> Self {
        Self {
            force: [Lanes::all(simd, 0.0); 2],
            count: Count::new(simd),
            virial: [Lanes::all(simd, 0.0); 3],
            regular: Mask::all(simd, true),
            close: Mask::all(simd, false),
        }
    }

    /// Adds bonds along these vectors that pull so much of their lengths.
    #[inline(always)]
    fn add(&mut self, pull: Lanes<L>, [x, y]: [Lanes<L>; 2]) {
        self.force = [pull.mul_add(x, self.force[0]), pull.mul_add(y, self.force[1])];
        if MEASURED {
            let [xx, yy, xy] = self.virial;
            self.virial = [
                (pull * x).mul_add(x, xx),
                (pull * y).mul_add(y, yy),
                (pull * x).mul_add(y, xy),
            ];
        }
    }
}

impl<S: PairShape, const MEASURED: bool> WithSimd for Sum<'_, S, MEASURED> {
    type Output = Found;

    #[inline(always)]
    fn with_simd<L: Simd>(mut self, simd: L) -> Found {
        let lanes = Lanes::<L>::COUNT;
        let mut found = Found::default();
        let mut left = Vec::new();
        let start = self.sites.start;
        let contacts = self.contacts;
        let law = self.law;
        for part in contacts.partners.parts(self.sites.clone()) {
            match part {
                Part::Alike { sites, steps } if contacts.are_atoms(&sites, steps) => {
                    let nearest = steps.iter().all(|step| step.is_nearest);
                    let untouched = self.untouched.filter(|_| nearest && !MEASURED);
                    let whole = sites.end - sites.len() % lanes;
                    let mut stay = Vec::new();
                    match (&untouched, steps.try_into(), &mut self.ahead) {
                        (Some(regular), Ok(six), Some(ahead)) => {
                            let atoms = sites.start - contacts.carrier.len()..whole - contacts.carrier.len();
                            let row = Row::new(self.atoms, atoms, six);
                            row.advance(simd, &law, regular, ahead, sites.start - start, &mut stay);
                        }
                        _ => stay.extend((0..whole - sites.start).step_by(lanes)),
                    }
                    for from in stay.into_iter().map(|at| sites.start + at) {
                        if !self.sum_atoms(simd, &law, from, lanes, steps, &mut found) {
                            left.push(from..from + lanes);
                        }
                    }
                    if whole < sites.end {
                        let count = sites.end - whole;
                        if !self.sum_atoms(simd, &law, whole, count, steps, &mut found) {
                            left.push(whole..sites.end);
                        }
                    }
                }
                Part::Alike { sites, steps } => {
                    let starts: Vec<u32> = (0..=lanes).map(|site| (site * steps.len()) as u32).collect();
                    let mut partners = Vec::new();
                    for from in sites.clone().step_by(lanes) {
                        let count = lanes.min(sites.end - from);
                        partners.clear();
                        partners.extend(
                            (from..from + count).flat_map(|site| steps.iter().map(move |step| step.from(site))),
                        );
                        let sum = self.sum_listed(simd, from, &starts[..=count], &partners);
                        self.store(&sum, from - start, count);
                        note(&mut found.irregular, from, count, sum.regular);
                        note(&mut found.close, from, count, sum.close.opposite());
                    }
                    left.push(sites);
                }
                Part::Listed {
                    sites,
                    start: starts,
                    partners,
                } => {
                    for from in sites.clone().step_by(lanes) {
                        let count = lanes.min(sites.end - from);
                        let starts = &starts[from - sites.start..=from - sites.start + count];
                        let sum = self.sum_listed(simd, from, starts, partners);
                        self.store(&sum, from - start, count);
                        note(&mut found.irregular, from, count, sum.regular);
                        note(&mut found.close, from, count, sum.close.opposite());
                    }
                    left.push(sites);
                }
            }
        }
        found.left = joined(left);
        found
    }
}

/// Atoms side by side that have the six neighbours of the lattice, at the same steps in number.
struct Row<'a> {
    here: [&'a [f64]; 2],
    there: [[&'a [f64]; 2]; 6],
}

impl<'a> Row<'a> {
    /// From the places of all atoms.
    fn new(places: [&'a [f64]; 2], atoms: Range<usize>, steps: &[Step; 6]) -> Self {
        let part = |by: isize| {
            let from = atoms.start.wrapping_add_signed(by);
            places.map(|plane| &plane[from..][..atoms.len()])
        };
        Self {
            here: part(0),
            there: steps.map(|step| part(step.by as isize)),
        }
    }

    /// Moves those on whose bonds are all regular, in the range that the cutoff leaves untouched, as many as there are lanes
    /// at a time; the places of the others are noted. The first atom is at a place of its task.
    #[inline(always)]
    fn advance<S: PairShape, L: Simd>(
        &self,
        simd: L,
        law: &CutPotential<S>,
        regular: &Regular,
        ahead: &mut Task,
        place: usize,
        stay: &mut Vec<usize>,
    ) {
        let [x, y] = self.here;
        let mut at = 0;
        while at + Lanes::<L>::COUNT <= x.len() {
            let here = Vector::load(simd, x, y, at);
            let mut force = Vector::zero(simd);
            let mut are_regular = Mask::all(simd, true);
            for k in 0..6 {
                let [x, y] = self.there[k];
                let bond = Vector::load(simd, x, y, at) - here;
                let squared = bond.squared();
                are_regular = are_regular.and(regular.holds(squared, squared));
                force = bond.times_add(law.untouched_slopes(simd, squared), force);
            }
            if are_regular.every() {
                ahead.advance(simd, place + at, Lanes::<L>::COUNT, force, here);
            } else {
                stay.push(at);
            }
            at += Lanes::<L>::COUNT;
        }
    }
}

/// Ranges of which those that follow each other are one.
fn joined(ranges: Vec<Range<usize>>) -> Vec<Range<usize>> {
    let mut joined: Vec<Range<usize>> = Vec::new();
    for range in ranges {
        match joined.last_mut() {
            Some(last) if last.end == range.start => last.end = range.end,
            _ => joined.push(range),
        }
    }
    joined
}

/// Notes so many sites from one on for which this does not hold; whether it holds for all.
#[inline(always)]
fn note<L: Simd>(noted: &mut Vec<u32>, from: usize, count: usize, holds: Mask<L>) -> bool {
    if holds.every() {
        return true;
    }
    let holds = holds.answers();
    let before = noted.len();
    let sites = (0..count).filter(|&lane| !holds[lane]);
    noted.extend(sites.map(|lane| (from + lane) as u32));
    noted.len() == before
}

impl<S: PairShape, const MEASURED: bool> Sum<'_, S, MEASURED> {
    #[inline(always)]
    fn store<L: Simd>(&mut self, sum: &SiteSum<L, MEASURED>, place: usize, count: usize) {
        let [x, y, held @ ..] = &mut self.sums;
        sum.force[0].store(x, place, count);
        sum.force[1].store(y, place, count);
        if MEASURED {
            let [xx, yy, xy] = sum.virial;
            let parts = [sum.count.energy, sum.count.pairs, xx, yy, xy];
            (held.iter_mut().zip(parts)).for_each(|(plane, part)| (part * 0.5).store(plane, place, count));
        }
    }

    /// Where so many atoms from a site on are.
    #[inline(always)]
    fn places<L: Simd>(&self, simd: L, from: usize, count: usize) -> Vector<L> {
        let atom = from - self.contacts.carrier.len();
        Vector {
            x: Lanes::load_some(simd, self.atoms[0], atom, count),
            y: Lanes::load_some(simd, self.atoms[1], atom, count),
        }
    }

    /// Sums so many atoms from a site on, with partners at the same steps in number, and moves them on; false, and their
    /// forces put down, where they stay.
    #[inline(always)]
    fn sum_atoms<L: Simd>(
        &mut self,
        simd: L,
        law: &CutPotential<S>,
        from: usize,
        count: usize,
        steps: &[Step],
        found: &mut Found,
    ) -> bool {
        let here = self.places(simd, from, count);
        let mut sum = SiteSum::new(simd);
        let one = Lanes::all(simd, 1.0);
        for step in steps {
            let there = self.places(simd, from.wrapping_add_signed(step.by as isize), count);
            let bond = there - here;
            let squared = bond.squared();
            sum.close = sum.close.or(squared.is_below(self.close));
            if let (true, Some(test)) = (step.is_nearest, &self.regular) {
                sum.regular = sum.regular.and(test.holds(squared, squared));
            }
            let pull = sum.count.slopes(simd, law, squared, one);
            sum.add(pull, [bond.x, bond.y]);
        }
        let is_regular = note(&mut found.irregular, from, count, sum.regular);
        note(&mut found.close, from, count, sum.close.opposite());
        let place = from - self.sites.start;
        if let (Some(ahead), true) = (&mut self.ahead, is_regular) {
            let force = Vector {
                x: sum.force[0],
                y: sum.force[1],
            };
            ahead.advance(simd, place, count, force, here);
            return true;
        }
        self.store(&sum, place, count);
        false
    }

    /// Consecutive sites from one on with lists of their own, which start at these places. Every lane goes through its own
    /// partners in their order; one that has no more waits for the others.
    #[inline(always)]
    fn sum_listed<L: Simd>(&self, simd: L, from: usize, start: &[u32], partners: &[Partner]) -> SiteSum<L, MEASURED> {
        let contacts = self.contacts;
        let [site_x, site_y] = &contacts.position;
        let [here_x, here_y] = [Lanes::load(simd, site_x, from), Lanes::load(simd, site_y, from)];
        let longest = start.windows(2).map(|ends| ends[1] - ends[0]).max().unwrap_or(0);
        let mut sum = SiteSum::new(simd);
        for slot in 0..longest {
            let [mut there_x, mut there_y] = [here_x.numbers(), here_y.numbers()];
            let mut counts = [0.0; MOST];
            let mut bonded = [0.0; MOST];
            let mut any_severed = false;
            let mut severed = [false; MOST];
            let mut unwatched = [1.0; MOST];
            for lane in 0..MOST {
                match start.get(lane..lane + 2) {
                    Some(&[first, end]) if first + slot < end => {
                        let partner = partners[(first + slot) as usize];
                        let other = partner.site();
                        there_x[lane] = site_x[other];
                        there_y[lane] = site_y[other];
                        severed[lane] = partner.severed();
                        any_severed |= severed[lane];
                        unwatched[lane] = f64::from(u8::from(!partner.is_nearest()));
                        counts[lane] = contacts.count(from + lane, other);
                        bonded[lane] = if severed[lane] { 0.0 } else { counts[lane] };
                    }
                    // Anything that is not at the site itself.
                    _ => there_x[lane] += contacts.spacing,
                }
            }
            let [there_x, there_y] = [there_x, there_y].map(|plane| Lanes::load(simd, &plane, 0));
            let [dx, dy] = [there_x - here_x, there_y - here_y];
            let squared = dx.mul_add(dx, dy * dy);
            sum.close = sum.close.or(squared.is_below(self.close));
            if let Some(test) = &self.regular {
                let unwatched = Lanes::load(simd, &unwatched, 0).is_above(0.0);
                sum.regular = sum.regular.and(test.holds(squared, squared).or(unwatched));
            }
            let counts = Lanes::load(simd, &counts, 0);
            let bonded = Lanes::load(simd, &bonded, 0);
            let mut slopes = sum.count.slopes(simd, &self.law, squared, bonded);
            if any_severed {
                let [intact, squared] = [slopes.numbers(), squared.numbers()];
                let mut energies = [0.0; MOST];
                slopes = Lanes::each(simd, |lane| {
                    if lane < MOST && severed[lane] {
                        let pair = self.law.repulsion(squared[lane], contacts.spacing);
                        energies[lane] = pair.energy;
                        pair.slope
                    } else {
                        intact[lane]
                    }
                });
                if MEASURED {
                    sum.count.energy = Lanes::load(simd, &energies, 0).mul_add(counts, sum.count.energy);
                }
            }
            sum.add(slopes * counts, [dx, dy]);
        }
        sum
    }
}
