//! The beginning and the end of the forces on a group: what is inside its triangles, and what becomes of the sums.

use pulp::{Scalar, Simd};

use super::sums::Sum;
use crate::forces::affine::Affine;
use crate::forces::bulk::{self, BulkSum};
use crate::forces::maps::MapLanes;
use crate::forces::measure::PARTS;
use crate::lanes::{Lanes, MOST, Mask, prefetch};
use crate::mesh::groups::Group;
use crate::potential::{CutPotential, PairShape};
use crate::state::Strip;

impl<S: PairShape, const MEASURED: bool> Sum<'_, S, MEASURED> {
    /// Sets the forces of a group to those of the bonds inside its triangles.
    #[inline(always)]
    pub(super) fn begin_group<L: Simd>(&mut self, simd: L, law: &CutPotential<S>, group: usize) {
        let place = self.tile.place(group);
        let group = &self.tile.groups[group];
        for from in group.elements.clone().step_by(Lanes::<L>::COUNT) {
            self.set_inside(simd, law, group, place, from);
        }
    }

    /// Gives out the forces on a group, or moves those of its triangles on at once whose forces are certain.
    pub(super) fn end_group(&mut self, number: usize) {
        let tile = self.tile;
        let group = &tile.groups[number];
        let place = tile.place(number);
        let gathered = self
            .gathered
            .each_ref()
            .map(|plane| &plane[place..place + group.nodes().len()]);
        let first = 3 * tile.triangles.start;
        let nodes = group.nodes().start - first..group.nodes().end - first;
        let mut forces = self.output.force.each_mut().map(|plane| &mut plane[nodes.clone()]);
        let number = tile.first_group + number;
        let Some(ahead) = &mut self.ahead else {
            return forces
                .iter_mut()
                .zip(gathered)
                .for_each(|(plane, force)| plane.copy_from_slice(force));
        };
        if ahead.looked_at[number] {
            forces
                .iter_mut()
                .zip(gathered)
                .for_each(|(plane, force)| plane.copy_from_slice(force));
        }
        let elements = &group.elements;
        let mut irregular: Vec<usize> = self.irregular.iter().map(|&triangle| triangle as usize).collect();
        irregular.retain(|triangle| elements.contains(triangle));
        irregular.sort_unstable();
        let after = ahead.certain.partition_point(|range| range.end <= elements.start);
        let certain = ahead.certain[after..]
            .iter()
            .take_while(|range| range.start < elements.end);
        let mut from = elements.start;
        let mut give = |triangle: usize| {
            for corner in 0..3 {
                let node = group.node(triangle, corner) - group.nodes().start;
                (0..2).for_each(|axis| forces[axis][node] = gathered[axis][node]);
            }
        };
        for certain in certain {
            let [start, end] = [certain.start.max(elements.start), certain.end.min(elements.end)];
            (from..start).for_each(&mut give);
            from = start;
            let gaps = irregular
                .iter()
                .copied()
                .filter(|triangle| (start..end).contains(triangle));
            for gap in gaps.chain([end]) {
                if from < gap {
                    let [velocity, next] = [&mut ahead.velocity, &mut ahead.next]
                        .map(|planes| planes.each_mut().map(|plane| &mut plane[nodes.clone()]));
                    let strip = Strip::of(number, group, &(from..gap), gathered, velocity, next);
                    (ahead.advance)(strip, self.field.position);
                }
                if gap < end && from <= gap {
                    give(gap);
                }
                from = from.max(gap + 1).min(end);
            }
        }
        (from..elements.end).for_each(give);
    }

    /// Sets the forces of some triangles of a group, from one on, to those of the bonds inside them.
    #[inline(always)]
    fn set_inside<L: Simd>(&mut self, simd: L, law: &CutPotential<S>, group: &Group, place: usize, from: usize) {
        let count = Lanes::<L>::COUNT.min(group.elements.end - from);
        let nodes = [group.node(from, 0), group.node(from, 1), group.node(from, 2)];
        let mut corners = [[Lanes::all(simd, 0.0); 2]; 3];
        for corner in 0..3 {
            for axis in 0..2 {
                corners[corner][axis] = Lanes::load_some(simd, &self.field.position[axis], nodes[corner], count);
            }
        }
        for node in nodes {
            for plane in self.field.position {
                // Those of the next row.
                prefetch(plane, node + 6 * group.len());
            }
        }
        let map = MapLanes::between(corners, group.size);
        let listed = self.field.bulk.listed(group.size);
        let mut bulk = bulk::sum::<S, L, MEASURED>(simd, law, group.size, &map, listed);
        let regular = self.field.limit.regular_inside(&map);
        if count < Lanes::<L>::COUNT || !regular.is_some_and(Mask::every) {
            let regular = regular.map_or([false; MOST], Mask::answers);
            let irregular = (0..count).filter(|&lane| !regular[lane]);
            self.irregular.extend(irregular.map(|lane| (from + lane) as u32));
            self.replace_irregular(simd, &mut bulk, regular, from, count);
        }
        for (corner, node) in nodes.into_iter().enumerate() {
            for axis in 0..2 {
                let place = place + node - group.nodes().start;
                bulk.nodal[2 * corner + axis].store(&mut self.gathered[axis], place, count);
            }
        }
        if MEASURED {
            let place = from - self.tile.triangles.start;
            for (plane, bulk) in self.output.held.iter_mut().zip(bulk.held) {
                bulk.store(plane, place, count);
            }
        }
    }

    /// Computes triangles that are strongly deformed one by one, with all the lattice vectors they need.
    #[cold]
    fn replace_irregular<L: Simd>(
        &self,
        simd: L,
        bulk: &mut BulkSum<L>,
        regular: [bool; MOST],
        from: usize,
        count: usize,
    ) {
        let field = self.field;
        let mut nodal = bulk.nodal.map(Lanes::numbers);
        let mut held = bulk.held.map(Lanes::numbers);
        for triangle in (from..from + count).filter(|triangle| !regular[triangle - from]) {
            let lane = triangle - from;
            let size = field.mesh.elements[triangle].size;
            let affine = Affine::of_triangle(field.mesh, triangle, field.position);
            let bonds = field
                .bulk
                .within(size, &affine, field.limit.spacing, field.limit.cutoff);
            let corners = field.mesh.corners_of(triangle);
            let corner = |node: usize| [0, 1].map(|axis: usize| Lanes::all(Scalar, field.position[axis][node]));
            let map = MapLanes::between(corners.map(corner), size);
            let alone = bulk::sum::<S, Scalar, MEASURED>(Scalar, &field.law, size, &map, bonds);
            (0..6).for_each(|component| nodal[component][lane] = alone.nodal[component].numbers()[0]);
            (0..PARTS).for_each(|part| held[part][lane] = alone.held[part].numbers()[0]);
        }
        *bulk = BulkSum {
            nodal: nodal.map(|numbers| Lanes::load(simd, &numbers, 0)),
            held: held.map(|numbers| Lanes::load(simd, &numbers, 0)),
        };
    }
}
