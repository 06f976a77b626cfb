//! The crack: the broken bonds that hang together with the notch.
//!
//! A crack runs through the plaquettes of the lattice; two of them are joined where the bond between them is
//! broken. [`Tracker`] keeps, for every plaquette that can be reached from the mouth of the notch, the number of
//! broken bonds on the shortest way there, and mends this as bonds break and close, in time that grows with the
//! part of the crack that changed. The tip is the foremost reached plaquette. Fragments and holes away from
//! the notch are not reached and so do not count.

pub mod branches;
pub mod plaquette;

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

use super::series::{BondEvent, Setting};
use plaquette::{Bond, Plaquette, PlaquetteMap};

/// Spacings between the points through which the arc length is measured. A crack that goes round single atoms is
/// not longer for it; a straight crack, and one that kinks, keeps its length.
pub const YARDSTICK_SPACINGS: usize = 5;

/// Broken bonds a spacing along a close-packed row.
pub const BONDS_A_SPACING: usize = 2;

const UNREACHED: u32 = u32::MAX;
const INTACT: u32 = u32::MAX;

/// Where the foremost tip is, reference configuration, nm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tip {
    /// From the left edge of the specimen.
    pub x: f64,
    /// From the crack plane.
    pub y: f64,
    /// Length of the crack from the left edge to the tip along its path.
    pub arc_length: f64,
}

/// Follows the crack while bonds break and close.
#[derive(Clone, Debug)]
pub struct Tracker {
    frame: Frame,
    mouth: Plaquette,
    cells: PlaquetteMap<Cell>,
    /// Reached plaquettes, foremost on top; entries that are no longer reached are dropped when they surface.
    foremost: BinaryHeap<(i32, Reverse<i32>, Plaquette)>,
}

/// A plaquette with at least one broken bond (now or before).
#[derive(Clone, Copy, Debug)]
struct Cell {
    /// Broken bonds to cross from the mouth.
    distance: u32,
    /// By direction of the side: the probe at which its bond broke, or `INTACT`.
    opened: [u32; 3],
}

/// The cut, and where it lies in the lattice.
#[derive(Clone, Copy, Debug)]
struct Frame {
    spacing: f64,
    left_x: f64,
    /// Bonds between lattice rows `row` and `row + 1` are cut.
    row: i32,
    cut_end: f64,
}

impl Tracker {
    /// The crack as cut; `None` where the specimen has none.
    pub fn new(setting: &Setting) -> Option<Tracker> {
        let frame = Frame {
            spacing: setting.spacing,
            left_x: setting.left_x,
            row: setting.crack_row? - 1,
            cut_end: setting.crack_length,
        };
        let cut = frame.cut_bonds();
        let mouth = cut
            .first()?
            .plaquettes()
            .into_iter()
            .min_by_key(|side| side.half_spacings())?;
        let mut tracker = Tracker {
            frame,
            mouth,
            cells: PlaquetteMap::default(),
            foremost: BinaryHeap::new(),
        };
        tracker.cells.insert(
            mouth,
            Cell {
                distance: 0,
                opened: [INTACT; 3],
            },
        );
        tracker.foremost.push(tracker.rank(mouth));
        for bond in cut {
            tracker.open(bond, 0);
        }
        Some(tracker)
    }

    /// Takes a bond that broke or closed. The notch itself never closes.
    pub fn apply(&mut self, event: &BondEvent) {
        let bond = Bond {
            column: event.column,
            row: event.row,
            direction: event.direction,
        };
        if event.broken {
            self.open(bond, event.probe);
        } else if !self.frame.is_cut(bond) {
            self.close(bond);
        }
    }

    /// The foremost tip.
    pub fn tip(&self) -> Tip {
        let points: Vec<[f64; 2]> = self.main_path().iter().map(|bond| self.frame.place(*bond)).collect();
        let Some((&last, &first)) = points.last().zip(points.first()) else {
            return Tip::default();
        };
        let stride = YARDSTICK_SPACINGS * BONDS_A_SPACING;
        let marks = points.iter().step_by(stride).chain([&last]);
        let chords = marks
            .clone()
            .zip(marks.skip(1))
            .map(|(a, b)| (b[0] - a[0]).hypot(b[1] - a[1]));
        Tip {
            x: last[0],
            y: last[1],
            arc_length: first[0] + chords.sum::<f64>(),
        }
    }

    /// Broken bonds from the mouth to this one; `None` where it is no part of the crack.
    pub fn depth(&self, event: &BondEvent) -> Option<u32> {
        let bond = Bond {
            column: event.column,
            row: event.row,
            direction: event.direction,
        };
        let depth = bond.plaquettes().map(|side| self.distance(side)).into_iter().min();
        depth.filter(|&depth| depth != UNREACHED)
    }

    /// How many bonds were broken from the mouth to the foremost tip.
    pub fn tip_depth(&self) -> u32 {
        self.distance(self.foremost_plaquette())
    }

    /// The bonds broken from the mouth to the foremost tip.
    fn main_path(&self) -> Vec<Bond> {
        let mut bonds = Vec::new();
        let mut here = self.foremost_plaquette();
        while let Some((bond, nearer)) = self.step_back(here) {
            bonds.push(bond);
            here = nearer;
        }
        bonds.reverse();
        bonds
    }

    /// One step towards the mouth. Of equally short ways the one nearest to the crack plane is taken, so that the
    /// path depends on what is broken and not on the order in which it broke.
    fn step_back(&self, from: Plaquette) -> Option<(Bond, Plaquette)> {
        let cell = self.cells.get(&from)?;
        (0..3)
            .filter(|&direction| cell.opened[usize::from(direction)] != INTACT)
            .map(|direction| from.across(direction))
            .filter(|(_, beyond)| self.distance(*beyond).checked_add(1) == Some(cell.distance))
            .min_by_key(|(_, beyond)| ((beyond.row - self.frame.row).abs(), *beyond))
    }

