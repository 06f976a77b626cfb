//! The forces on the triangles of a tile, several triangles or interfaces side by side.

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::{Run, Tile};
use crate::forces::Planes;
use crate::forces::affine::Affine;
use crate::forces::bulk::{self, BulkBonds, BulkSum};
use crate::forces::interface::{self, IntactLimit, State, StringSum};
use crate::forces::maps::Maps;
use crate::forces::measure::PARTS;
use crate::forces::summation::{NodeShare, SampledStrings};
use crate::lanes::{Lanes, MOST, Mask};
use crate::mesh::Mesh;
use crate::potential::{CutPotential, PairShape};

/// What the sums are taken over.
pub struct Field<'a, S> {
    pub arch: Arch,
    pub law: CutPotential<S>,
    pub limit: &'a IntactLimit,
    pub mesh: &'a Mesh,
    pub strings: &'a SampledStrings,
    pub bulk: &'a BulkBonds,
    pub states: &'a [State],
    pub maps: &'a Maps,
    pub position: &'a Planes,
}

/// Where the sums of a tile go, an entry a node or a triangle.
pub struct Output<'a> {
    pub force: [&'a mut [f64]; 2],
    /// Empty where nothing is measured.
    pub held: [&'a mut [f64]; PARTS],
}

/// The memory that the sums of a tile need.
#[derive(Default)]
pub struct Scratch {
    /// Forces of strings on each of the three nodes, x and y, a plane of the tile's triangles each with
    /// room for lanes beyond the last.
    planes: [[Vec<f64>; 2]; 3],
    /// What the triangles' halves of the strings hold, likewise.
    held: [Vec<f64>; PARTS],
    /// Sums of the strings of some interfaces: forces x and y and their moments; and what these strings hold.
    sums: Vec<[[f64; MOST]; 4]>,
    across: [[f64; MOST]; PARTS],
    /// Triangles of the tile with irregular bonds inside or across an interface that is not open.
    irregular: Vec<u32>,
}

/// Forces on the nodes of a tile, and what its triangles hold if that is to be `MEASURED`; returns its triangles whose
/// interfaces may loosen or open.
pub fn sum<S: PairShape, const MEASURED: bool>(
    field: &Field<S>,
    tile: &Tile,
    scratch: &mut Scratch,
    output: Output,
) -> Vec<u32> {
    let held = scratch.held.iter_mut().filter(|_| MEASURED);
    for plane in scratch.planes.as_flattened_mut().iter_mut().chain(held) {
        plane.clear();
        plane.resize(tile.triangles.len() + MOST, 0.0);
    }
    field.arch.dispatch(Sum::<S, MEASURED> {
        law: field.law,
        field,
        tile,
        scratch,
        output,
    });
    std::mem::take(&mut scratch.irregular)
}

struct Sum<'a, S, const MEASURED: bool> {
    /// A copy that no other reference keeps from staying in registers.
    law: CutPotential<S>,
    field: &'a Field<'a, S>,
    tile: &'a Tile,
    scratch: &'a mut Scratch,
    output: Output<'a>,
}

impl<S: PairShape, const MEASURED: bool> WithSimd for Sum<'_, S, MEASURED> {
    type Output = ();

    #[inline(always)]
    fn with_simd<L: Simd>(mut self, simd: L) {
        let lanes = Lanes::<L>::COUNT;
        for run in &self.tile.runs {
            let count = run.count as usize;
            for at in (0..count).step_by(lanes) {
                self.add_strings(simd, run, at, lanes.min(count - at));
            }
        }
        for (size, part) in &self.tile.sizes {
            for from in part.clone().step_by(lanes) {
                self.add_bulk(simd, *size, from, lanes.min(part.end - from));
            }
        }
    }
}

