//! How numbers of nodes and elements get from the rank that computes them to others.

use std::ops::Range;

use super::{Domain, Halo, Of};
use crate::mesh::grouped::Grouped;

/// Rows that are on their way to the first rank at once.
const BLOCK: usize = 1 << 18;

impl Domain {
    /// Brings some numbers of each node or element to the first rank, from the rank that computes it: in blocks, which it is given
    /// one after the other, each with the number of its first row. All ranks must call this together.
    pub fn gather_in_blocks<const N: usize>(
        &self,
        of: Of,
        row: impl Fn(usize) -> [f64; N],
        mut give: impl FnMut(usize, &[[f64; N]]),
    ) {
        let count = self.count_of(of);
        for from in (0..count).step_by(BLOCK) {
            let rows = self.gather_range(of, from..count.min(from + BLOCK), &row);
            if self.ranks.is_first() {
                give(from, &rows);
            }
        }
    }

    /// How many nodes or elements there are.
    fn count_of(&self, of: Of) -> usize {
        self.starts_of(of)[self.count()] + self.atoms[self.count()]
    }

    /// Where the nodes or elements in groups of each rank start.
    fn starts_of(&self, of: Of) -> &[usize] {
        match of {
            Of::Nodes => &self.nodes,
            Of::Elements => &self.grouped,
        }
    }

    fn gather_range<const N: usize>(
        &self,
        of: Of,
        range: Range<usize>,
        row: &impl Fn(usize) -> [f64; N],
    ) -> Vec<[f64; N]> {
        if self.ranks.count() == 1 {
            return range.map(row).collect();
        }
        let starts = self.starts_of(of);
        let first_atom = starts[self.count()];
        let mut all = match self.ranks.is_first() {
            true => vec![[0.0; N]; range.len()],
            false => Vec::new(),
        };
        for (starts, first) in [(starts, 0), (&self.atoms[..], first_atom)] {
            let within = |start: &usize| (first + start).clamp(range.start, range.end) - range.start;
            let starts: Vec<usize> = starts.iter().map(within).collect();
            let [from, to] = [starts[0], starts[self.count()]];
            if from == to {
                continue;
            }
            let mine = range.start + starts[self.rank]..range.start + starts[self.rank + 1];
            let mine: Vec<[f64; N]> = mine.map(row).collect();
            let starts: Vec<usize> = starts.iter().map(|start| N * (start - from)).collect();
            let part = all.get_mut(from..to).unwrap_or_default();
            self.ranks.gather(mine.as_flattened(), part.as_flattened_mut(), &starts);
        }
        all
    }

    /// Brings the numbers of all atoms to the first rank.
    pub fn gather_atoms(&self, plane: &mut [f64]) {
        if self.ranks.count() == 1 {
            return;
        }
        let plane = &mut plane[self.grouped_nodes()..];
        let mine = plane[self.atoms()].to_vec();
        self.ranks.gather(&mine, plane, &self.atoms);
    }

    /// Brings the numbers of all nodes to all ranks, each from the rank that computes it.
    pub fn share_nodes(&self, plane: &mut [f64]) {
        let (of_groups, of_atoms) = plane.split_at_mut(self.grouped_nodes());
        self.ranks.share(of_groups, &self.nodes);
        self.ranks.share(of_atoms, &self.atoms);
    }

    /// The same of the atoms alone.
    pub fn share_atoms(&self, plane: &mut [f64]) {
        self.ranks.share(&mut plane[self.grouped_nodes()..], &self.atoms);
    }

    /// Brings the numbers of all elements in groups to all ranks.
    pub fn share_grouped(&self, plane: &mut [f64]) {
        self.ranks.share(plane, &self.grouped);
    }

    /// Brings the numbers of all elements to all ranks.
    pub fn share_elements(&self, plane: &mut [f64]) {
        let (of_groups, of_atoms) = plane.split_at_mut(self.grouped_count());
        self.ranks.share(of_groups, &self.grouped);
        self.ranks.share(of_atoms, &self.atoms);
    }

    /// Brings numbers of the nodes that have come to be this rank's, where the specimen was cut otherwise before. All ranks must
    /// call this together.
    pub fn take_over_from<const N: usize>(&self, before: &Self, mesh: &impl Grouped, planes: [&mut [f64]; N]) {
        let new = self
            .elements()
            .into_iter()
            .flatten()
            .filter(|&element| !before.is_mine(element));
        let new: Vec<u32> = new.map(|element| element as u32).collect();
        Halo::ask(before, mesh, &new).bring(before, Of::Nodes, planes);
    }
}