    fn foremost_plaquette(&self) -> Plaquette {
        self.foremost.peek().map_or(self.mouth, |top| top.2)
    }

    fn distance(&self, plaquette: Plaquette) -> u32 {
        self.cells.get(&plaquette).map_or(UNREACHED, |cell| cell.distance)
    }

    /// Foremost is the largest x; then the nearest to the crack plane.
    fn rank(&self, plaquette: Plaquette) -> (i32, Reverse<i32>, Plaquette) {
        (
            plaquette.half_spacings(),
            Reverse((plaquette.row - self.frame.row).abs()),
            plaquette,
        )
    }

    fn reach(&mut self, plaquette: Plaquette, distance: u32) {
        if let Some(cell) = self.cells.get_mut(&plaquette) {
            let new = cell.distance == UNREACHED;
            cell.distance = distance;
            if new {
                self.foremost.push(self.rank(plaquette));
            }
        }
    }

    fn neighbours(&self, of: Plaquette) -> impl Iterator<Item = Plaquette> + use<> {
        let opened = self.cells.get(&of).map_or([INTACT; 3], |cell| cell.opened);
        (0..3u8)
            .filter(move |&side| opened[usize::from(side)] != INTACT)
            .map(move |side| of.across(side).1)
    }

    fn open(&mut self, bond: Bond, probe: u32) {
        let sides = bond.plaquettes();
        let distances = sides.map(|side| {
            let cell = self.cells.entry(side).or_insert(Cell {
                distance: UNREACHED,
                opened: [INTACT; 3],
            });
            let opened = &mut cell.opened[usize::from(bond.direction)];
            *opened = (*opened).min(probe);
            cell.distance
        });
        let [near, far] = if distances[0] <= distances[1] { [0, 1] } else { [1, 0] };
        let Some(onward) = distances[near].checked_add(1).filter(|&onward| onward < distances[far]) else {
            return;
        };
        // The shorter way spreads from the far side on.
        self.reach(sides[far], onward);
        let mut queue = VecDeque::from([(sides[far], onward)]);
        while let Some((here, distance)) = queue.pop_front() {
            for beyond in self.neighbours(here) {
                if distance + 1 < self.distance(beyond) {
                    self.reach(beyond, distance + 1);
                    queue.push_back((beyond, distance + 1));
                }
            }
        }
    }

    fn close(&mut self, bond: Bond) {
        let sides = bond.plaquettes();
        for side in sides {
            if let Some(cell) = self.cells.get_mut(&side) {
                cell.opened[usize::from(bond.direction)] = INTACT;
            }
        }
        let orphans = self.orphans(sides);
        self.adopt(orphans);
        while self
            .foremost
            .peek()
            .is_some_and(|top| self.distance(top.2) == UNREACHED)
        {
            self.foremost.pop();
        }
    }

    /// Takes back the distances that rested on a way now closed, level by level.
    fn orphans(&mut self, suspects: [Plaquette; 2]) -> Vec<Plaquette> {
        let mut orphans = Vec::new();
        let mut queue = VecDeque::from(suspects);
        while let Some(here) = queue.pop_front() {
            let distance = self.distance(here);
            if distance == UNREACHED || here == self.mouth || self.step_back(here).is_some() {
                continue;
            }
            queue.extend(
                self.neighbours(here)
                    .filter(|&beyond| self.distance(beyond) == distance + 1),
            );
            if let Some(cell) = self.cells.get_mut(&here) {
                cell.distance = UNREACHED;
            }
            orphans.push(here);
        }
        orphans
    }

    /// Reaches the orphans again by the ways that are left, nearest first.
    fn adopt(&mut self, orphans: Vec<Plaquette>) {
        let mut heap: BinaryHeap<Reverse<(u32, Plaquette)>> = BinaryHeap::new();
        for orphan in orphans {
            let nearest = self.neighbours(orphan).map(|beyond| self.distance(beyond)).min();
            if let Some(distance) = nearest.and_then(|nearest| nearest.checked_add(1)) {
                heap.push(Reverse((distance, orphan)));
            }
        }
        while let Some(Reverse((distance, here))) = heap.pop() {
            if distance >= self.distance(here) {
                continue;
            }
            self.reach(here, distance);
            heap.extend(self.neighbours(here).map(|beyond| Reverse((distance + 1, beyond))));
        }
    }
}

impl Frame {
    /// The severed bonds, left to right. A bond counts as severed when its middle is left of the end of the cut;
    /// half a spacing more is taken in, so that a crack is found whichever of its ends decides where the cut stops.
    fn cut_bonds(&self) -> Vec<Bond> {
        let first = ((self.left_x / self.spacing) - 0.5 * f64::from(self.row)).floor() as i32;
        let count = (self.cut_end / self.spacing).ceil() as i32;
        (first..=first + count + 1)
            .flat_map(|column| {
                [2, 1].map(|direction| Bond {
                    column,
                    row: self.row,
                    direction,
                })
            })
            .filter(|bond| self.is_cut(*bond))
            .collect()
    }

    fn is_cut(&self, bond: Bond) -> bool {
        let x = self.place(bond)[0];
        bond.row == self.row && bond.direction != 0 && x >= 0.0 && x < self.cut_end + 0.5 * self.spacing
    }

    /// Middle of a bond, nm from the left edge and from the crack plane.
    fn place(&self, bond: Bond) -> [f64; 2] {
        let [x, y] = bond.midpoint();
        let plane = (f64::from(self.row) + 0.5) * 0.75_f64.sqrt();
        [x * self.spacing - self.left_x, (y - plane) * self.spacing]
    }
}
