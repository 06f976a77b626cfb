//! Runs of edges and corners as in the crystal, several side by side.

use pulp::Simd;

use super::Run;
use super::sums::Sum;
use crate::forces::interface::State;
use crate::forces::regular::Regular;
use crate::forces::rows;
use crate::forces::vector::Vector;
use crate::lanes::{Lanes, prefetch};
use crate::potential::{CutPotential, PairShape};

impl<S: PairShape, const MEASURED: bool> Sum<'_, S, MEASURED> {
    /// Adds the forces of a run of edges; where bonds are open or irregular the general way does.
    #[inline(always)]
    pub(super) fn add_edges<L: Simd>(&mut self, simd: L, law: &CutPotential<S>, regular: &Regular, run: &Run) {
        let [one, other] = self.field.strings.of(run.kind).carried.as_slice() else {
            return self.add_run::<L, 2>(simd, law, run);
        };
        let lanes = Lanes::<L>::COUNT;
        let total = run.count as usize;
        let [a, b, c, d] = [run.nodes[0][0], run.nodes[0][1], run.nodes[1][0], run.nodes[1][1]]
            .map(|node| node as usize..node as usize + total);
        let [x, y] = self.field.position;
        let [xa, xb, xc, xd] = [&x[a.clone()], &x[b.clone()], &x[c.clone()], &x[d.clone()]];
        let [ya, yb, yc, yd] = [&y[a.clone()], &y[b.clone()], &y[c.clone()], &y[d.clone()]];
        let own = [run.places[0][0], run.places[0][1], run.places[1][0], run.places[1][1]]
            .map(|place| place as usize..place as usize + total);
        let [force_x, force_y] = &mut self.gathered;
        let parts = [force_x.get_disjoint_mut(own.clone()), force_y.get_disjoint_mut(own)];
        let [Ok([fxa, fxb, fxc, fxd]), Ok([fya, fyb, fyc, fyd])] = parts else {
            return self.add_run::<L, 2>(simd, law, run);
        };
        let states = &self.field.states[run.number as usize..run.number as usize + total];
        let spacing = self.field.limit.spacing;
        let first_node = 3 * self.tile.triangles.start;
        let mut others = Vec::new();
        let mut at = 0;
        while at + lanes <= total {
            let any_open = State::any_open(&states[at..at + lanes]);
            if let Some(ahead) = &self.ahead {
                // What moves on when the row ends.
                for node in run.nodes[0] {
                    for axis in 0..2 {
                        prefetch(&ahead.before[axis], node as usize + at);
                        prefetch(ahead.velocity[axis], node as usize + at - first_node);
                        prefetch(ahead.next[axis], node as usize + at - first_node);
                    }
                }
            }
            let ends = [Vector::load(simd, xa, ya, at), Vector::load(simd, xb, yb, at)];
            let others_ends = [Vector::load(simd, xc, yc, at), Vector::load(simd, xd, yd, at)];
            let (sum, is_regular) = rows::sum_edge(simd, law, regular, spacing, [one, other], ends, others_ends);
            if any_open || !is_regular.every() {
                others.push(at);
            } else {
                let zero = Vector::zero(simd);
                sum.on[0].add_to(fxa, fya, at);
                sum.on[1].add_to(fxb, fyb, at);
                (zero - sum.from[0]).add_to(fxc, fyc, at);
                (zero - sum.from[1]).add_to(fxd, fyd, at);
            }
            at += lanes;
        }
        if at < total {
            others.push(at);
        }
        for at in others {
            self.add_some::<L, 2>(simd, run, at, lanes.min(total - at));
        }
    }

    /// Adds the forces of a run of corners, likewise.
    #[inline(always)]
    pub(super) fn add_corners<L: Simd>(&mut self, simd: L, law: &CutPotential<S>, regular: &Regular, run: &Run) {
        let lanes = Lanes::<L>::COUNT;
        let total = run.count as usize;
        let [a, b] = [run.nodes[0][0], run.nodes[1][0]].map(|node| node as usize..node as usize + total);
        let [x, y] = self.field.position;
        let [xa, xb, ya, yb] = [&x[a.clone()], &x[b.clone()], &y[a.clone()], &y[b.clone()]];
        let own = [run.places[0][0], run.places[1][0]].map(|place| place as usize..place as usize + total);
        let [force_x, force_y] = &mut self.gathered;
        let parts = [force_x.get_disjoint_mut(own.clone()), force_y.get_disjoint_mut(own)];
        let [Ok([fxa, fxb]), Ok([fya, fyb])] = parts else {
            return self.add_run::<L, 1>(simd, law, run);
        };
        let states = &self.field.states[run.number as usize..run.number as usize + total];
        let mut others = Vec::new();
        let mut at = 0;
        while at + lanes <= total {
            let any_open = State::any_open(&states[at..at + lanes]);
            let [from, to] = [Vector::load(simd, xa, ya, at), Vector::load(simd, xb, yb, at)];
            let (force, is_regular) = rows::sum_corner(simd, law, regular, from, to);
            if any_open || !is_regular.every() {
                others.push(at);
            } else {
                force.add_to(fxa, fya, at);
                (Vector::zero(simd) - force).add_to(fxb, fyb, at);
            }
            at += lanes;
        }
        if at < total {
            others.push(at);
        }
        for at in others {
            self.add_some::<L, 1>(simd, run, at, lanes.min(total - at));
        }
    }
}
