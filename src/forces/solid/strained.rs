//! Interfaces that may open before neighbours are searched again: their bonds differ more from those of the crystal than
//! elsewhere. The sites along them are kept ready, so that nothing has to be searched when they open.

use pulp::{Simd, WithSimd};

use super::edges::{Edges, string_below};
use super::faces::Face;
use super::sweep::places;
use crate::lanes::{Lanes, Mask};
use crate::mesh::solid::Solid;
use crate::mesh::solid::interfaces::Run;
use crate::mesh::solid::template::{BORDERS, Contact};

/// Bonds that long are strained, in spacings. The greatest force is at 1.109 of them, and an interface of the source opens at
/// 1.33. In the film of Fig. 6-1 less costs more for sites that nothing meets than it saves searches.
pub const LONG: f64 = 1.08;

/// Second neighbours that near are, in cutoffs: those of the crystal are 1.06 of them away.
pub const NEAR: f64 = 1.02;

/// The intact interfaces among some runs that are strained, by number.
pub struct Strained<'a> {
    pub mesh: &'a Solid,
    pub runs: &'a [Run],
    /// One for each interface that is intact, zero for others.
    pub intact: &'a [f64],
    pub position: &'a [Vec<f64>; 3],
    /// Bonds are strained that are longer, squared.
    pub longer: f64,
    /// Second neighbours are that are nearer, squared.
    pub nearer: f64,
}

impl WithSimd for Strained<'_> {
    type Output = Vec<u32>;

    #[inline(always)]
    fn with_simd<L: Simd>(self, simd: L) -> Vec<u32> {
        let mut strained = Vec::new();
        for run in self.runs {
            let mut at = 0;
            while at < run.len {
                let count = Lanes::<L>::COUNT.min(run.len - at);
                let intact = Lanes::load_some(simd, self.intact, run.number + at, count).is_above(0.0);
                if intact.any() {
                    let answers = self.are_strained(simd, run, at, count).and(intact).answers();
                    let lanes = (0..count).filter(|&lane| answers[lane]);
                    strained.extend(lanes.map(|lane| (run.number + at + lane) as u32));
                }
                at += count;
            }
        }
        strained
    }
}

impl Strained<'_> {
    #[inline(always)]
    fn are_strained<L: Simd>(&self, simd: L, run: &Run, at: usize, count: usize) -> Mask<L> {
        let groups = [self.mesh.group_of(run.first), self.mesh.group_of(run.second)];
        let parts = [run.first + at, run.second + at];
        let size = groups[0].size;
        let longer = [self.longer; 2];
        match BORDERS[run.border].contact {
            Contact::Face {
                tetrahedron,
                octahedron,
            } => {
                let first = places(simd, self.position, groups[0], parts[0], tetrahedron, count);
                let second = places(simd, self.position, groups[1], parts[1], octahedron, count);
                let face = Face::new(size, first, second);
                face.exceeds(simd, longer)[0].or(face.second_neighbours_below(simd, self.nearer))
            }
            Contact::Edges { first, second } => {
                let first = places(simd, self.position, groups[0], parts[0], first, count);
                let second = places(simd, self.position, groups[1], parts[1], second, count);
                let edges = Edges::new(size, first, second);
                edges.exceeds(simd, longer)[0].or(edges.second_neighbours_below(simd, self.nearer))
            }
            Contact::FarEdges { first, second } => {
                let first = places(simd, self.position, groups[0], parts[0], first, count);
                let second = places(simd, self.position, groups[1], parts[1], second, count);
                string_below(simd, [first[0] - second[0], first[1] - second[1]], self.nearer)
            }
            Contact::Tips { first, second } => {
                let [first] = places(simd, self.position, groups[0], parts[0], [first], count);
                let [second] = places(simd, self.position, groups[1], parts[1], [second], count);
                (first - second).squared().is_below(self.nearer)
            }
        }
    }
}
