//! The bonds inside parts of blocks and across their intact interfaces, row by row.
//!
//! A part's sum begins with its inside and takes its interfaces in the order of the mesh. A tile is what one task computes: an
//! interface between two tiles is computed in both, each for its own side, so that no sum depends on how tiles are cut.

use std::collections::HashMap;
use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::certified::Few;
use super::edges::{Edges, string_below};
use super::faces::{Bonds, Face};
use super::inside::{self, Class};
use super::measure::{Held, PARTS};
use super::vector::Vector;
use crate::forces::Summation;
use crate::lanes::{Lanes, Mask};
use crate::mesh::solid::element::{Element, Shape};
use crate::mesh::solid::interfaces::{Interfaces, Run};
use crate::mesh::solid::template::{BORDERS, Contact};
use crate::mesh::solid::{Group, Solid};
use crate::potential::{CutPotential, PairShape};

/// Consecutive groups of parts, and the runs of interfaces that touch them.
#[derive(Clone, Debug)]
pub struct Tile {
    groups: Range<usize>,
    pub elements: Range<usize>,
    pub nodes: Range<usize>,
    runs: Vec<TouchingRun>,
}

#[derive(Clone, Copy, Debug)]
struct TouchingRun {
    run: Run,
    /// Whether its first and its second parts belong to the tile.
    is_mine: [bool; 2],
}

/// Cuts the groups of some parts into so many tiles of about equally many parts.
pub fn tiles(mesh: &Solid, interfaces: &Interfaces, parts: Range<usize>, count: usize) -> Vec<Tile> {
    let groups = mesh.groups();
    let mut tiles = Vec::new();
    let mut from = groups.partition_point(|group| group.elements.start < parts.start);
    for number in 1..=count {
        let end = parts.start + parts.len() * number / count;
        let to = groups.partition_point(|group| group.elements.end <= end);
        if to > from {
            tiles.push(tile(mesh, interfaces, from..to));
            from = to;
        }
    }
    tiles
}

/// Some consecutive groups.
pub fn tile(mesh: &Solid, interfaces: &Interfaces, groups: Range<usize>) -> Tile {
    let of_groups = &mesh.groups()[groups.clone()];
    let elements = of_groups[0].elements.start..of_groups[of_groups.len() - 1].elements.end;
    let nodes = of_groups[0].nodes().start..of_groups[of_groups.len() - 1].nodes().end;
    let touching = interfaces.runs.iter().map(|&run| TouchingRun {
        run,
        is_mine: [run.first, run.second].map(|part| elements.contains(&part)),
    });
    Tile {
        groups,
        nodes,
        runs: touching.filter(|run| run.is_mine != [false, false]).collect(),
        elements,
    }
}

/// What all tiles look at.
pub struct Field<'a, S> {
    pub law: CutPotential<S>,
    pub summation: Summation,
    pub mesh: &'a Solid,
    pub classes: &'a HashMap<(Shape, i32), Vec<Class>>,
    /// Places that stand for all bonds of patches between parts of blocks of a size.
    pub few: &'a HashMap<i32, Few>,
    /// One for each interface that is intact, zero for others.
    pub intact: &'a [f64],
    pub position: &'a [Vec<f64>; 3],
}

/// The sums of one tile: forces on its nodes and what its parts hold. It gives the numbers of intact interfaces that are no
/// longer regular: then its forces mean nothing.
pub struct Sweep<'a, S, const MEASURED: bool> {
    pub field: &'a Field<'a, S>,
    pub tile: &'a Tile,
    pub force: [&'a mut [f64]; 3],
    pub held: [&'a mut [f64]; PARTS],
}

impl<S: PairShape, const MEASURED: bool> WithSimd for Sweep<'_, S, MEASURED> {
    type Output = Vec<u32>;

    #[inline(always)]
    fn with_simd<L: Simd>(mut self, simd: L) -> Vec<u32> {
        for group in &self.field.mesh.groups()[self.tile.groups.clone()] {
            self.sum_inside(simd, group);
        }
        let mut irregular = Vec::new();
        let tile = self.tile;
        for touching in &tile.runs {
            self.add_run(simd, touching, &mut irregular);
        }
        irregular
    }
}

