//! The forces on the triangles of a tile, several triangles or interfaces side by side.

use pulp::{Arch, Scalar, Simd, WithSimd};

use super::{Run, Tile};
use crate::forces::Planes;
use crate::forces::affine::Affine;
use crate::forces::bulk::{self, BulkBonds, BulkSum};
use crate::forces::interface::{IntactLimit, State};
use crate::forces::maps::MapLanes;
use crate::forces::measure::PARTS;
use crate::forces::strings::{self, Ends, NodalForces};
use crate::forces::summation::SampledStrings;
use crate::forces::vector::Vector;
use crate::lanes::{Lanes, MOST, Mask};
use crate::mesh::Mesh;
use crate::mesh::groups::Group;
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
    pub position: &'a Planes,
}

/// Where the sums of a tile go, an entry a node or a triangle.
pub struct Output<'a> {
    pub force: [&'a mut [f64]; 2],
    /// Empty where nothing is measured.
    pub held: [&'a mut [f64]; PARTS],
}

/// Forces on the nodes of a tile, and what its triangles hold if that is to be `MEASURED`; returns its triangles with
/// irregular bonds, inside or across an interface that is not open: their interfaces may loosen or open.
pub fn sum<S: PairShape, const MEASURED: bool>(field: &Field<S>, tile: &Tile, output: Output) -> Vec<u32> {
    field.arch.dispatch(Sum::<S, MEASURED> {
        law: field.law,
        field,
        tile,
        irregular: Vec::new(),
        output,
    })
}

struct Sum<'a, S, const MEASURED: bool> {
    law: CutPotential<S>,
    field: &'a Field<'a, S>,
    tile: &'a Tile,
    irregular: Vec<u32>,
    output: Output<'a>,
}

impl<S: PairShape, const MEASURED: bool> WithSimd for Sum<'_, S, MEASURED> {
    type Output = Vec<u32>;

    #[inline(always)]
    fn with_simd<L: Simd>(mut self, simd: L) -> Vec<u32> {
        // A copy that stays in registers.
        let law = self.law;
        let tile = self.tile;
        let mut begun = 0;
        for run in &tile.runs {
            // What is inside comes first, and soon before what is across, while it is still in the cache.
            for group in tile.groups.get(begun..run.groups).unwrap_or_default() {
                self.begin_group(simd, &law, group);
            }
            begun = begun.max(run.groups);
            match self.field.strings.of(run.kind).reach {
                1 => self.add_run::<L, 1>(simd, &law, run),
                2 => self.add_run::<L, 2>(simd, &law, run),
                _ => self.add_run::<L, 3>(simd, &law, run),
            }
        }
        for group in &tile.groups[begun..] {
            self.begin_group(simd, &law, group);
        }
        self.irregular
    }
}

