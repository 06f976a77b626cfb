//! The crack as a tree: the main path from the mouth through the foremost tip, and what forks off it.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use super::plaquette::Bond;
use super::{BONDS_A_SPACING, Tracker, UNREACHED};

/// One arm of the crack, from where it leaves its parent to its end.
#[derive(Clone, Debug, PartialEq)]
pub struct Arm {
    /// Index of the arm it forks off; `None` for the main crack.
    pub parent: Option<usize>,
    /// Probe at which both this arm and its parent's way onward had opened; for the main crack, 0.
    pub born: u32,
    /// Probe at which its youngest bond broke.
    pub grown: u32,
    /// The fork, nm from the left edge and from the crack plane; for the main crack, the mouth.
    pub x: f64,
    pub y: f64,
    /// Direction in which it sets out, degrees from the x axis, counterclockwise.
    pub angle: f64,
}

impl Arm {
    /// Whether it is a branch: neither the main crack nor what was left of the old tip when the crack joined one ahead of it
    /// (`joins`: the probes at which it did).
    pub fn is_branch(&self, joins: &[u32]) -> bool {
        self.parent.is_some() && !joins.contains(&self.born)
    }
}

/// The main crack, then its branches, longest first.
///
/// A side path is a branch when it is at least `spur` spacings long and ends at least half of that away from every
/// arm kept before it, so that bonds broken beside the path do not count. Its direction is that of the chord over
/// its first `2 spur` spacings.
pub fn arms(tracker: &Tracker, spur: usize) -> Vec<Arm> {
    let tree = Tree::of(tracker);
    let mut growth = Growth {
        tracker,
        spur,
        kept: Kept {
            reach: spur as f64 / 2.0,
            points: HashMap::new(),
        },
        stems: BinaryHeap::new(),
        arms: Vec::new(),
    };
    growth.take(&tree, tree.main_way(tracker), None, None);
    while let Some(stem) = growth.stems.pop() {
        let way = tree.way(stem.start);
        let end = way.last().and_then(|&end| tree.entry[end]);
        if end.is_some_and(|bond| !growth.kept.is_near(bond.midpoint())) {
            growth.take(&tree, way, Some(stem.parent), stem.rival);
        }
    }
    growth.arms
}

/// The shortest ways from the mouth. Cells are numbered outwards, so that the mouth is 0 and each comes after the one
/// before it on its way; `cells` holds their numbers in the tracker.
struct Tree {
    cells: Vec<usize>,
    /// The bond by which each is reached; `None` for the mouth.
    entry: Vec<Option<Bond>>,
    before: Vec<usize>,
    onward: Vec<Vec<usize>>,
    /// Bonds from here to the farthest end beyond.
    ahead: Vec<u32>,
}

impl Tree {
    fn of(tracker: &Tracker) -> Tree {
        let reached = tracker
            .cells
            .iter()
            .enumerate()
            .filter(|(_, cell)| cell.distance != UNREACHED);
        let mut order: Vec<_> = reached
            .map(|(index, cell)| (cell.distance, cell.place, index))
            .collect();
        order.sort_unstable();
        let cells: Vec<usize> = order.into_iter().map(|(_, _, index)| index).collect();
        let mut place = vec![0; tracker.cells.len()];
        cells.iter().enumerate().for_each(|(here, &cell)| place[cell] = here);

        let steps: Vec<_> = cells.iter().map(|&cell| tracker.step_back(cell)).collect();
        let before: Vec<usize> = steps
            .iter()
            .map(|step| step.map_or(0, |(_, cell)| place[cell]))
            .collect();
        let mut onward = vec![Vec::new(); cells.len()];
        let mut ahead = vec![0; cells.len()];
        for cell in (1..cells.len()).rev() {
            onward[before[cell]].push(cell);
            ahead[before[cell]] = ahead[before[cell]].max(ahead[cell] + 1);
        }
        Tree {
            entry: steps.iter().map(|step| step.map(|(bond, _)| bond)).collect(),
            cells,
            before,
            onward,
            ahead,
        }
    }

