//! The forces on sites, several sites side by side.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::Contacts;
use super::partners::{Part, Partner, Step};
use crate::forces::regular::Regular;
use crate::lanes::{Lanes, MOST, Mask};
use crate::potential::{CutPotential, PairShape};

/// Forces on some consecutive sites; returns those with a watched bond that is not that of a regular lattice.
pub fn sum_sites<S: PairShape>(
    arch: Arch,
    contacts: &Contacts,
    law: &CutPotential<S>,
    regular: Option<Regular>,
    sites: Range<usize>,
    x: &mut [f64],
    y: &mut [f64],
) -> Vec<u32> {
    arch.dispatch(Sum {
        contacts,
        law: *law,
        regular,
        sites,
        x,
        y,
    })
}

struct Sum<'a, S> {
    contacts: &'a Contacts,
    law: CutPotential<S>,
    regular: Option<Regular>,
    sites: Range<usize>,
    x: &'a mut [f64],
    y: &'a mut [f64],
}

impl<S: PairShape> WithSimd for Sum<'_, S> {
    type Output = Vec<u32>;

    #[inline(always)]
    fn with_simd<L: Simd>(self, simd: L) -> Vec<u32> {
        let lanes = Lanes::<L>::COUNT;
        let mut irregular = Vec::new();
        let start = self.sites.start;
        for part in self.contacts.partners.parts(self.sites.clone()) {
            let (Part::Alike { sites, .. } | Part::Listed { sites, .. }) = &part;
            for from in sites.clone().step_by(lanes) {
                let count = lanes.min(sites.end - from);
                let ([x, y], regular) = match &part {
                    Part::Alike { steps, .. } => self.sum_alike(simd, from, steps),
                    Part::Listed { start, partners, .. } => self.sum_listed(
                        simd,
                        from,
                        &start[from - sites.start..=from - sites.start + count],
                        partners,
                    ),
                };
                x.store(self.x, from - start, count);
                y.store(self.y, from - start, count);
                if !regular.every() {
                    let regular = regular.answers();
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

impl<S: PairShape> Sum<'_, S> {
    /// Sites from one on with partners at the same steps in number.
    #[inline(always)]
    fn sum_alike<L: Simd>(&self, simd: L, from: usize, steps: &[Step]) -> ([Lanes<L>; 2], Mask<L>) {
        let [site_x, site_y] = &self.contacts.position;
        let load = |plane: &[f64], site: usize| Lanes::load(simd, plane, site);
        let [here_x, here_y] = [load(site_x, from), load(site_y, from)];
        let [mut sum_x, mut sum_y] = [Lanes::all(simd, 0.0); 2];
        let mut regular = Mask::all(simd, true);
        for step in steps {
            let other = from.wrapping_add_signed(step.by as isize);
            let [dx, dy] = [load(site_x, other) - here_x, load(site_y, other) - here_y];
            let squared = dx.mul_add(dx, dy * dy);
            if let (true, Some(test)) = (step.is_nearest, &self.regular) {
                regular = regular.and(test.holds(squared, squared));
            }
            let pull = self.law.slopes(simd, squared);
            sum_x = pull.mul_add(dx, sum_x);
            sum_y = pull.mul_add(dy, sum_y);
        }
        ([sum_x, sum_y], regular)
    }

    /// Consecutive sites from one on with lists of their own, which start at these places. Every lane goes through its own
    /// partners in their order; one that has no more waits for the others.
    #[inline(always)]
    fn sum_listed<L: Simd>(
        &self,
        simd: L,
        from: usize,
        start: &[u32],
        partners: &[Partner],
    ) -> ([Lanes<L>; 2], Mask<L>) {
        let contacts = self.contacts;
        let [site_x, site_y] = &contacts.position;
        let [here_x, here_y] = [site_x, site_y].map(|plane| Lanes::load(simd, plane, from));
        let longest = start.windows(2).map(|ends| ends[1] - ends[0]).max().unwrap_or(0);
        let [mut sum_x, mut sum_y] = [Lanes::all(simd, 0.0); 2];
        let mut regular = Mask::all(simd, true);
        for slot in 0..longest {
            let [mut there_x, mut there_y] = [here_x.numbers(), here_y.numbers()];
            let mut counts = [0.0; MOST];
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
                regular = regular.and(test.holds(squared, squared).or(unwatched));
            }
            let mut slopes = self.law.slopes(simd, squared);
            if any_severed {
                let [bonded, squared] = [slopes.numbers(), squared.numbers()];
                slopes = Lanes::each(simd, |lane| {
                    if lane < MOST && severed[lane] {
                        self.law.repulsion(squared[lane], contacts.spacing).slope
                    } else {
                        bonded[lane]
                    }
                });
            }
            let pull = slopes * Lanes::load(simd, &counts, 0);
            sum_x = pull.mul_add(dx, sum_x);
            sum_y = pull.mul_add(dy, sum_y);
        }
        ([sum_x, sum_y], regular)
    }
}
