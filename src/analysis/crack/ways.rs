//! The shortest ways from the mouth through the broken bonds, mended as bonds break and close.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, VecDeque};

use super::plaquette::Bond;
use super::{INTACT, MOUTH, Tracker, UNREACHED};

impl Tracker {
    pub(super) fn reach(&mut self, at: usize, distance: u32) {
        let cell = &mut self.cells[at];
        let is_new = cell.distance == UNREACHED;
        cell.distance = distance;
        if is_new {
            let off = (cell.place.row - self.notch.row).abs();
            self.foremost
                .push((cell.place.half_spacings(), Reverse(off), cell.place, at));
            self.note_height(at);
        }
    }

    pub(super) fn open(&mut self, bond: Bond, probe: u32) {
        let sides = bond.plaquettes().map(|side| self.cell(side));
        let direction = usize::from(bond.direction);
        for (side, beyond) in [(sides[0], sides[1]), (sides[1], sides[0])] {
            let cell = &mut self.cells[side];
            cell.opened[direction] = cell.opened[direction].min(probe);
            cell.beyond[direction] = beyond;
        }
        // A shorter way spreads from the side that is nearer to the mouth.
        let mut queue = VecDeque::from(sides);
        while let Some(here) = queue.pop_front() {
            let Some(onward) = self.cells[here].distance.checked_add(1) else {
                continue;
            };
            for (_, beyond) in self.sides(here) {
                if onward < self.cells[beyond].distance {
                    self.reach(beyond, onward);
                    queue.push_back(beyond);
                }
            }
        }
    }

    pub(super) fn close(&mut self, bond: Bond) {
        let sides = bond.plaquettes().map(|side| self.cell(side));
        for side in sides {
            self.cells[side].opened[usize::from(bond.direction)] = INTACT;
        }
        let orphans = self.orphans(sides);
        self.adopt(orphans);
        while self
            .foremost
            .peek()
            .is_some_and(|top| self.cells[top.3].distance == UNREACHED)
        {
            self.foremost.pop();
        }
    }

    /// Takes back the distances that rested on a way now closed, level by level.
    fn orphans(&mut self, suspects: [usize; 2]) -> Vec<usize> {
        let mut orphans = Vec::new();
        let mut queue = VecDeque::from(suspects);
        while let Some(here) = queue.pop_front() {
            let distance = self.cells[here].distance;
            if distance == UNREACHED || here == MOUTH || self.step_back(here).is_some() {
                continue;
            }
            let rested = self
                .sides(here)
                .filter(|&(_, beyond)| self.cells[beyond].distance == distance + 1);
            queue.extend(rested.map(|(_, beyond)| beyond));
            self.cells[here].distance = UNREACHED;
            orphans.push(here);
        }
        orphans
    }

    /// Reaches the orphans again by the ways that are left, nearest first.
    fn adopt(&mut self, orphans: Vec<usize>) {
        let mut heap: BinaryHeap<Reverse<(u32, usize)>> = BinaryHeap::new();
        for orphan in orphans {
            let nearest = self.sides(orphan).map(|(_, beyond)| self.cells[beyond].distance).min();
            if let Some(distance) = nearest.and_then(|nearest| nearest.checked_add(1)) {
                heap.push(Reverse((distance, orphan)));
            }
        }
        while let Some(Reverse((distance, here))) = heap.pop() {
            if distance >= self.cells[here].distance {
                continue;
            }
            self.reach(here, distance);
            heap.extend(self.sides(here).map(|(_, beyond)| Reverse((distance + 1, beyond))));
        }
    }
}
