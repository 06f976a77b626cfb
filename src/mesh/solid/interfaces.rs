//! Which parts of blocks lie side by side, and where something else or nothing does.

use std::collections::HashMap;
use std::ops::Range;

use fixedbitset::FixedBitSet;

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

impl Run {
    /// The parts on both sides of one of its interfaces.
    pub fn pair(&self, number: usize) -> [u32; 2] {
        [self.first, self.second].map(|first| (first + number - self.number) as u32)
    }

    /// Whether its parts on either side are among some, which start and end with groups.
    pub fn touches(&self, parts: &Range<usize>) -> bool {
        parts.contains(&self.first) || parts.contains(&self.second)
    }
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
    /// Those with first or second neighbours across them that a cut severs, ascending by number.
    pub severed: Vec<u32>,
    /// Ascending by element.
    pub lonely: Vec<Lonely>,
    /// For every part where its interfaces start and end among those listed. Untouched, and so not in memory, for those that
    /// border on none of some parts.
    ranges: Vec<[u32; 2]>,
    of_part: Vec<u32>,
    facing: HashMap<(i32, Side), Vec<[i32; 3]>>,
}

/// The groups of parts by shape, size and row.
struct Numbers(HashMap<(Shape, i32, [i32; 2]), Vec<u32>>);

impl Numbers {
    fn new(mesh: &Solid) -> Self {
        let mut groups: HashMap<(Shape, i32, [i32; 2]), Vec<u32>> = HashMap::new();
        for (number, group) in (0..).zip(mesh.groups()) {
            let [_, j, k] = mesh.elements[group.elements.start].anchor;
            groups
                .entry((group.shape, group.size, [j, k]))
                .or_default()
                .push(number);
        }
        Self(groups)
    }

    /// The number of a part; `None` where it is not there.
    fn of(&self, mesh: &Solid, element: Element) -> Option<u32> {
        let [i, j, k] = element.anchor;
        let groups = self.0.get(&(element.shape, element.size, [j, k]))?;
        groups.iter().find_map(|&number| {
            let group = &mesh.groups()[number as usize];
            let along = i - mesh.elements[group.elements.start].anchor[0];
            let place = along / element.size;
            let is_there = along >= 0 && along % element.size == 0 && (place as usize) < group.len();
            is_there.then(|| (group.elements.start + place as usize) as u32)
        })
    }
}

impl Interfaces {
    /// `reach` is that of the potential, in spacings.
    pub fn new(mesh: &Solid, reach: f64) -> Self {
        Self::listed_for(mesh, reach, 0..mesh.parts)
    }

    /// The same, where only the interfaces of some parts, which start and end with groups, are listed one by one.
    pub fn listed_for(mesh: &Solid, reach: f64, listed: Range<usize>) -> Self {
        let parts = &mesh.elements[..mesh.parts];
        let numbers = Numbers::new(mesh);
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
        interfaces.list_by_part(mesh.parts, &listed);
        interfaces.find_lonely(mesh, &numbers);
        interfaces.find_severed(mesh);
        interfaces
    }

    fn add_runs(&mut self, mesh: &Solid, numbers: &Numbers, parts: Range<usize>, side: Side) {
        for first in parts {
            let Some(second) = numbers.of(mesh, side.other(mesh.elements[first])) else {
                continue;
            };
            let number = self.count();
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

    fn list_by_part(&mut self, parts: usize, listed: &Range<usize>) {
        let runs = || self.runs.iter().filter(|run| run.touches(listed));
        let pairs = || {
            runs().flat_map(|run| (run.number..run.number + run.len).map(|number| (number as u32, run.pair(number))))
        };
        let mut ranges = vec![[0; 2]; parts];
        pairs().for_each(|(_, pair)| pair.iter().for_each(|&part| ranges[part as usize][1] += 1));
        let mut total = 0;
        let mut of_part = vec![0; 2 * pairs().count()];
        // A part finds its place when it is first met.
        let mut is_placed = FixedBitSet::with_capacity(parts);
        for part in pairs().flat_map(|(_, pair)| pair) {
            if !is_placed.put(part as usize) {
                let [start, end] = &mut ranges[part as usize];
                *start = total;
                total += *end;
                *end = *start;
            }
        }
        for (number, pair) in pairs() {
            for part in pair {
                let [_, end] = &mut ranges[part as usize];
                of_part[*end as usize] = number;
                *end += 1;
            }
        }
        (self.ranges, self.of_part) = (ranges, of_part);
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.runs.last().map_or(0, |run| run.number + run.len)
    }

    fn run_of(&self, number: u32) -> &Run {
        let after = self.runs.partition_point(|run| run.number <= number as usize);
        &self.runs[after - 1]
    }

    /// The parts on both sides of an interface.
    pub fn pair(&self, number: u32) -> [u32; 2] {
        self.run_of(number).pair(number as usize)
    }

    /// The parts on both sides of each interface, and its place among [`BORDERS`].
    pub fn pairs(&self) -> impl Iterator<Item = ([u32; 2], usize)> {
        let of_run = |run: &Run| {
            let run = *run;
            (run.number..run.number + run.len).map(move |number| (run.pair(number), run.border))
        };
        self.runs.iter().flat_map(of_run)
    }

    fn find_lonely(&mut self, mesh: &Solid, numbers: &Numbers) {
        let sides: Vec<Side> = Side::all().collect();
        let parts = &mesh.elements[..mesh.parts];
        for (number, &element) in (0..).zip(parts) {
            for &side in sides.iter().filter(|side| side.own_shape() == element.shape) {
                let other = side.other(element);
                if numbers.of(mesh, other).is_none() {
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
        let is_severed = |(number, [first, second]): (u32, [u32; 2])| {
            let facing = self.facing(mesh.elements[first as usize], self.side(number, first));
            severed::is_severed_between(mesh, first, second, facing).then_some(number)
        };
        let pairs = (0..).zip(self.pairs().map(|(pair, _)| pair));
        self.severed = pairs.filter_map(is_severed).collect();
    }

    /// Parts that have a side along which atoms or parts of another size lie, ascending.
    pub fn beside_others(&self) -> Vec<u32> {
        let lonely = self.lonely.iter().filter(|side| !side.is_free);
        let mut parts: Vec<u32> = lonely.map(|side| side.element).collect();
        parts.dedup();
        parts
    }

    /// Numbers of the interfaces of a part, ascending; of a part that is not listed only those with parts that are.
    pub fn of(&self, part: usize) -> &[u32] {
        let [start, end] = self.ranges[part];
        &self.of_part[start as usize..end as usize]
    }

    /// Local coordinates of the sites of a part that have neighbours or second neighbours across one of its sides.
    pub fn facing(&self, element: Element, side: Side) -> &[[i32; 3]] {
        &self.facing[&(element.size, side)]
    }

    /// An interface seen from one of its parts.
    pub fn side(&self, number: u32, part: u32) -> Side {
        let run = self.run_of(number);
        Side {
            border: run.border as u8,
            is_second: run.pair(number as usize)[1] == part,
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
