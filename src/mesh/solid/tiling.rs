//! How a solid is filled: blocks of the size that is wanted, smaller ones where they do not fit, atoms in what is left.

use super::element::{Element, Shape};
use super::region::Region;
use super::sites::{Share, Sites};

/// Blocks smaller than this have no room for three different parts.
pub const SMALLEST_BLOCK: i32 = 3;

/// Elements of a solid: the parts of blocks row by row, those along a1 after each other, and then the atoms.
pub fn tile(sites: &Sites, element: i32, regions: &[Region]) -> (Vec<Element>, usize) {
    let filling = Filling {
        sites,
        element,
        regions,
        sizes: sizes(element, regions),
    };
    let bounds = sites.bounds();
    let (mut blocks, mut atoms) = (Vec::new(), Vec::new());
    let first = |axis: usize| bounds.from[axis].div_euclid(element) * element;
    let starts = |axis: usize| (first(axis)..bounds.to[axis]).step_by(element as usize);
    for k in starts(2) {
        for j in starts(1) {
            let row = blocks.len();
            starts(0).for_each(|i| filling.fill([i, j, k], 0, &mut blocks, &mut atoms));
            blocks[row..].sort_by_key(|&(size, [i, j, k]): &(i32, [i32; 3])| (-size, k, j, i));
        }
    }
    let beside = |a: &(i32, [i32; 3]), b: &(i32, [i32; 3])| a.0 == b.0 && a.1[1..] == b.1[1..];
    let mut elements = Vec::with_capacity(3 * blocks.len() + atoms.len());
    for row in blocks.chunk_by(beside) {
        for shape in Shape::OF_BLOCK {
            elements.extend(row.iter().map(|&(size, anchor)| Element { shape, size, anchor }));
        }
    }
    let parts = elements.len();
    atoms.sort_unstable_by_key(|&[i, j, k]: &[i32; 3]| (k, j, i));
    elements.extend(atoms.into_iter().map(Element::atom));
    (elements, parts)
}

/// Sizes of blocks to be tried, falling: what is asked for, and a half of the largest for the faces of the specimen.
fn sizes(element: i32, regions: &[Region]) -> Vec<i32> {
    let asked = regions.iter().map(|region| i32::from(region.element));
    let mut sizes: Vec<i32> = asked.chain([element, element / 2]).collect();
    sizes.retain(|&size| size >= SMALLEST_BLOCK);
    sizes.sort_unstable_by(|a, b| b.cmp(a));
    sizes.dedup();
    sizes
}

struct Filling<'a> {
    sites: &'a Sites,
    element: i32,
    regions: &'a [Region],
    sizes: Vec<i32>,
}

impl Filling<'_> {
    /// Fills a cube of sites with blocks of this size, given by its place among the sizes, or smaller ones.
    fn fill(&self, anchor: [i32; 3], at: usize, blocks: &mut Vec<(i32, [i32; 3])>, atoms: &mut Vec<[i32; 3]>) {
        let Some(&size) = self.sizes.get(at) else {
            return self.fill_with_atoms(anchor, self.cell_below(at), [0; 3], atoms);
        };
        let cell = self.cell_below(at);
        let count = cell / size;
        for number in 0..count * count * count {
            let [p, q, r] = [number % count, number / count % count, number / (count * count)];
            let corner = [anchor[0] + p * size, anchor[1] + q * size, anchor[2] + r * size];
            match self.sites.share_of(corner, size) {
                Share::Nothing => (),
                Share::All if self.is_allowed(corner, size) => blocks.push((size, corner)),
                _ => self.fill(corner, at + 1, blocks, atoms),
            }
        }
        if count * size < cell {
            self.fill_with_atoms(anchor, cell, [count * size; 3], atoms);
        }
    }

    /// The cube that blocks of the size at this place have to fill.
    fn cell_below(&self, at: usize) -> i32 {
        match at {
            0 => self.element,
            at => self.sizes[at - 1],
        }
    }

    /// Makes atoms of the sites of a cube that are beyond a smaller one at its anchor.
    fn fill_with_atoms(&self, anchor: [i32; 3], cell: i32, filled: [i32; 3], atoms: &mut Vec<[i32; 3]>) {
        for r in 0..cell {
            for q in 0..cell {
                for p in 0..cell {
                    let is_filled = p < filled[0] && q < filled[1] && r < filled[2];
                    let site = [anchor[0] + p, anchor[1] + q, anchor[2] + r];
                    if !is_filled && self.sites.contains(site) {
                        atoms.push(site);
                    }
                }
            }
        }
    }

    /// Whether no site of a block lies in a region that asks for smaller ones.
    fn is_allowed(&self, anchor: [i32; 3], size: i32) -> bool {
        let frame = &self.sites.frame;
        let middle = frame.place_between(anchor.map(|component| f64::from(component) + 0.5 * f64::from(size - 1)));
        // The long diagonal of a cube of 60 degrees is sqrt(6) of its edges.
        let spacing = frame.vectors[0]
            .iter()
            .map(|component| component * component)
            .sum::<f64>()
            .sqrt();
        let radius = 0.5 * 6f64.sqrt() * f64::from(size - 1) * spacing;
        let finer = self.regions.iter().filter(|region| i32::from(region.element) < size);
        let mut near = finer.filter(|region| region.shape.distance(middle) <= radius);
        !near.any(|region| {
            let sites =
                (0..size * size * size).map(|number| [number % size, number / size % size, number / (size * size)]);
            let mut places = sites.map(|local| frame.place(std::array::from_fn(|axis| anchor[axis] + local[axis])));
            places.any(|place| region.shape.contains(place))
        })
    }
}
