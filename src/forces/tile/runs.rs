//! Runs of any interfaces, several side by side.

use pulp::{Simd, WithSimd};

use super::Run;
use super::sums::Sum;
use crate::forces::Planes;
use crate::forces::interface::State;
use crate::forces::measure::PARTS;
use crate::forces::strings::{self, Ends, NodalForces};
use crate::forces::vector::Vector;
use crate::lanes::{Lanes, MOST, Mask};
use crate::potential::{CutPotential, PairShape};

impl<S: PairShape, const MEASURED: bool> Sum<'_, S, MEASURED> {
    /// Adds the forces of a run of interfaces whose strings act on `N` nodes of each triangle.
    #[inline(always)]
    pub(super) fn add_run<L: Simd, const N: usize>(&mut self, simd: L, law: &CutPotential<S>, run: &Run) {
        let total = run.count as usize;
        for at in (0..total).step_by(Lanes::<L>::COUNT) {
            let count = Lanes::<L>::COUNT.min(total - at);
            if count == Lanes::<L>::COUNT && self.are_intact(run, at, count) {
                self.add_interfaces::<L, N>(simd, law, run, at, count, None);
            } else {
                self.add_some::<L, N>(simd, run, at, count);
            }
        }
    }

    /// Whether none of so many interfaces of a run is open.
    #[inline(always)]
    fn are_intact(&self, run: &Run, at: usize, count: usize) -> bool {
        let first = run.number as usize + at;
        !State::any_open(&self.field.states[first..first + count])
    }

    /// Adds the forces of so many of the interfaces of a run from one on, of which some are open or irregular.
    #[inline(always)]
    pub(super) fn add_some<L: Simd, const N: usize>(&mut self, simd: L, run: &Run, at: usize, count: usize) {
        simd.vectorize(SomeInterfaces::<S, L, MEASURED, N> {
            simd,
            sum: self,
            run,
            at,
            count,
        });
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
        let sum = strings::sum::<S, L, MEASURED, N>(simd, law, field.limit, &kind.carried, &ends, keep);
        if !sum.regular.every() {
            self.note_irregular(run, at, count, sum.regular.answers());
        }
        // Where a triangle is the second of one interface and the first of another, the former has the lower number.
        if run.owned[1] {
            let places = run.places[1].map(|place| place as usize + at);
            take::<L, N>(simd, &mut self.gathered, places, count, &sum.from);
            if MEASURED {
                self.hold_half(simd, run.second as usize + at, count, &sum.held);
            }
        }
        if run.owned[0] {
            let places = run.places[0].map(|place| place as usize + at);
            give::<L, N>(simd, &mut self.gathered, places, count, &sum.on);
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
fn give<L: Simd, const N: usize>(simd: L, force: &mut Planes, nodes: [usize; 3], count: usize, sum: &NodalForces<L>) {
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
fn take<L: Simd, const N: usize>(simd: L, force: &mut Planes, nodes: [usize; 3], count: usize, sum: &NodalForces<L>) {
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
fn add<L: Simd>(simd: L, [x, y]: &mut Planes, place: usize, count: usize, more: Vector<L>) {
    (Lanes::load_some(simd, x, place, count) + more.x).store(x, place, count);
    (Lanes::load_some(simd, y, place, count) + more.y).store(y, place, count);
}
