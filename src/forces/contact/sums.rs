//! The forces on sites, several sites side by side.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::partners::{Part, Partner, Step};
use super::{Contacts, SUMS};
use crate::forces::measure::Count;
use crate::forces::regular::Regular;
use crate::lanes::{Lanes, MOST, Mask};
use crate::potential::{CutPotential, PairShape};

/// Forces on some consecutive sites, x and y, and half of what their bonds hold if it is to be `MEASURED`; returns those
/// with a watched bond that is not that of a regular lattice.
pub fn sum_sites<S: PairShape, const MEASURED: bool>(
    arch: Arch,
    contacts: &Contacts,
    law: &CutPotential<S>,
    regular: Option<Regular>,
    sites: Range<usize>,
    sums: [&mut [f64]; SUMS],
) -> Vec<u32> {
    arch.dispatch(Sum::<S, MEASURED> {
        contacts,
        law: *law,
        regular,
        sites,
        sums,
    })
}

struct Sum<'a, S, const MEASURED: bool> {
    contacts: &'a Contacts,
    law: CutPotential<S>,
    regular: Option<Regular>,
    sites: Range<usize>,
    sums: [&'a mut [f64]; SUMS],
}

/// The sums of several sites.
struct SiteSum<L: Simd, const MEASURED: bool> {
    force: [Lanes<L>; 2],
    count: Count<L, MEASURED>,
    /// xx, yy, xy.
    virial: [Lanes<L>; 3],
    regular: Mask<L>,
}

impl<L: Simd, const MEASURED: bool> SiteSum<L, MEASURED> {
    #[inline(always)]
    fn new(simd: L) -> Self {
        Self {
            force: [Lanes::all(simd, 0.0); 2],
            count: Count::new(simd),
            virial: [Lanes::all(simd, 0.0); 3],
            regular: Mask::all(simd, true),
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
    type Output = Vec<u32>;

    #[inline(always)]
    fn with_simd<L: Simd>(mut self, simd: L) -> Vec<u32> {
        let lanes = Lanes::<L>::COUNT;
        let mut irregular = Vec::new();
        let start = self.sites.start;
        let contacts = self.contacts;
        for part in contacts.partners.parts(self.sites.clone()) {
            let (Part::Alike { sites, .. } | Part::Listed { sites, .. }) = &part;
            for from in sites.clone().step_by(lanes) {
                let count = lanes.min(sites.end - from);
                let sum = match &part {
                    Part::Alike { steps, .. } => self.sum_alike(simd, from, steps),
                    Part::Listed { start, partners, .. } => self.sum_listed(
                        simd,
                        from,
                        &start[from - sites.start..=from - sites.start + count],
                        partners,
                    ),
                };
                self.store(&sum, from - start, count);
                if !sum.regular.every() {
                    let regular = sum.regular.answers();
                    let sites = (0..count)
                        .filter(|&lane| !regular[lane])
                        .map(|lane| (from + lane) as u32);
                    irregular.extend(sites);
                }
            }
        }
        irregular
    }
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

    /// Sites from one on with partners at the same steps in number.
    #[inline(always)]
    fn sum_alike<L: Simd>(&self, simd: L, from: usize, steps: &[Step]) -> SiteSum<L, MEASURED> {
        let [site_x, site_y] = &self.contacts.position;
        let load = |plane: &[f64], site: usize| Lanes::load(simd, plane, site);
        let [here_x, here_y] = [load(site_x, from), load(site_y, from)];
        let mut sum = SiteSum::new(simd);
        let one = Lanes::all(simd, 1.0);
        for step in steps {
            let other = from.wrapping_add_signed(step.by as isize);
            let [dx, dy] = [load(site_x, other) - here_x, load(site_y, other) - here_y];
            let squared = dx.mul_add(dx, dy * dy);
            if let (true, Some(test)) = (step.is_nearest, &self.regular) {
                sum.regular = sum.regular.and(test.holds(squared, squared));
            }
            let pull = sum.count.slopes(simd, &self.law, squared, one);
            sum.add(pull, [dx, dy]);
        }
        sum
    }

    /// Consecutive sites from one on with lists of their own, which start at these places. Every lane goes through its own
    /// partners in their order; one that has no more waits for the others.
    #[inline(always)]
    fn sum_listed<L: Simd>(&self, simd: L, from: usize, start: &[u32], partners: &[Partner]) -> SiteSum<L, MEASURED> {
        let contacts = self.contacts;
        let [site_x, site_y] = &contacts.position;
        let [here_x, here_y] = [site_x, site_y].map(|plane| Lanes::load(simd, plane, from));
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
