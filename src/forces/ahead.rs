//! Nodes that move into the next moment with their forces, while both are in the cache.

use std::ops::Range;

use super::contact::{self, AtomMotion};
use super::tile::{Advance, Tile};
use super::{ForceError, Forces, Measure, Planes, include};

/// How nodes move on once their forces are certain.
pub struct Motion<'a> {
    /// How fast all nodes were, nm/ps: kept, since what has moved may have to move again.
    pub before: &'a Planes,
    /// How fast they come to be.
    pub velocity: &'a mut Planes,
    /// Where they come to be, nm.
    pub next: &'a mut Planes,
    /// Moves triangles.
    pub advance: &'a Advance<'a>,
    pub atoms: AtomMotion,
}

/// What has not moved on with its forces.
pub struct Left {
    /// Ascending.
    pub triangles: Vec<u32>,
    /// Nodes of atoms.
    pub atoms: Vec<Range<usize>>,
}

impl Motion<'_> {
    /// What moves atoms, of which those that are looked at are left.
    pub fn of_atoms<'a>(&'a mut self, looked_at: &'a [Range<usize>]) -> contact::AtomsAhead<'a> {
        contact::AtomsAhead {
            before: self.before,
            velocity: self.velocity,
            next: self.next,
            motion: self.atoms,
            looked_at,
        }
    }
}

impl Forces {
    /// Forces on nodes of this rank, eV/nm, as [`Self::compute`] gives them; moves nodes into the next moment as soon as their
    /// forces are certain, with the positions still in the cache. Returns what it leaves, and the planes. Forces on what is
    /// left are known, and on what is [looked at](Self::look_at); those on the rest are not kept.
    pub fn compute_and_move<'a>(
        &mut self,
        position: &mut Planes,
        force: &mut Planes,
        mut motion: Motion<'a>,
    ) -> Result<(Left, Motion<'a>), ForceError> {
        self.tell_certain();
        let touched = self.sum::<false>(position, force, &mut Measure::default(), Some(&mut motion))?;
        let mut triangles = Vec::new();
        include(&mut triangles, touched);
        include(&mut triangles, self.uncertain.clone());
        let atoms = std::mem::take(&mut self.left_atoms);
        Ok((Left { triangles, atoms }, motion))
    }

    /// Finds which triangles of this rank nothing but their strings and their inside can pull at, as long as no interface of
    /// theirs is found irregular.
    fn tell_certain(&mut self) {
        if self.certain_is_current {
            return;
        }
        let watched = self.watched.iter();
        let of_watched = watched.flat_map(|&number| self.interfaces.pairs[number as usize].both());
        let mut uncertain = contact::searched(&self.interfaces, &self.loosened);
        include(&mut uncertain, of_watched.collect());
        let mine = self.domain.grouped();
        uncertain.retain(|&triangle| mine.contains(&(triangle as usize)));
        let ranges = |tile: &Tile| {
            let inside = uncertain.iter().map(|&triangle| triangle as usize);
            let inside = inside.filter(|triangle| tile.triangles.contains(triangle));
            let mut from = tile.triangles.start;
            let ends = inside.chain([tile.triangles.end]);
            let ranges = ends.map(|end| std::mem::replace(&mut from, end + 1)..end);
            ranges.filter(|range| !range.is_empty()).collect()
        };
        self.certain = self.tiles.iter().map(ranges).collect();
        self.uncertain = uncertain;
        self.certain_is_current = true;
    }
}
