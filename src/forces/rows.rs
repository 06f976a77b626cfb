//! Interfaces side by side while all is as in the crystal: edges that two strings of nearest neighbours cross, and corners
//! that one bond crosses. The same to the bit as [`super::strings`] does for every interface, without what only others need.

use pulp::Simd;

use super::regular::Regular;
use super::strings::{Along, CarriedString};
use super::vector::Vector;
use crate::lanes::{Lanes, Mask};
use crate::potential::{CutPotential, PairShape};

/// Whether an edge has two strings of nearest neighbours that change alike from bond to bond.
pub fn is_edge(strings: &[CarriedString]) -> bool {
    let [one, other] = strings else {
        return false;
    };
    one.change == other.change && one.is_nearest && other.is_nearest
}

/// Whether a corner has one bond.
pub fn is_corner(strings: &[CarriedString]) -> bool {
    matches!(strings, [one] if one.is_one_bond())
}

/// Forces on the two acting nodes of the first triangles, and what is to be taken from those on the second.
pub struct EdgeForces<L: Simd> {
    pub on: [Vector<L>; 2],
    pub from: [Vector<L>; 2],
}

/// The forces of some [edges](is_edge) between triangles with acting nodes at these places, and whether all bonds are regular:
/// only then do they mean anything.
#[inline(always)]
pub fn sum_edge<S: PairShape, L: Simd>(
    simd: L,
    law: &CutPotential<S>,
    regular: &Regular,
    spacing: f64,
    [one, other]: [&CarriedString; 2],
    [a, b]: [Vector<L>; 2],
    [c, d]: [Vector<L>; 2],
) -> (EdgeForces<L>, Mask<L>) {
    let zero = Vector::zero(simd);
    let [first, second, across] = [b - a, d - c, c - a];
    let u = first.times_taken_from(Lanes::all(simd, one.middle[0][0]), across);
    let u = second.times_add(Lanes::all(simd, one.middle[1][0]), u);
    let v = first.times_taken_from(Lanes::all(simd, other.middle[0][0]), across);
    let v = second.times_add(Lanes::all(simd, other.middle[1][0]), v);
    let [change, others_change] = [Lanes::all(simd, one.change[0][0]), Lanes::all(simd, one.change[1][0])];
    let w = second.times_add(others_change, first.times_taken_from(change, zero));
    let along = Along::new(u, w);
    let others_along = Along::new(v, w);
    let [least, most] = along.range(one.half);
    let [others_least, others_most] = others_along.range(other.half);
    let is_regular = regular.holds(least, most).and(regular.holds(others_least, others_most));
    let g = one.sum::<S, L, false, true>(simd, law, spacing, &along);
    let h = other.sum::<S, L, false, true>(simd, law, spacing, &others_along);
    let force = w.times_add(g.first, u.times(g.zeroth));
    let moment = w.times_add(g.second, u.times(g.first));
    let others_force = w.times_add(h.first, v.times(h.zeroth));
    let others_moment = w.times_add(h.second, v.times(h.first));
    let whole = zero + force + others_force;
    let on = force.times_add(Lanes::all(simd, one.middle[0][0]), zero);
    let on = moment.times_add(change, on);
    let on = others_force.times_add(Lanes::all(simd, other.middle[0][0]), on);
    let on = others_moment.times_add(change, on);
    let from = force.times_add(Lanes::all(simd, one.middle[1][0]), zero);
    let from = moment.times_add(others_change, from);
    let from = others_force.times_add(Lanes::all(simd, other.middle[1][0]), from);
    let from = others_moment.times_add(others_change, from);
    let forces = EdgeForces {
        on: [whole - on, on],
        from: [whole - from, from],
    };
    (forces, is_regular)
}

/// The force of the bond from one corner to another on the first, and whether it is regular.
#[inline(always)]
pub fn sum_corner<S: PairShape, L: Simd>(
    simd: L,
    law: &CutPotential<S>,
    regular: &Regular,
    from: Vector<L>,
    to: Vector<L>,
) -> (Vector<L>, Mask<L>) {
    let bond = to - from;
    let squared = bond.squared();
    let force = bond.times(law.untouched_slopes(simd, squared));
    (force, regular.holds(squared, squared))
}