    /// From the mouth through the foremost tip and on to the farthest end beyond it.
    fn main_way(&self, tracker: &Tracker) -> Vec<usize> {
        let tip = tracker.foremost_cell();
        let Some(mut cell) = self.cells.iter().position(|&place| place == tip) else {
            return Vec::new();
        };
        let mut way = self.way(cell);
        way.reverse();
        while cell != 0 {
            cell = self.before[cell];
            way.push(cell);
        }
        way.reverse();
        way
    }

    /// From a plaquette to the farthest end beyond it, both included.
    fn way(&self, from: usize) -> Vec<usize> {
        let farther = |cell: &usize| (self.ahead[*cell], Reverse(*cell));
        std::iter::successors(Some(from), |&cell| {
            self.onward[cell].iter().copied().max_by_key(farther)
        })
        .collect()
    }
}

/// A side path not yet looked at; the longest comes first.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Stem {
    length: u32,
    start: usize,
    parent: usize,
    /// When the parent's way onward from the fork opened.
    rival: Option<u32>,
}

struct Growth<'a> {
    tracker: &'a Tracker,
    spur: usize,
    kept: Kept,
    stems: BinaryHeap<Stem>,
    arms: Vec<Arm>,
}

impl Growth<'_> {
    /// Keeps an arm and notes the side paths that leave it.
    fn take(&mut self, tree: &Tree, way: Vec<usize>, parent: Option<usize>, rival: Option<u32>) {
        let bonds: Vec<Bond> = way.iter().filter_map(|&cell| tree.entry[cell]).collect();
        let places: Vec<[f64; 2]> = bonds.iter().map(|&bond| self.tracker.notch.place(bond)).collect();
        let (Some(&first), Some(&start)) = (bonds.first(), places.first()) else {
            return;
        };
        let far = places[(2 * self.spur * BONDS_A_SPACING).min(places.len() - 1)];
        let grown = bonds.iter().map(|&bond| self.tracker.opened(bond)).max();
        self.arms.push(Arm {
            parent,
            born: if parent.is_none() {
                0
            } else {
                self.tracker.opened(first).max(rival.unwrap_or(0))
            },
            grown: grown.unwrap_or(0),
            x: start[0],
            y: start[1],
            angle: (far[1] - start[1]).atan2(far[0] - start[0]).to_degrees(),
        });
        for (place, &cell) in way.iter().enumerate() {
            let next = way.get(place + 1);
            let rival = next
                .and_then(|&next| tree.entry[next])
                .map(|bond| self.tracker.opened(bond));
            for &start in tree.onward[cell].iter().filter(|side| Some(*side) != next) {
                let length = tree.ahead[start] + 1;
                if length as usize >= self.spur * BONDS_A_SPACING {
                    self.stems.push(Stem {
                        length,
                        start,
                        parent: self.arms.len() - 1,
                        rival,
                    });
                }
            }
        }
        bonds.iter().for_each(|bond| self.kept.add(bond.midpoint()));
    }
}

/// Points of the arms kept so far, in squares of the distance asked for. Units of the spacing.
struct Kept {
    reach: f64,
    points: HashMap<[i32; 2], Vec<[f64; 2]>>,
}

impl Kept {
    fn square(&self, point: [f64; 2]) -> [i32; 2] {
        point.map(|along| (along / self.reach).floor() as i32)
    }

    fn add(&mut self, point: [f64; 2]) {
        self.points.entry(self.square(point)).or_default().push(point);
    }

    fn is_near(&self, point: [f64; 2]) -> bool {
        let [column, row] = self.square(point);
        let around = (-1..=1).flat_map(|right| (-1..=1).map(move |up| [column + right, row + up]));
        let near = |other: &[f64; 2]| (other[0] - point[0]).hypot(other[1] - point[1]) < self.reach;
        around.filter_map(|square| self.points.get(&square)).flatten().any(near)
    }
}
