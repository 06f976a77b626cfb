//! Who is near whom: the partners of every site, kept once for sites with the same surroundings.

use std::ops::Range;

/// Number of another site, and in the highest bits what kind of pair it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Partner(u32);

/// What is known of a pair of sites.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PairKind {
    /// Whatever comes near.
    Any,
    /// Nearest neighbours in the lattice, whose bond must be watched.
    Nearest,
    /// A cut severs it.
    Severed,
}

impl Partner {
    const SEVERED: u32 = 1 << 31;
    const NEAREST: u32 = 1 << 30;

    pub fn new(site: usize, pair: PairKind) -> Self {
        let bits = match pair {
            PairKind::Any => 0,
            PairKind::Nearest => Self::NEAREST,
            PairKind::Severed => Self::SEVERED,
        };
        Self(site as u32 | bits)
    }

    /// The same pair with another number.
    pub fn renumbered(self, site: usize) -> Self {
        Self(site as u32 | (self.0 & (Self::SEVERED | Self::NEAREST)))
    }

    #[inline(always)]
    pub fn site(self) -> usize {
        (self.0 & !(Self::SEVERED | Self::NEAREST)) as usize
    }

    #[inline(always)]
    pub fn severed(self) -> bool {
        self.0 & Self::SEVERED != 0
    }

    #[inline(always)]
    pub fn is_nearest(self) -> bool {
        self.0 & Self::NEAREST != 0
    }
}

/// A step in number from a site to one of its partners, none severed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Step {
    pub by: i32,
    pub is_nearest: bool,
}

impl Step {
    fn between(site: usize, partner: Partner) -> Self {
        Self {
            by: (partner.site() as i64 - site as i64) as i32,
            is_nearest: partner.is_nearest(),
        }
    }

    pub fn from(self, site: usize) -> Partner {
        let pair = if self.is_nearest {
            PairKind::Nearest
        } else {
            PairKind::Any
        };
        Partner::new(site.wrapping_add_signed(self.by as isize), pair)
    }
}

/// The partners of all sites by rising number.
///
/// In a lattice that is numbered row by row, consecutive sites have partners at the same steps in number. They need no
/// lists of their own, and what they need of their partners stands side by side in memory.
#[derive(Default)]
pub struct Partners {
    /// All sites, ascending.
    stretches: Vec<Stretch>,
    /// Steps from a site to its partners, ascending, of the alike stretches.
    steps: Vec<Step>,
    /// Where the list of each other site starts; the next start is its end.
    start: Vec<u32>,
    listed: Vec<Partner>,
    /// Steps of the sites that were added last, and how many these are.
    open: Vec<Step>,
    open_count: usize,
    sites: usize,
}

/// Consecutive sites.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    first: u32,
    count: u32,
    surroundings: Surroundings,
}

#[derive(Clone, Copy, Debug)]
enum Surroundings {
    /// The same for all: a range of the steps.
    Alike { from: u32, to: u32 },
    /// Each its own list, from this entry of `start` on.
    Listed { at: u32 },
}

/// Part of a stretch.
pub enum Part<'a> {
    /// Sites with partners at the same steps in number, none of them severed.
    Alike { sites: Range<usize>, steps: &'a [Step] },
    /// Sites with lists of their own: where each starts in `partners`, and where the last ends.
    Listed {
        sites: Range<usize>,
        start: &'a [u32],
        partners: &'a [Partner],
    },
}

impl Partners {
    /// Fewer alike sites than this are listed.
    const FEWEST: usize = 8;

    /// Adds the next site with its partners, ascending. `alone`: it must have a list of its own.
    pub fn push(&mut self, partners: impl Iterator<Item = Partner> + Clone, alone: bool) {
        let site = self.sites;
        self.sites += 1;
        if alone || partners.clone().any(Partner::severed) {
            self.close(site);
            self.list(site, partners);
        } else {
            let steps = partners.map(|partner| Step::between(site, partner));
            self.continue_or_open(site, steps, 1);
        }
    }

    /// Adds the sites of a range of others as they are there; their partners have the others' numbers plus `shift`.
    pub fn extend(&mut self, others: &Self, range: Range<usize>, shift: usize) {
        for part in others.parts(range) {
            match part {
                Part::Alike { sites, steps } => {
                    let site = self.sites;
                    self.sites += sites.len();
                    self.continue_or_open(site, steps.iter().copied(), sites.len());
                }
                Part::Listed { start, partners, .. } => {
                    for ends in start.windows(2) {
                        let list = &partners[ends[0] as usize..ends[1] as usize];
                        let shifted = list.iter().map(|partner| partner.renumbered(partner.site() + shift));
                        self.push(shifted, false);
                    }
                }
            }
        }
    }

    /// Adds so many sites from one on with the same steps.
    fn continue_or_open(&mut self, site: usize, steps: impl Iterator<Item = Step> + Clone, count: usize) {
        if self.open_count > 0 && steps.clone().eq(self.open.iter().copied()) {
            self.open_count += count;
        } else {
            self.close(site);
            self.open.clear();
            self.open.extend(steps);
            self.open_count = count;
        }
    }