impl<S: PairShape, const MEASURED: bool> Sum<'_, S, MEASURED> {
    /// Adds the forces of a run of interfaces whose strings act on `N` nodes of each triangle.
    #[inline(always)]
    fn add_run<L: Simd, const N: usize>(&mut self, simd: L, law: &CutPotential<S>, run: &Run) {
        let total = run.count as usize;
        let states = &self.field.states[run.number as usize..run.number as usize + total];
        for at in (0..total).step_by(Lanes::<L>::COUNT) {
            let count = Lanes::<L>::COUNT.min(total - at);
            let mut any_open = false;
            for &state in &states[at..at + count] {
                any_open |= state == State::Open;
            }
            if !any_open && count == Lanes::<L>::COUNT {
                self.add_interfaces::<L, N>(simd, law, run, at, count, None);
            } else {
                simd.vectorize(SomeInterfaces::<S, L, MEASURED, N> {
                    simd,
                    sum: self,
                    run,
                    at,
                    count,
                });
            }
        }
    }

    /// Adds the forces of so many of the interfaces of a run from one on; those that `keep` leaves out give nothing.
    #[inline(always)]
    fn add_interfaces<L: Simd, const N: usize>(
        &mut self,
        simd: L,
        law: &CutPotential<S>,
        run: &Run,
        at: usize,
        count: usize,
        keep: Option<Mask<L>>,
    ) {
        let field = self.field;
        let kind = field.strings.of(run.kind);
        let ends = [
            ends::<L, N>(simd, field.position, &run.nodes[0], at, count),
            ends::<L, N>(simd, field.position, &run.nodes[1], at, count),
        ];
        let sum = strings::sum::<S, L, MEASURED, N>(simd, law, field.limit, kind, &ends, keep);
        if !sum.regular.every() {
            self.note_irregular(run, at, count, sum.regular.answers());
        }
        // Where a triangle is the second of one interface and the first of another, the former has the lower number.
        let first_node = 3 * self.tile.triangles.start;
        if run.owned[1] {
            let nodes = run.nodes[1].map(|node| node as usize + at - first_node);
            take::<L, N>(simd, &mut self.output.force, nodes, count, &sum.from);
            if MEASURED {
                self.hold_half(simd, run.second as usize + at, count, &sum.held);
            }
        }
        if run.owned[0] {
            let nodes = run.nodes[0].map(|node| node as usize + at - first_node);
            give::<L, N>(simd, &mut self.output.force, nodes, count, &sum.on);
            if MEASURED {
                self.hold_half(simd, run.first as usize + at, count, &sum.held);
            }
        }
    }

    /// Adds to so many triangles from one on their half of what strings hold.
    #[inline(always)]
    fn hold_half<L: Simd>(&mut self, simd: L, triangle: usize, count: usize, held: &[Lanes<L>; PARTS]) {
        let place = triangle - self.tile.triangles.start;
        for (plane, held) in self.output.held.iter_mut().zip(held) {
            let before = Lanes::load_some(simd, plane, place, count);
            held.times_add(0.5, before).store(plane, place, count);
        }
    }

    /// Which of some interfaces of a run count: those that are not open or whose strings are kept.
    fn kept<L: Simd>(&self, simd: L, run: &Run, at: usize, count: usize) -> Mask<L> {
        let counts = |lane: usize| {
            let number = run.number as usize + at + lane;
            lane < count && (self.field.states[number] != State::Open || self.field.strings.are_kept(number))
        };
        Lanes::each(simd, |lane| f64::from(u8::from(counts(lane)))).is_above(0.0)
    }

    /// Notes the triangles of the tile with irregular interfaces that are not open.
    #[cold]
    fn note_irregular(&mut self, run: &Run, at: usize, count: usize, regular: [bool; MOST]) {
        for lane in (0..count).filter(|&lane| !regular[lane]) {
            if self.field.states[run.number as usize + at + lane] == State::Open {
                continue;
            }
            for (side, triangle) in [run.first, run.second].into_iter().enumerate() {
                if run.owned[side] {
                    self.irregular.push(triangle + (at + lane) as u32);
                }
            }
        }
    }

    /// Sets the forces of a group to those of the bonds inside its triangles.
    #[inline(always)]
    fn begin_group<L: Simd>(&mut self, simd: L, law: &CutPotential<S>, group: &Group) {
        for from in group.elements.clone().step_by(Lanes::<L>::COUNT) {
            self.set_inside(simd, law, group, from);
        }
    }

    /// Sets the forces of some triangles of a group, from one on, to those of the bonds inside them.
    #[inline(always)]
    fn set_inside<L: Simd>(&mut self, simd: L, law: &CutPotential<S>, group: &Group, from: usize) {
        let count = Lanes::<L>::COUNT.min(group.elements.end - from);
        let nodes = [group.node(from, 0), group.node(from, 1), group.node(from, 2)];
        let mut corners = [[Lanes::all(simd, 0.0); 2]; 3];
        for corner in 0..3 {
            for axis in 0..2 {
                corners[corner][axis] = Lanes::load_some(simd, &self.field.position[axis], nodes[corner], count);
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
        let first_node = 3 * self.tile.triangles.start;
        for (corner, node) in nodes.into_iter().enumerate() {
            for axis in 0..2 {
                bulk.nodal[2 * corner + axis].store(self.output.force[axis], node - first_node, count);
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

/// Interfaces of which some are open, or fewer than there are lanes. They have a function of their own, so that the others do
/// not pay for them.
struct SomeInterfaces<'a, 'b, S, T: Simd, const MEASURED: bool, const N: usize> {
    simd: T,
    sum: &'a mut Sum<'b, S, MEASURED>,
    run: &'a Run,
    at: usize,
    count: usize,
}

impl<S: PairShape, T: Simd, const MEASURED: bool, const N: usize> WithSimd
    for SomeInterfaces<'_, '_, S, T, MEASURED, N>
{
    type Output = ();

    #[inline(always)]
    fn with_simd<L: Simd>(self, _: L) {
        let Self {
            simd,
            sum,
            run,
            at,
            count,
        } = self;
        let keep = sum.kept(simd, run, at, count);
        let law = sum.law;
        sum.add_interfaces::<T, N>(simd, &law, run, at, count, Some(keep));
    }
}

/// So many vectors of two planes from a place on.
#[inline(always)]
fn load<L: Simd>(simd: L, [x, y]: &Planes, from: usize, count: usize) -> Vector<L> {
    Vector {
        x: Lanes::load_some(simd, x, from, count),
        y: Lanes::load_some(simd, y, from, count),
    }
}

/// The acting nodes of so many triangles that are `at` triangles behind one with these nodes.
#[inline(always)]
fn ends<L: Simd, const N: usize>(simd: L, position: &Planes, nodes: &[u32; 3], at: usize, count: usize) -> Ends<L> {
    let zero = Vector::zero(simd);
    let node = load(simd, position, nodes[0] as usize + at, count);
    let [mut to_second, mut to_third] = [zero; 2];
    if N > 1 {
        to_second = load(simd, position, nodes[1] as usize + at, count) - node;
    }
    if N > 2 {
        to_third = load(simd, position, nodes[2] as usize + at, count) - node;
    }
    Ends {
        node,
        to_second,
        to_third,
    }
}

/// Adds forces on the acting nodes of so many triangles.
#[inline(always)]
fn give<L: Simd, const N: usize>(
    simd: L,
    force: &mut [&mut [f64]; 2],
    nodes: [usize; 3],
    count: usize,
    sum: &NodalForces<L>,
) {
    add(simd, force, nodes[0], count, sum.first);
    if N > 1 {
        add(simd, force, nodes[1], count, sum.second);
    }
    if N > 2 {
        add(simd, force, nodes[2], count, sum.third);
    }
}

/// Takes them off instead.
#[inline(always)]
fn take<L: Simd, const N: usize>(
    simd: L,
    force: &mut [&mut [f64]; 2],
    nodes: [usize; 3],
    count: usize,
    sum: &NodalForces<L>,
) {
    let zero = Vector::zero(simd);
    let negative = NodalForces {
        first: zero - sum.first,
        second: zero - sum.second,
        third: zero - sum.third,
    };
    give::<L, N>(simd, force, nodes, count, &negative);
}

/// Adds so many vectors to those of two planes from a place on.
#[inline(always)]
fn add<L: Simd>(simd: L, [x, y]: &mut [&mut [f64]; 2], place: usize, count: usize, more: Vector<L>) {
    (Lanes::load_some(simd, x, place, count) + more.x).store(x, place, count);
    (Lanes::load_some(simd, y, place, count) + more.y).store(y, place, count);
}
