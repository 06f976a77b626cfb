//! The crack: the broken bonds that hang together with the notch.
//!
//! A crack runs through the plaquettes of the lattice; two of them are joined where the bond between them is
//! broken. [`Tracker`] keeps, for every plaquette that can be reached from the mouth of the notch, the number of
//! broken bonds on the shortest way there, and mends this as bonds break and close, in time that grows with the
//! part of the crack that changed. The tip is the foremost reached plaquette. Fragments and holes away from
//! the notch are not reached and so do not count.
//!
//! All of this is in the frame of the crack: it comes from the left, and x is measured from its edge. Of a notch inside, x
//! is measured from its middle, which is the mouth: what runs to the other side is not reached.

pub mod branches;
pub mod joins;
pub mod leaving;
mod notch;
pub mod plaquette;
mod ways;

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::series::{BondEvent, Setting};
use notch::Notch;
use plaquette::{Bond, Plaquette, PlaquetteMap};

/// Spacings between the points through which the arc length is measured. A crack that goes round single atoms is
/// not longer for it; a straight crack, and one that kinks, keeps its length.
pub const YARDSTICK_SPACINGS: usize = 5;

/// Broken bonds a spacing along a close-packed row.
pub const BONDS_A_SPACING: usize = 2;

/// Side paths shorter than this are not branches: beside a path through atoms a few bonds break as the crack passes.
pub const SPUR_SPACINGS: usize = 5;

/// A coarse mesh opens one edge of an element at once; only what is longer than this many edges is a branch there.
pub const SPUR_ELEMENTS: usize = 2;

const UNREACHED: u32 = u32::MAX;
const INTACT: u32 = u32::MAX;

/// Length below which a side path is no branch, spacings.
pub fn spur(setting: &Setting) -> usize {
    SPUR_SPACINGS.max(SPUR_ELEMENTS * setting.element_at_crack as usize)
}

/// Where the foremost tip is, reference configuration, nm.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tip {
    /// From the left edge of the specimen; in the frame of the crack from where it is measured.
    pub x: f64,
    /// From the crack plane.
    pub y: f64,
    /// Length of the crack to the tip along its path, from its edge; of a crack inside from the middle of its notch.
    pub arc_length: f64,
}

/// Follows the crack while bonds break and close.
#[derive(Clone, Debug)]
pub struct Tracker {
    notch: Notch,
    /// Bonds from the tip back to where faces that touch no longer end the crack.
    wake: u32,
    /// Every plaquette with a broken bond, now or before; the mouth is the first. They name each other by index, so
    /// that only a bond that breaks or closes has to be looked up.
    cells: Vec<Cell>,
    index: PlaquetteMap<usize>,
    /// Reached plaquettes, foremost on top; entries that are no longer reached are dropped when they surface.
    foremost: BinaryHeap<Rank>,
    /// The first cell that was reached far from the crack plane.
    departed: Option<usize>,
}

/// Foremost is the largest x; then the nearest to the crack plane.
type Rank = (i32, Reverse<i32>, Plaquette, usize);

#[derive(Clone, Copy, Debug)]
struct Cell {
    place: Plaquette,
    /// Broken bonds to cross from the mouth.
    distance: u32,
    /// By direction of the side: the probe at which its bond broke, or `INTACT`, and the cell beyond it.
    opened: [u32; 3],
    beyond: [usize; 3],
}

const MOUTH: usize = 0;

impl Tracker {
    /// The crack as cut, in its own frame; `None` where the specimen has none.
    pub fn new(setting: &Setting) -> Option<Tracker> {
        let notch = Notch {
            spacing: setting.spacing,
            left_x: setting.left_x,
            row: setting.crack_row? - 1,
            cut_end: setting.crack_length,
            is_inside: setting.is_crack_inside(),
        };
        let cut = notch.cut_bonds();
        let mouth = cut
            .first()?
            .plaquettes()
            .into_iter()
            .min_by_key(|side| side.half_spacings())?;
        let (cells, index) = (Vec::new(), PlaquetteMap::default());
        let mut tracker = Tracker {
            notch,
            wake: (spur(setting) * BONDS_A_SPACING) as u32,
            cells,
            index,
            foremost: BinaryHeap::new(),
            departed: None,
        };
        tracker.cell(mouth);
        tracker.reach(MOUTH, 0);
        for bond in cut {
            tracker.open(bond, 0);
        }
        Some(tracker)
    }

    /// Takes the events between two probes: what breaks first, then what closes, from the tip backwards, so that a crack
    /// that zips up is told from faces that touch. A bond that closes more than a spur behind the tip is a contact of the
    /// crack faces: the crack does not end there.
    pub fn follow(&mut self, events: &[BondEvent]) {
        let (breaking, mut closing): (Vec<_>, Vec<_>) = events.iter().partition(|event| event.broken);
        breaking.into_iter().for_each(|event| self.apply(event));
        closing.sort_by_key(|event| Reverse(self.depth(event)));
        for event in closing {
            if self
                .depth(event)
                .is_none_or(|depth| depth + self.wake >= self.tip_depth())
            {
                self.apply(event);
            }
        }
    }

