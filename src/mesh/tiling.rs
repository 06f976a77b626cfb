//! Covers every site of a specimen with exactly one element.

use std::ops::Range;

use fixedbitset::FixedBitSet;

use super::element::Element;
use super::sites::SiteSet;

/// The largest element size allowed at the sites, by their numbers.
pub enum Target {
    Everywhere(u16),
    Each(Vec<u16>),
}

/// Chooses the elements: rows of triangles as the source lays them, finer ones where they are wanted, and in what
/// is left over the largest triangles that fit, down to atoms.
///
/// An element that holds a site of a finer target gives
/// all its sites to the finer one, so that the border of a region runs along elements. No element crosses a row
/// boundary in `breaks` (ascending, from 0 to the number of rows). Rows are laid from the crack plane outward, so that
/// what is left over lies at the far end of the band between two breaks, towards the grips.
pub fn tile(sites: &SiteSet, target: Target, breaks: &[i32]) -> Vec<Element> {
    let mut tiling = Tiling {
        sites,
        target,
        covered: FixedBitSet::with_capacity(sites.len()),
        breaks,
        elements: Vec::new(),
    };
    let sizes = tiling.target.sizes();
    for &size in sizes.iter().filter(|&&size| size >= SMALLEST_TRIANGLE) {
        tiling.lay_rows(size);
    }
    let mut free = tiling.free_sites();
    for size in (SMALLEST_TRIANGLE..sizes[0].max(SMALLEST_TRIANGLE)).rev() {
        tiling.fill(size, &free);
        free.retain(|&site| tiling.is_free(site));
    }
    tiling.elements.extend(free.into_iter().map(Element::atom));
    let mut elements = tiling.elements;
    elements.sort_by_key(|e| (-e.size, e.lowest_row(), -e.sign, e.lowest_column()));
    elements
}

/// Two sites an edge would be three atoms with the mass and the freedom of three atoms: they are atoms.
const SMALLEST_TRIANGLE: i32 = 3;

struct Tiling<'a> {
    sites: &'a SiteSet,
    target: Target,
    covered: FixedBitSet,
    breaks: &'a [i32],
    elements: Vec<Element>,
}

impl Tiling<'_> {
    /// The regular pattern of one size in every band of rows between two breaks, from the crack plane outward. The row
    /// nearest to it starts flush with the left face.
    fn lay_rows(&mut self, size: i32) {
        let layout = self.sites.layout;
        for band in self.breaks.windows(2) {
            let is_above = band[0] >= self.sites.middle_row();
            let nearest = if is_above { band[0] } else { band[1] - 1 };
            let block_row = nearest.div_euclid(layout.block);
            let starts_upright = layout.starts_upright(block_row);
            let flush = layout.anchor(block_row);
            for k in 0..(band[1] - band[0]) / size {
                // Two rows further the sides stand where they stood, a column further each two lattice rows.
                let steps = (k + i32::from(starts_upright != is_above)).div_euclid(2);
                if is_above {
                    self.lay_row(size, band[0] + k * size, flush - size * steps);
                } else {
                    // A row that starts inverted is flush at its top, which lies a block above its anchor.
                    let first = if starts_upright {
                        flush
                    } else {
                        flush + size - layout.block
                    };
                    self.lay_row(size, band[1] - (k + 1) * size, first + size * steps);
                }
            }
        }
    }

    /// Upright triangles anchored every size + 1 columns from `anchor` on either side, inverted ones between them.
    fn lay_row(&mut self, size: i32, row: i32, anchor: i32) {
        let top = row + size - 1;
        let [low, high] = [row, top].map(|r| self.sites.columns(r));
        let first = (low.start.min(high.start) - anchor).div_euclid(size + 1) - 1;
        let last = (low.end.max(high.end) - anchor).div_euclid(size + 1) + 1;
        for cell in first..=last {
            let column = anchor + cell * (size + 1);
            self.place(Element {
                size,
                sign: 1,
                column,
                row,
            });
            self.place(Element {
                size,
                sign: -1,
                column: column + size,
                row: top,
            });
        }
    }

    /// Places a triangle if all its sites are free and none wants a finer element; in the latter case all do then.
    fn place(&mut self, element: Element) {
        let Some(finest) = self.finest_if_free(&element) else {
            return;
        };
        if i32::from(finest) >= element.size {
            self.cover(element);
            return;
        }
        let runs = self.runs(&element);
        self.target.make_finer(runs, element.size, finest);
    }

    /// Puts triangles of one size wherever free sites allow, scanning site by site.
    fn fill(&mut self, size: i32, free: &[[i32; 2]]) {
        for &[column, row] in free {
            for sign in [1, -1] {
                let element = Element {
                    size,
                    sign,
                    column,
                    row,
                };
                let fits = !self.crosses_a_break(&element)
                    && self
                        .finest_if_free(&element)
                        .is_some_and(|finest| i32::from(finest) >= size);
                if fits {
                    self.cover(element);
                }
            }
        }
    }

    fn free_sites(&self) -> Vec<[i32; 2]> {
        let numbered = self.sites.iter().enumerate();
        let free = numbered.filter(|(number, _)| !self.covered.contains(*number));
        free.map(|(_, site)| site).collect()
    }

    fn is_free(&self, site: [i32; 2]) -> bool {
        self.sites
            .index(site)
            .is_some_and(|number| !self.covered.contains(number))
    }

    /// The finest element that a site of this one wants; `None` unless all are there and free.
    fn finest_if_free(&self, element: &Element) -> Option<u16> {
        let mut finest = u16::MAX;
        for (leftmost, count) in element.rows() {
            let run = self.sites.run(leftmost, count)?;
            if self.covered.contains_any_in_range(run.clone()) {
                return None;
            }
            finest = finest.min(self.target.finest(run));
        }
        Some(finest)
    }

    /// Numbers of the sites of an element inside the specimen, row by row.
    fn runs(&self, element: &Element) -> Vec<Range<usize>> {
        let rows = element.rows();
        rows.filter_map(|(leftmost, count)| self.sites.run(leftmost, count))
            .collect()
    }

    fn cover(&mut self, element: Element) {
        for run in self.runs(&element) {
            self.covered.insert_range(run);
        }
        self.elements.push(element);
    }

    fn crosses_a_break(&self, element: &Element) -> bool {
        let [low, high] = [element.lowest_row(), element.lowest_row() + element.size - 1];
        self.breaks.iter().any(|&row| low < row && row <= high)
    }
}

impl Target {
    /// All sizes, falling.
    fn sizes(&self) -> Vec<i32> {
        match self {
            Self::Everywhere(size) => vec![i32::from(*size)],
            Self::Each(sizes) => {
                let runs = sizes.chunk_by(|a, b| a == b);
                let mut sizes: Vec<i32> = runs.map(|run| i32::from(run[0])).collect();
                sizes.sort_unstable_by(|a, b| b.cmp(a));
                sizes.dedup();
                sizes
            }
        }
    }

    fn finest(&self, run: Range<usize>) -> u16 {
        match self {
            Self::Everywhere(size) => *size,
            Self::Each(sizes) => sizes[run].iter().fold(u16::MAX, |finest, &size| finest.min(size)),
        }
    }

    /// Makes sites finer that allow elements of this size.
    fn make_finer(&mut self, runs: Vec<Range<usize>>, size: i32, finest: u16) {
        if let Self::Each(sizes) = self {
            let allowed = runs.into_iter().flatten();
            allowed.for_each(|site| {
                if i32::from(sizes[site]) >= size {
                    sizes[site] = finest;
                }
            });
        }
    }
}

#[cfg(test)]
mod tests;
