//! Which parts of blocks lie side by side, and where something else or nothing does.

use std::collections::HashMap;

use super::Solid;
use super::element::{Element, Shape};
use super::severed;
pub use super::severed::SECOND_NEIGHBOURS;
use super::template::{BORDERS, Border};
use crate::lattice::fcc;

/// Borders of one kind between parts side by side: the first of it between the first parts, and so on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// Place among [`BORDERS`].
    pub border: usize,
    /// Number of its first interface.
    pub number: usize,
    pub len: usize,
    /// The first of the parts on either side.
    pub first: usize,
    pub second: usize,
}

/// A side of a part along which there is no part of the same size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lonely {
    pub element: u32,
    pub side: Side,
    /// No site lies beyond it.
    pub is_free: bool,
}

/// A border seen from one of its parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Side {
    pub border: u8,
    pub is_second: bool,
}

impl Side {
    fn border(self) -> &'static Border {
        &BORDERS[usize::from(self.border)]
    }

    fn own_shape(self) -> Shape {
        let border = self.border();
        if self.is_second { border.second } else { border.first }
    }

    /// The part on the other side, whether it is there or not.
    fn other(self, element: Element) -> Element {
        let border = self.border();
        let (shape, sign) = if self.is_second {
            (border.first, -1)
        } else {
            (border.second, 1)
        };
        let anchor = std::array::from_fn(|axis| element.anchor[axis] + sign * element.size * border.shift[axis]);
        Element {
            shape,
            anchor,
            ..element
        }
    }

    fn all() -> impl Iterator<Item = Self> {
        let borders = 0..BORDERS.len() as u8;
        borders.flat_map(|border| [false, true].map(|is_second| Self { border, is_second }))
    }
}

/// The interfaces of a solid between parts of equal blocks, and what borders on anything else.
#[derive(Clone, Debug, Default)]
pub struct Interfaces {
    pub runs: Vec<Run>,
    /// The parts on both sides of each interface.
    pub pairs: Vec<[u32; 2]>,
    /// Place of each among [`BORDERS`].
    pub borders: Vec<u8>,
    /// Those with first or second neighbours across them that a cut severs, ascending by number.
    pub severed: Vec<u32>,
    /// Ascending by element.
    pub lonely: Vec<Lonely>,
    starts: Vec<u32>,
    of_part: Vec<u32>,
    facing: HashMap<(i32, Side), Vec<[i32; 3]>>,
}

impl Interfaces {
    /// `reach` is that of the potential, in spacings.
    pub fn new(mesh: &Solid, reach: f64) -> Self {
        let parts = &mesh.elements[..mesh.parts];
        let numbers: HashMap<Element, u32> = parts.iter().copied().zip(0..).collect();
        let mut interfaces = Self {
            facing: facing(parts, reach),
            ..Self::default()
        };
        for group in mesh.groups() {
            for (number, border) in BORDERS.iter().enumerate() {
                if border.first == group.shape {
                    let side = Side {
                        border: number as u8,
                        is_second: false,
                    };
                    interfaces.add_runs(mesh, &numbers, group.elements.clone(), side);
                }
            }
        }
        interfaces.list_by_part(mesh.parts);
        interfaces.find_lonely(mesh, &numbers);
        interfaces.find_severed(mesh);
        interfaces
    }

    fn add_runs(&mut self, mesh: &Solid, numbers: &HashMap<Element, u32>, parts: std::ops::Range<usize>, side: Side) {
        for first in parts {
            let Some(&second) = numbers.get(&side.other(mesh.elements[first])) else {
                continue;
            };
            let number = self.pairs.len();
            self.pairs.push([first as u32, second]);
            self.borders.push(side.border);
            let second = second as usize;
            let goes_on = |run: &&mut Run| {
                let follows = run.first + run.len == first && run.second + run.len == second;
                let same_groups = mesh.group_number(run.first) == mesh.group_number(first)
                    && mesh.group_number(run.second) == mesh.group_number(second);
                run.border == usize::from(side.border) && follows && same_groups
            };
            match self.runs.last_mut().filter(goes_on) {
                Some(run) => run.len += 1,
                None => self.runs.push(Run {
                    border: usize::from(side.border),
                    number,
                    len: 1,
                    first,
                    second,
                }),
            }
        }
    }