    /// Bonds beyond the notch that a crack has parted, also where its faces touch, and the probes at which they broke,
    /// ascending (column, row, direction).
    pub fn parted(&self) -> Vec<BondEvent> {
        let bonds = |cell: &Cell| {
            let Cell { place, opened, .. } = *cell;
            let sides = (0..3u8).zip(opened).filter(|side| side.1 != INTACT);
            sides.map(move |(direction, probe)| (place.across(direction).0, probe))
        };
        let upright = self.cells.iter().filter(|cell| cell.place.upright);
        let beyond = upright.flat_map(bonds).filter(|&(bond, _)| !self.notch.is_cut(bond));
        let event = |(bond, probe): (Bond, u32)| BondEvent {
            probe,
            column: bond.column,
            row: bond.row,
            direction: bond.direction,
            broken: true,
        };
        let mut parted: Vec<BondEvent> = beyond.map(event).collect();
        parted.sort_unstable_by_key(|event| (event.column, event.row, event.direction));
        parted
    }

    /// Takes a bond that broke or closed. The notch itself never closes.
    pub fn apply(&mut self, event: &BondEvent) {
        let bond = Bond::of(event);
        if event.broken {
            self.open(bond, event.probe);
        } else if !self.notch.is_cut(bond) {
            self.close(bond);
        }
    }

    /// The foremost tip.
    pub fn tip(&self) -> Tip {
        let points: Vec<[f64; 2]> = self.main_path().iter().map(|bond| self.notch.place(*bond)).collect();
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

    /// Middle of the bond of an event, nm from the left edge and from the crack plane.
    pub fn place(&self, event: &BondEvent) -> [f64; 2] {
        self.notch.place(Bond::of(event))
    }

    /// Whether the bond of an event was severed before anything broke.
    pub fn is_cut(&self, event: &BondEvent) -> bool {
        self.notch.is_cut(Bond::of(event))
    }

    /// Broken bonds from the mouth to this one; `None` where it is no part of the crack.
    pub fn depth(&self, event: &BondEvent) -> Option<u32> {
        let sides = Bond::of(event)
            .plaquettes()
            .into_iter()
            .filter_map(|side| self.index.get(&side));
        sides
            .map(|&side| self.cells[side].distance)
            .min()
            .filter(|&depth| depth != UNREACHED)
    }

    /// How many bonds were broken from the mouth to the foremost tip.
    pub fn tip_depth(&self) -> u32 {
        self.cells[self.foremost_cell()].distance
    }

    /// The bonds broken from the mouth to the foremost tip.
    fn main_path(&self) -> Vec<Bond> {
        let mut bonds = Vec::new();
        let mut here = self.foremost_cell();
        while let Some((bond, nearer)) = self.step_back(here) {
            bonds.push(bond);
            here = nearer;
        }
        bonds.reverse();
        bonds
    }

    /// One step towards the mouth. Of equally short ways the one nearest to the crack plane is taken, so that the
    /// path depends on what is broken and not on the order in which it broke.
    fn step_back(&self, from: usize) -> Option<(Bond, usize)> {
        let cell = &self.cells[from];
        let nearer = |beyond: usize| self.cells[beyond].distance.checked_add(1) == Some(cell.distance);
        let rank = |beyond: usize| {
            let place = self.cells[beyond].place;
            ((place.row - self.notch.row).abs(), place)
        };
        let sides = self.sides(from).filter(|&(_, beyond)| nearer(beyond));
        let (direction, beyond) = sides.min_by_key(|&(_, beyond)| rank(beyond))?;
        Some((cell.place.across(direction).0, beyond))
    }

    fn foremost_cell(&self) -> usize {
        self.foremost.peek().map_or(MOUTH, |top| top.3)
    }

    /// The open sides of a cell: direction and the cell beyond.
    fn sides(&self, of: usize) -> impl Iterator<Item = (u8, usize)> + use<> {
        let Cell { opened, beyond, .. } = self.cells[of];
        (0..3u8)
            .zip(opened)
            .zip(beyond)
            .filter(|((_, opened), _)| *opened != INTACT)
            .map(|((side, _), beyond)| (side, beyond))
    }

    /// The probe at which a bond broke; `INTACT` where it did not.
    fn opened(&self, bond: Bond) -> u32 {
        let cell = self.index.get(&bond.plaquettes()[0]);
        cell.map_or(INTACT, |&cell| self.cells[cell].opened[usize::from(bond.direction)])
    }

    fn cell(&mut self, place: Plaquette) -> usize {
        let cells = &mut self.cells;
        *self.index.entry(place).or_insert_with(|| {
            cells.push(Cell {
                place,
                distance: UNREACHED,
                opened: [INTACT; 3],
                beyond: [MOUTH; 3],
            });
            cells.len() - 1
        })
    }
}
