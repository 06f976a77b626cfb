//! Sums over the partners of each site of what their bonds are worth.

use std::ops::Range;

use pulp::{Scalar, Simd};

use super::Contacts;
use super::partners::Part;
use crate::lanes::{Lanes, MOST};

/// Several sums at once.
pub type Sums<L> = [Lanes<L>; 3];

/// What is summed.
pub trait Tally {
    /// Adds bonds along these vectors that count so many times.
    fn add<L: Simd>(&self, simd: L, vector: [Lanes<L>; 2], count: f64, sums: &mut Sums<L>);
    /// Adds a pair that a cut severs.
    fn add_severed(&self, vector: [f64; 2], count: f64, sums: &mut [f64; 3]);
}

impl Contacts {
    /// Gives the sums of some consecutive sites, in their order. They have the same bits whether a site stands side by side
    /// with others or has a list of its own.
    #[inline(always)]
    pub fn tally<L: Simd>(
        &self,
        simd: L,
        sites: Range<usize>,
        tally: &impl Tally,
        mut give: impl FnMut(usize, [f64; 3]),
    ) {
        let [site_x, site_y] = &self.position;
        for part in self.partners.parts(sites) {
            match part {
                Part::Alike { sites, steps } => {
                    for from in sites.clone().step_by(Lanes::<L>::COUNT) {
                        let [here_x, here_y] = [Lanes::load(simd, site_x, from), Lanes::load(simd, site_y, from)];
                        let mut sums = [Lanes::all(simd, 0.0); 3];
                        for step in steps {
                            let other = from.wrapping_add_signed(step.by as isize);
                            let [x, y] = [Lanes::load(simd, site_x, other), Lanes::load(simd, site_y, other)];
                            tally.add(simd, [x - here_x, y - here_y], 1.0, &mut sums);
                        }
                        let mut numbers = [[0.0; MOST]; 3];
                        for k in 0..3 {
                            numbers[k] = sums[k].numbers();
                        }
                        for lane in 0..Lanes::<L>::COUNT.min(sites.end - from) {
                            let mut of_lane = [0.0; 3];
                            for k in 0..3 {
                                of_lane[k] = numbers[k][lane];
                            }
                            give(from + lane, of_lane);
                        }
                    }
                }
                Part::Listed { sites, .. } => sites.for_each(|site| give(site, self.tally_listed(site, tally))),
            }
        }
    }

    fn tally_listed(&self, site: usize, tally: &impl Tally) -> [f64; 3] {
        let mut sums = [0.0; 3];
        self.for_each_partner(site, |vector, severed, count| {
            if severed {
                tally.add_severed(vector, count, &mut sums);
            } else {
                let mut lanes = sums.map(|sum| Lanes::all(Scalar, sum));
                tally.add(
                    Scalar,
                    vector.map(|component| Lanes::all(Scalar, component)),
                    count,
                    &mut lanes,
                );
                sums = lanes.map(|sum| sum.numbers()[0]);
            }
        });
        sums
    }
}
