//! Kicks and drifts of nodes side by side.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use crate::lanes::Lanes;
use crate::mesh::grouped::Answer;
use crate::state::Leap;

/// Corners of an octahedron, each beside the one opposite.
const OCTAHEDRON: usize = 6;

/// Nodes along one axis: of single atoms or of elements with lumped masses, or the `N` corners of elements whose masses are
/// coupled: 3 of triangles, 4 of tetrahedra, 6 of octahedra. Arithmetic rounds as that of single numbers does.
pub struct Moving<'a, const N: usize> {
    pub corners: [Nodes<'a>; N],
    pub answer: Answer,
    pub leap: Leap,
    /// Whether the drift is done, too.
    pub drifts: bool,
}

/// Nodes side by side.
pub struct Nodes<'a> {
    /// How fast they were; `None`: what `velocity` tells.
    pub before: Option<&'a [f64]>,
    /// How fast they come to be.
    pub velocity: &'a mut [f64],
    pub force: &'a [f64],
    pub mobility: Mobility<'a>,
    /// Where they are; `None`: where `next` tells.
    pub position: Option<&'a [f64]>,
    /// Where they come to be.
    pub next: &'a mut [f64],
}

/// What a force is multiplied by to give the acceleration.
#[derive(Clone, Copy)]
pub enum Mobility<'a> {
    Same(f64),
    Each(&'a [f64]),
}

impl Mobility<'_> {
    #[inline(always)]
    fn load<L: Simd>(self, simd: L, from: usize, count: usize) -> Lanes<L> {
        match self {
            Self::Same(mobility) => Lanes::all(simd, mobility),
            Self::Each(plane) => Lanes::load_some(simd, plane, from, count),
        }
    }

    /// The same of some of the nodes.
    fn part(self, part: Range<usize>) -> Self {
        match self {
            Self::Same(_) => self,
            Self::Each(plane) => Self::Each(&plane[part]),
        }
    }
}

impl<'a> Nodes<'a> {
    /// Nodes of elements side by side, corner by corner, that move in place.
    pub fn corners<const N: usize>(self) -> [Self; N] {
        let count = self.force.len() / N;
        let [mut velocity, mut next] = [self.velocity, self.next].map(|plane| plane.chunks_mut(count));
        std::array::from_fn(|corner| {
            let part = corner * count..(corner + 1) * count;
            Self {
                before: None,
                velocity: velocity.next().unwrap_or_default(),
                force: &self.force[part.clone()],
                mobility: self.mobility.part(part),
                position: None,
                next: next.next().unwrap_or_default(),
            }
        })
    }
}

impl<const N: usize> WithSimd for Moving<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<L: Simd>(mut self, simd: L) {
        let total = self.corners[0].force.len();
        let whole = total - total % Lanes::<L>::COUNT;
        for from in (0..whole).step_by(Lanes::<L>::COUNT) {
            self.advance(simd, from, Lanes::<L>::COUNT);
        }
        if whole < total {
            self.advance(simd, whole, total - whole);
        }
    }
}

impl<const N: usize> Moving<'_, N> {
    #[inline(always)]
    fn advance<L: Simd>(&mut self, simd: L, from: usize, count: usize) {
        let mut shared = Lanes::all(simd, 0.0);
        if N > 1 {
            for corner in &self.corners {
                shared = shared + Lanes::load_some(simd, corner.force, from, count);
            }
            shared = shared * self.answer.of_sum;
        }
        for number in 0..N {
            let mut force = Lanes::load_some(simd, self.corners[number].force, from, count);
            if N == OCTAHEDRON {
                let opposite = Lanes::load_some(simd, self.corners[number ^ 1].force, from, count);
                force = force + opposite * self.answer.of_opposite;
            }
            let corner = &mut self.corners[number];
            let mobility = corner.mobility.load(simd, from, count);
            let before = match corner.before {
                Some(before) => Lanes::load_some(simd, before, from, count),
                None => Lanes::load_some(simd, corner.velocity, from, count),
            };
            let velocity = self.leap.velocities(force - shared, mobility, before);
            velocity.store(corner.velocity, from, count);
            if self.drifts {
                let position = match corner.position {
                    Some(position) => Lanes::load_some(simd, position, from, count),
                    None => Lanes::load_some(simd, corner.next, from, count),
                };
                self.leap.positions(position, velocity).store(corner.next, from, count);
            }
        }
    }
}