impl<S: PairShape, const MEASURED: bool> Sweep<'_, S, MEASURED> {
    #[inline(always)]
    fn sum_inside<L: Simd>(&mut self, simd: L, group: &Group) {
        let classes = &self.field.classes[&(group.shape, group.size)];
        let mut at = 0;
        while at < group.len() {
            let count = Lanes::<L>::COUNT.min(group.len() - at);
            let element = group.elements.start + at;
            let held = match group.shape {
                Shape::Octahedron => {
                    let nodes = [0, 1, 2, 3, 4, 5];
                    let places = places(simd, self.field.position, group, element, nodes, count);
                    let (forces, held) =
                        inside::sum_octahedron::<S, L, MEASURED>(simd, &self.field.law, classes, places);
                    self.put(group, element, nodes, forces, count);
                    held
                }
                _ => {
                    let nodes = [0, 1, 2, 3];
                    let places = places(simd, self.field.position, group, element, nodes, count);
                    let (forces, held) =
                        inside::sum_tetrahedron::<S, L, MEASURED>(simd, &self.field.law, classes, places);
                    self.put(group, element, nodes, forces, count);
                    held
                }
            };
            held.store(&mut self.held, element.wrapping_sub(self.tile.elements.start), count);
            at += count;
        }
    }

    #[inline(always)]
    fn put<L: Simd, const N: usize>(
        &mut self,
        group: &Group,
        element: usize,
        corners: [u8; N],
        forces: [Vector<L>; N],
        count: usize,
    ) {
        for (force, corner) in forces.iter().zip(corners) {
            let node = group.node(element, usize::from(corner)) - self.tile.nodes.start;
            force.store(&mut self.force, node, count);
        }
    }

    #[inline(always)]
    fn add<L: Simd, const N: usize>(
        &mut self,
        group: &Group,
        element: usize,
        corners: [u8; N],
        forces: [Vector<L>; N],
        count: usize,
    ) {
        for (force, corner) in forces.iter().zip(corners) {
            let node = group.node(element, usize::from(corner)) - self.tile.nodes.start;
            force.add_to(&mut self.force, node, count);
        }
    }

    #[inline(always)]
    fn add_run<L: Simd>(&mut self, simd: L, touching: &TouchingRun, irregular: &mut Vec<u32>) {
        let TouchingRun { run, is_mine } = touching;
        let mesh = self.field.mesh;
        let groups = [mesh.group_of(run.first), mesh.group_of(run.second)];
        let law = self.field.law;
        let limits = [law.squared_cutoff(), law.squared_untouched()];
        let limit = law.squared_cutoff();
        let size = groups[0].size;
        let of_node = |shape| Element::in_block(shape, size).lumped_mass();
        let [tetrahedron, octahedron] = [Shape::Low, Shape::Octahedron].map(of_node);
        let is_nodal = self.field.summation == Summation::Nodal;
        let bonds = match is_nodal {
            true => Bonds::OfNodes {
                tetrahedron,
                octahedron,
            },
            false => Bonds::All(self.field.few.get(&size)),
        };
        let mut at = 0;
        while at < run.len {
            let count = Lanes::<L>::COUNT.min(run.len - at);
            let parts = [run.first + at, run.second + at];
            let number = run.number + at;
            let intact = Lanes::load_some(simd, self.field.intact, number, count).is_above(0.0);
            at += count;
            if !intact.any() {
                continue;
            }
            match BORDERS[run.border].contact {
                Contact::Face {
                    tetrahedron,
                    octahedron,
                } => {
                    let first = places(simd, self.field.position, groups[0], parts[0], tetrahedron, count);
                    let second = places(simd, self.field.position, groups[1], parts[1], octahedron, count);
                    let face = Face::new(size, first, second);
                    let [longer, touched] = face.exceeds(simd, limits);
                    let lost = longer.or(face.second_neighbours_below(simd, limit)).and(intact);
                    if lost.any() {
                        tell(lost, number, count, irregular);
                        continue;
                    }
                    let untouched = !touched.and(intact).any();
                    let (forces, held) = face.sum::<S, MEASURED>(simd, &law, untouched, bonds);
                    if is_mine[0] {
                        let forces = where_intact(simd, forces.on_tetrahedron, intact);
                        self.add(groups[0], parts[0], tetrahedron, forces, count);
                    }
                    if is_mine[1] {
                        let forces = where_intact(simd, forces.on_octahedron, intact);
                        self.add(groups[1], parts[1], octahedron, forces, count);
                    }
                    self.hold(simd, held, intact, parts, *is_mine, count);
                }
                Contact::Edges { first, second } => {
                    let first_ends = places(simd, self.field.position, groups[0], parts[0], first, count);
                    let second_ends = places(simd, self.field.position, groups[1], parts[1], second, count);
                    let edges = Edges::new(size, first_ends, second_ends);
                    let [longer, _] = edges.exceeds(simd, limits);
                    let lost = longer.or(edges.second_neighbours_below(simd, limit)).and(intact);
                    if lost.any() {
                        tell(lost, number, count, irregular);
                        continue;
                    }
                    let (forces, held) = edges.sum::<S, MEASURED>(simd, &law, is_nodal.then_some(octahedron));
                    if is_mine[0] {
                        self.add(groups[0], parts[0], first, where_intact(simd, forces[0], intact), count);
                    }
                    if is_mine[1] {
                        self.add(
                            groups[1],
                            parts[1],
                            second,
                            where_intact(simd, forces[1], intact),
                            count,
                        );
                    }
                    self.hold(simd, held, intact, parts, *is_mine, count);
                }
                Contact::FarEdges { first, second } => {
                    let first = places(simd, self.field.position, groups[0], parts[0], first, count);
                    let second = places(simd, self.field.position, groups[1], parts[1], second, count);
                    let ends = [first[0] - second[0], first[1] - second[1]];
                    let lost = string_below(simd, ends, limit).and(intact);
                    if lost.any() {
                        tell(lost, number, count, irregular);
                    }
                }
                Contact::Tips { first, second } => {
                    let [first] = places(simd, self.field.position, groups[0], parts[0], [first], count);
                    let [second] = places(simd, self.field.position, groups[1], parts[1], [second], count);
                    let lost = (first - second).squared().is_below(limit).and(intact);
                    if lost.any() {
                        tell(lost, number, count, irregular);
                    }
                }
            }
        }
    }

    /// Gives each side its half of what bonds hold.
    #[inline(always)]
    fn hold<L: Simd>(
        &mut self,
        simd: L,
        held: Held<L, MEASURED>,
        intact: Mask<L>,
        parts: [usize; 2],
        is_mine: [bool; 2],
        count: usize,
    ) {
        let held = held.where_or(intact, Held::new(simd));
        for (part, is_mine) in parts.into_iter().zip(is_mine) {
            if is_mine {
                held.add_half_to(&mut self.held, part - self.tile.elements.start, count);
            }
        }
    }
}

/// Places of the same corners of parts side by side.
#[inline(always)]
pub fn places<L: Simd, const N: usize>(
    simd: L,
    position: &[Vec<f64>; 3],
    group: &Group,
    element: usize,
    corners: [u8; N],
    count: usize,
) -> [Vector<L>; N] {
    let planes = position.each_ref().map(Vec::as_slice);
    let mut places = [Vector::zero(simd); N];
    for (place, corner) in places.iter_mut().zip(corners) {
        *place = Vector::load(simd, planes, group.node(element, usize::from(corner)), count);
    }
    places
}

/// Notes which of so many interfaces from a number on are lost.
#[inline(always)]
fn tell<L: Simd>(lost: Mask<L>, number: usize, count: usize, irregular: &mut Vec<u32>) {
    let answers = lost.answers();
    irregular.extend(
        (0..count)
            .filter(|&lane| answers[lane])
            .map(|lane| (number + lane) as u32),
    );
}

#[inline(always)]
fn where_intact<L: Simd, const N: usize>(simd: L, forces: [Vector<L>; N], intact: Mask<L>) -> [Vector<L>; N] {
    let mut kept = forces;
    for force in &mut kept {
        *force = force.where_or(intact, Vector::zero(simd));
    }
    kept
}