    /// To be called after the last site.
    pub fn finish(&mut self) {
        self.close(self.sites);
        self.start.push(self.listed.len() as u32);
    }

    /// Ends the sites with the same steps, the last of which comes before this one.
    fn close(&mut self, end: usize) {
        let count = std::mem::take(&mut self.open_count);
        if count >= Self::FEWEST {
            let from = self.steps.len() as u32;
            self.steps.extend(&self.open);
            let to = self.steps.len() as u32;
            self.stretches.push(Stretch {
                first: (end - count) as u32,
                count: count as u32,
                surroundings: Surroundings::Alike { from, to },
            });
        } else if count > 0 {
            let steps = std::mem::take(&mut self.open);
            for site in end - count..end {
                self.list(site, steps.iter().map(|step| step.from(site)));
            }
            self.open = steps;
        }
    }

    fn list(&mut self, site: usize, partners: impl Iterator<Item = Partner>) {
        let at = self.start.len() as u32;
        match self.stretches.last_mut() {
            Some(Stretch {
                count,
                surroundings: Surroundings::Listed { .. },
                ..
            }) => *count += 1,
            _ => self.stretches.push(Stretch {
                first: site as u32,
                count: 1,
                surroundings: Surroundings::Listed { at },
            }),
        }
        self.start.push(self.listed.len() as u32);
        self.listed.extend(partners);
    }

    pub fn site_count(&self) -> usize {
        self.sites
    }

    /// The parts of stretches that make up some consecutive sites.
    pub fn parts(&self, sites: Range<usize>) -> impl Iterator<Item = Part<'_>> {
        let after = |stretch: &Stretch| (stretch.first + stretch.count) as usize <= sites.start;
        let first = self.stretches.partition_point(after);
        let part = move |stretch: &Stretch| {
            let whole = stretch.first as usize..(stretch.first + stretch.count) as usize;
            let part = whole.start.max(sites.start)..whole.end.min(sites.end);
            (!part.is_empty()).then(|| self.part(stretch, part))
        };
        self.stretches[first..].iter().map_while(part)
    }

    fn part(&self, stretch: &Stretch, sites: Range<usize>) -> Part<'_> {
        match stretch.surroundings {
            Surroundings::Alike { from, to } => Part::Alike {
                sites,
                steps: &self.steps[from as usize..to as usize],
            },
            Surroundings::Listed { at } => {
                let first = at as usize + (sites.start - stretch.first as usize);
                Part::Listed {
                    start: &self.start[first..=first + sites.len()],
                    partners: &self.listed,
                    sites,
                }
            }
        }
    }

    /// Calls with every partner of a site.
    #[inline(always)]
    pub fn for_each_of(&self, site: usize, mut call: impl FnMut(Partner)) {
        for part in self.parts(site..site + 1) {
            match part {
                Part::Alike { steps, .. } => steps.iter().for_each(|step| call(step.from(site))),
                Part::Listed { start, partners, .. } => {
                    partners[start[0] as usize..start[1] as usize]
                        .iter()
                        .for_each(|&partner| call(partner));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sites_with_the_same_surroundings_share_them_and_none_is_lost() {
        let lists: Vec<Vec<Partner>> = (0..60usize)
            .map(|site| match site {
                0..20 => [1, 5].map(|step| Partner::new(site + step, PairKind::Any)).to_vec(),
                20..24 => vec![Partner::new(site - 3, PairKind::Any)],
                24 => vec![Partner::new(7, PairKind::Severed)],
                25..30 => vec![],
                _ => vec![
                    Partner::new(site - 30, PairKind::Nearest),
                    Partner::new(site - 1, PairKind::Any),
                ],
            })
            .collect();
        let mut partners = Partners::default();
        lists.iter().for_each(|list| partners.push(list.iter().copied(), false));
        partners.finish();
        assert_eq!(partners.site_count(), 60);
        for (site, list) in lists.iter().enumerate() {
            let mut found = Vec::new();
            partners.for_each_of(site, |partner| found.push(partner));
            assert_eq!(&found, list, "site {site}");
        }
        let alike = partners.parts(0..60).filter(|part| matches!(part, Part::Alike { .. }));
        assert_eq!(alike.count(), 2);
        // Parts of them, moved by as much as their own numbers are.
        let mut copy = Partners::default();
        (0..3).for_each(|_| copy.push(std::iter::empty(), false));
        copy.extend(&partners, 0..60, 3);
        copy.finish();
        for (site, list) in lists.iter().enumerate() {
            let mut found = Vec::new();
            copy.for_each_of(site + 3, |partner| found.push(partner.renumbered(partner.site() - 3)));
            assert_eq!(&found, list, "site {site}");
        }
        let sizes = partners.parts(10..40).map(|part| match part {
            Part::Alike { sites, .. } | Part::Listed { sites, .. } => sites.len(),
        });
        assert_eq!(sizes.sum::<usize>(), 30);
    }
}
