//! Atoms that move on with their forces: those with partners as in the lattice.

use std::ops::Range;

use pulp::Simd;

use crate::forces::Planes;
use crate::forces::measure::in_parts;
use crate::forces::vector::Vector;
use crate::lanes::Lanes;
use crate::state::Leap;

/// How free atoms move.
#[derive(Clone, Copy, Debug)]
pub struct AtomMotion {
    pub leap: Leap,
    /// What a force is multiplied by to give the acceleration.
    pub mobility: f64,
}

/// Where atoms come from and where they come to be, planes of all nodes.
pub struct AtomsAhead<'a> {
    pub before: &'a Planes,
    pub velocity: &'a mut Planes,
    pub next: &'a mut Planes,
    pub motion: AtomMotion,
    /// Nodes of atoms that are to stay, ascending.
    pub looked_at: &'a [Range<usize>],
}

/// The same for the atoms of one parallel task.
pub struct Task<'a> {
    before: [&'a [f64]; 2],
    velocity: [&'a mut [f64]; 2],
    next: [&'a mut [f64]; 2],
    motion: AtomMotion,
}

impl<'a> AtomsAhead<'a> {
    /// What each task of so many of these sites has, which are atoms with these nodes; none of one with atoms that are to stay.
    pub fn tasks(self, sites: Range<usize>, nodes: Range<usize>, length: usize) -> Vec<Option<Task<'a>>> {
        let Self {
            before,
            velocity,
            next,
            motion,
            looked_at,
        } = self;
        let tasks = sites.len().div_ceil(length);
        let parts = |planes: &'a mut Planes| {
            let planes = planes.each_mut().map(|plane| &mut plane[nodes.clone()]);
            in_parts(planes, length, tasks)
        };
        let moving = parts(velocity).zip(parts(next)).enumerate();
        moving
            .map(|(task, (velocity, next))| {
                let from = nodes.start + task * length;
                let part = from..from + next[0].len();
                let stays = looked_at
                    .iter()
                    .any(|atoms| atoms.start < part.end && part.start < atoms.end);
                (!stays).then(|| Task {
                    before: before.each_ref().map(|plane| &plane[part.clone()]),
                    velocity,
                    next,
                    motion,
                })
            })
            .collect()
    }
}

impl Task<'_> {
    /// Moves so many atoms from a place of the task on.
    #[inline(always)]
    pub fn advance<L: Simd>(&mut self, simd: L, place: usize, count: usize, force: Vector<L>, position: Vector<L>) {
        let AtomMotion { leap, mobility } = self.motion;
        let mobility = Lanes::all(simd, mobility);
        let [before_x, before_y] = self.before;
        let [velocity_x, velocity_y] = &mut self.velocity;
        let [next_x, next_y] = &mut self.next;
        let before = Lanes::load_some(simd, before_x, place, count);
        let velocity = leap.velocities(force.x, mobility, before);
        velocity.store(velocity_x, place, count);
        leap.positions(position.x, velocity).store(next_x, place, count);
        let before = Lanes::load_some(simd, before_y, place, count);
        let velocity = leap.velocities(force.y, mobility, before);
        velocity.store(velocity_y, place, count);
        leap.positions(position.y, velocity).store(next_y, place, count);
    }
}
