//! How numbers of nodes and elements get from the rank that computes them to others.

use super::{Domain, Halo, Of};
use crate::mesh::grouped::Grouped;

impl Domain {
    /// Brings some numbers of each node or element to the first rank, from the rank that computes it; the others get none. All
    /// ranks must call this together.
    pub fn gather<const N: usize>(&self, of: Of, row: impl Fn(usize) -> [f64; N]) -> Vec<[f64; N]> {
        let starts = match of {
            Of::Nodes => &self.nodes,
            Of::Elements => &self.grouped,
        };
        let first_atom = starts[self.count()];
        let count = first_atom + self.atoms[self.count()];
        if self.ranks.count() == 1 {
            let mut rows = Vec::with_capacity(count);
            rows.extend((0..count).map(row));
            return rows;
        }
        let mut all = match self.ranks.is_first() {
            true => vec![[0.0; N]; count],
            false => Vec::new(),
        };
        let (of_groups, of_atoms) = all.split_at_mut(if self.ranks.is_first() { first_atom } else { 0 });
        for (all, starts, first) in [(of_groups, starts, 0), (of_atoms, &self.atoms, first_atom)] {
            let mine = first + starts[self.rank]..first + starts[self.rank + 1];
            let mine: Vec<[f64; N]> = mine.map(&row).collect();
            let starts: Vec<usize> = starts.iter().map(|start| N * start).collect();
            self.ranks.gather(mine.as_flattened(), all.as_flattened_mut(), &starts);
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