    fn list_by_part(&mut self, parts: usize) {
        let mut counts = vec![0u32; parts + 1];
        self.pairs
            .iter()
            .flatten()
            .for_each(|&part| counts[part as usize + 1] += 1);
        (0..parts).for_each(|part| counts[part + 1] += counts[part]);
        let mut next = counts.clone();
        self.of_part = vec![0; 2 * self.pairs.len()];
        for (number, pair) in (0..).zip(&self.pairs) {
            for &part in pair {
                self.of_part[next[part as usize] as usize] = number;
                next[part as usize] += 1;
            }
        }
        self.starts = counts;
    }

    fn find_lonely(&mut self, mesh: &Solid, numbers: &HashMap<Element, u32>) {
        let sides: Vec<Side> = Side::all().collect();
        let parts = &mesh.elements[..mesh.parts];
        for (number, &element) in (0..).zip(parts) {
            for &side in sides.iter().filter(|side| side.own_shape() == element.shape) {
                let other = side.other(element);
                if !numbers.contains_key(&other) {
                    let theirs = opposite(side);
                    let mut beyond = self.facing[&(element.size, theirs)].iter();
                    let is_free = !beyond.any(|&local| mesh.sites.contains(other.site(local)));
                    self.lonely.push(Lonely {
                        element: number,
                        side,
                        is_free,
                    });
                }
            }
        }
    }

    fn find_severed(&mut self, mesh: &Solid) {
        if mesh.sites.cut.is_none() {
            return;
        }
        let is_severed = |&number: &u32| {
            let [first, second] = self.pairs[number as usize];
            let facing = self.facing(mesh.elements[first as usize], self.side(number, first));
            severed::is_severed_between(mesh, first, second, facing)
        };
        self.severed = (0..self.pairs.len() as u32).filter(is_severed).collect();
    }

    /// Parts that have a side along which atoms or parts of another size lie, ascending.
    pub fn beside_others(&self) -> Vec<u32> {
        let lonely = self.lonely.iter().filter(|side| !side.is_free);
        let mut parts: Vec<u32> = lonely.map(|side| side.element).collect();
        parts.dedup();
        parts
    }

    /// Numbers of the interfaces of a part, ascending.
    pub fn of(&self, part: usize) -> &[u32] {
        &self.of_part[self.starts[part] as usize..self.starts[part + 1] as usize]
    }

    /// Local coordinates of the sites of a part that have neighbours or second neighbours across one of its sides.
    pub fn facing(&self, element: Element, side: Side) -> &[[i32; 3]] {
        &self.facing[&(element.size, side)]
    }

    /// An interface seen from one of its parts.
    pub fn side(&self, number: u32, part: u32) -> Side {
        Side {
            border: self.borders[number as usize],
            is_second: self.pairs[number as usize][1] == part,
        }
    }
}

fn opposite(side: Side) -> Side {
    Side {
        is_second: !side.is_second,
        ..side
    }
}

/// The facing sites of all sizes of blocks and all sides. Where the potential reaches beyond second neighbours, all sites
/// within its reach of any side face all of them.
fn facing(parts: &[Element], reach: f64) -> HashMap<(i32, Side), Vec<[i32; 3]>> {
    let mut sizes: Vec<i32> = parts.iter().map(|element| element.size).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let is_long = reach > SECOND_NEIGHBOURS;
    let half = fcc::half_vectors_within(reach.max(SECOND_NEIGHBOURS));
    let vectors: Vec<[i32; 3]> = half
        .into_iter()
        .flat_map(|v| [v, v.map(|component| -component)])
        .collect();
    let mut facing = HashMap::new();
    for size in sizes {
        for side in Side::all() {
            let own = Element {
                shape: side.own_shape(),
                size,
                anchor: [0; 3],
            };
            let other = side.other(own);
            let faces = |local: &[i32; 3]| {
                let mut neighbours = vectors
                    .iter()
                    .map(|vector| std::array::from_fn(|axis| local[axis] + vector[axis]));
                neighbours.any(|neighbour| {
                    if is_long {
                        !own.contains(neighbour)
                    } else {
                        other.contains(neighbour)
                    }
                })
            };
            facing.insert((size, side), own.locals().filter(faces).collect());
        }
    }
    facing
}