impl<S: PairShape, const MEASURED: bool> Sum<'_, S, MEASURED> {
    /// Adds the forces of so many interfaces of a run from one on.
    #[inline(always)]
    fn add_strings<L: Simd>(&mut self, simd: L, run: &Run, at: usize, count: usize) {
        let field = self.field;
        let [number, first, second] = [run.number, run.first, run.second].map(|start| start as usize + at);
        let maps = [field.maps.lanes(simd, first), field.maps.lanes(simd, second)];
        let kind = field.strings.of(run.kind);
        let Scratch { sums, across, .. } = &mut *self.scratch;
        sums.resize(kind.strings.len(), [[0.0; MOST]; 4]);
        let store = |string: usize, sum: &StringSum<L, MEASURED>| {
            let parts = sum.force.into_iter().chain(sum.moment);
            (sums[string].iter_mut().zip(parts)).for_each(|(into, part)| part.store(into, 0, Lanes::<L>::COUNT));
        };
        let (regular, held) = interface::sum_strings(simd, &self.law, field.limit, &maps, &kind.strings, store);
        if MEASURED {
            (across.iter_mut().zip(held)).for_each(|(into, part)| part.store(into, 0, Lanes::<L>::COUNT));
        }
        let states = &field.states[number..number + count];
        let mut any_open = false;
        for &state in states {
            any_open |= state == State::Open;
        }
        if any_open || count < Lanes::<L>::COUNT || !regular.every() {
            self.note_irregular(run, number, [first, second], states, regular.answers());
        }
        // Where a triangle is the second of one interface and the first of another, the former has the lower number.
        for (side, triangle) in [(1, second), (0, first)] {
            if run.owned[side] {
                let place = triangle - self.tile.triangles.start;
                for share in &kind.shares[side] {
                    self.add_share(simd, share, place);
                }
                if MEASURED {
                    self.add_half(simd, place);
                }
            }
        }
    }

    /// Notes triangles with irregular interfaces, and takes off the forces of those that are open, unless their strings are
    /// kept, and of lanes too many. `number` is that of the first interface.
    #[cold]
    fn note_irregular(
        &mut self,
        run: &Run,
        number: usize,
        triangles: [usize; 2],
        states: &[State],
        regular: [bool; MOST],
    ) {
        for lane in 0..MOST {
            let state = states.get(lane);
            if state == Some(&State::Open) && self.field.strings.are_kept(number + lane) {
                continue;
            }
            if state.is_none_or(|&state| state == State::Open) {
                let Scratch { sums, across, .. } = &mut *self.scratch;
                let parts = sums.as_flattened_mut().iter_mut().chain(across);
                parts.for_each(|part| part[lane] = 0.0);
            } else if !regular[lane] {
                let both = triangles.into_iter().zip(run.owned);
                let own = both
                    .filter(|&(_, owned)| owned)
                    .map(|(triangle, _)| (triangle + lane) as u32);
                self.scratch.irregular.extend(own);
            }
        }
    }

    /// Adds to the triangles from a place of the tile on what one of their nodes gets of the strings.
    #[inline(always)]
    fn add_share<L: Simd>(&mut self, simd: L, share: &NodeShare, place: usize) {
        let [x, y] = &mut self.scratch.planes[share.node];
        let [mut force_x, mut force_y] = [&*x, &*y].map(|plane| Lanes::load(simd, plane, place));
        for (&[sum, moment], parts) in share.of_string.iter().zip(&self.scratch.sums) {
            let part = |k: usize| Lanes::load(simd, &parts[k], 0);
            force_x = part(2).times_add(moment, part(0).times_add(sum, force_x));
            force_y = part(3).times_add(moment, part(1).times_add(sum, force_y));
        }
        force_x.store(x, place, Lanes::<L>::COUNT);
        force_y.store(y, place, Lanes::<L>::COUNT);
    }

    /// Adds to the triangles from a place of the tile on their half of what the strings hold.
    #[inline(always)]
    fn add_half<L: Simd>(&mut self, simd: L, place: usize) {
        let Scratch { held, across, .. } = &mut *self.scratch;
        for (plane, across) in held.iter_mut().zip(across) {
            let half = Lanes::load(simd, across, 0).times_add(0.5, Lanes::load(simd, plane, place));
            half.store(plane, place, Lanes::<L>::COUNT);
        }
    }

    /// Adds the forces of bonds inside so many triangles of one size to those of their strings and stores the sums.
    #[inline(always)]
    fn add_bulk<L: Simd>(&mut self, simd: L, size: i32, from: usize, count: usize) {
        let map = self.field.maps.lanes(simd, from);
        let listed = self.field.bulk.listed(size);
        let mut bulk = bulk::sum::<S, L, MEASURED>(simd, &self.law, size, &map, listed);
        let regular = self.field.limit.regular_inside(&map);
        if !regular.is_some_and(Mask::every) {
            let regular = regular.map_or([false; MOST], Mask::answers);
            let irregular = (0..count).filter(|&lane| !regular[lane]);
            self.scratch
                .irregular
                .extend(irregular.map(|lane| (from + lane) as u32));
            self.replace_irregular(simd, &mut bulk, regular, size, from, count);
        }
        let place = from - self.tile.triangles.start;
        let mut nodal = [[0.0; MOST]; 6];
        for ((plane, bulk), nodal) in self
            .scratch
            .planes
            .as_flattened()
            .iter()
            .zip(bulk.nodal)
            .zip(&mut nodal)
        {
            (Lanes::load(simd, plane, place) + bulk).store(nodal, 0, Lanes::<L>::COUNT);
        }
        let nodes = 3 * place..3 * (place + count);
        let [x, y] = self.output.force.each_mut().map(|plane| &mut plane[nodes.clone()]);
        for lane in 0..count {
            for node in 0..3 {
                x[3 * lane + node] = nodal[2 * node][lane];
                y[3 * lane + node] = nodal[2 * node + 1][lane];
            }
        }
        if MEASURED {
            let planes = self.scratch.held.iter().zip(&mut self.output.held);
            for ((strings, plane), bulk) in planes.zip(bulk.held) {
                (Lanes::load(simd, strings, place) + bulk).store(plane, place, count);
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
        size: i32,
        from: usize,
        count: usize,
    ) {
        let field = self.field;
        let mut nodal = bulk.nodal.map(Lanes::numbers);
        let mut held = bulk.held.map(Lanes::numbers);
        for lane in (0..count).filter(|&lane| !regular[lane]) {
            let affine = Affine::of_triangle(size, field.mesh.first_node(from + lane), field.position);
            let bonds = field
                .bulk
                .within(size, &affine, field.limit.spacing, field.limit.cutoff);
            let map = field.maps.lanes(Scalar, from + lane);
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
