//! The strings of all interfaces, several alike side by side.

use multiversion::multiversion;
use rayon::prelude::*;

use super::interface::{self, IntactLimit, Pair, State, StringForces};
use super::lanes::Lanes;
use super::maps::{MapLanes, Maps};
use super::summation::SampledStrings;
use crate::forces::Planes;
use crate::mesh::Mesh;
use crate::mesh::interfaces::Interfaces;
use crate::potential::{CutPotential, PairShape};

/// Interfaces computed at a time.
const WIDTH: usize = 8;

/// Interfaces in one parallel task; their forces stand in planes of this length.
const BLOCK: usize = 1024;

/// Interfaces of one kind whose triangles have consecutive numbers.
#[derive(Clone, Copy, Debug)]
struct Run {
    kind: u32,
    first: u32,
    second: u32,
    number: u32,
    count: u32,
}

/// Consecutive interfaces, and the forces of their strings.
struct Block {
    runs: Vec<Run>,
    /// For both triangles, x and y of each node, a plane each; empty where no interface of the block has strings.
    planes: Vec<f64>,
}

/// The forces that intact interfaces put on their triangles.
pub struct IntactForces {
    blocks: Vec<Block>,
    /// Where each triangle's entries start, and the length at the end.
    start: Vec<u32>,
    /// Interfaces with strings of each triangle, by the number of the neighbour; the lowest bit says that the triangle is
    /// the second of the two.
    of_triangle: Vec<u32>,
}

/// What the sums are taken over.
pub struct Field<'a, S> {
    pub law: &'a CutPotential<S>,
    pub limit: IntactLimit,
    pub mesh: &'a Mesh,
    pub interfaces: &'a Interfaces,
    pub strings: &'a SampledStrings,
    pub states: &'a [State],
    pub maps: &'a Maps,
    pub position: &'a Planes,
}

impl IntactForces {
    pub fn new(interfaces: &Interfaces, strings: &SampledStrings) -> Self {
        let blocks = interfaces.pairs.chunks(BLOCK).enumerate().map(|(block, pairs)| {
            let mut runs: Vec<Run> = Vec::new();
            for (k, pair) in pairs.iter().enumerate() {
                let next = |run: &Run| [run.kind, run.first + run.count, run.second + run.count];
                match runs
                    .last_mut()
                    .filter(|run| next(run) == [pair.kind, pair.first, pair.second])
                {
                    Some(run) => run.count += 1,
                    None => runs.push(Run {
                        kind: pair.kind,
                        first: pair.first,
                        second: pair.second,
                        number: (block * BLOCK + k) as u32,
                        count: 1,
                    }),
                }
            }
            let has_strings = runs.iter().any(|run| strings.are_there(run.kind));
            let planes = if has_strings { vec![0.0; 12 * BLOCK] } else { Vec::new() };
            Block { runs, planes }
        });
        let mut forces = Self {
            blocks: blocks.collect(),
            start: vec![0],
            of_triangle: Vec::new(),
        };
        for triangle in 0..interfaces.exposed.len() {
            for &number in interfaces.of(triangle) {
                let pair = interfaces.pairs[number as usize];
                if strings.are_there(pair.kind) {
                    forces
                        .of_triangle
                        .push(2 * number + u32::from(pair.second as usize == triangle));
                }
            }
            forces.start.push(forces.of_triangle.len() as u32);
        }
        forces
    }

    /// Sums the strings of all interfaces that are not open; returns those that loosen or open, with their new state.
    pub fn sum<S: PairShape>(&mut self, field: &Field<S>) -> Vec<(usize, State)> {
        let blocks = self.blocks.par_iter_mut();
        blocks.flat_map_iter(|block| sum_block(field, block)).collect()
    }

    /// Adds what the interfaces of a triangle put on its nodes, x and y of each, by the number of the neighbour.
    #[inline(always)]
    pub fn add_to(&self, triangle: usize, nodal: &mut [f64; 6]) {
        for &entry in &self.of_triangle[self.start[triangle] as usize..self.start[triangle + 1] as usize] {
            let interface = (entry >> 1) as usize;
            let side = 6 * (entry & 1) as usize;
            let planes = &self.blocks[interface / BLOCK].planes;
            let place = side * BLOCK + interface % BLOCK;
            (0..6).for_each(|k| nodal[k] += planes[place + k * BLOCK]);
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
fn sum_block<S: PairShape>(field: &Field<S>, block: &mut Block) -> Vec<(usize, State)> {
    let mut changed = Vec::new();
    let Block { runs, planes } = block;
    for run in runs.iter() {
        let mut at = 0;
        while at < run.count {
            if run.count >= WIDTH as u32 {
                // The last ones of a run are computed with some of those before them once more.
                let from = at.min(run.count - WIDTH as u32);
                sum_lanes::<S, WIDTH>(field, run, from, planes, &mut changed);
                at += WIDTH as u32;
            } else {
                sum_lanes::<S, 1>(field, run, at, planes, &mut changed);
                at += 1;
            }
        }
    }
    changed
}

/// Some consecutive interfaces of a run.
#[inline(always)]
fn sum_lanes<S: PairShape, const W: usize>(
    field: &Field<S>,
    run: &Run,
    from: u32,
    planes: &mut [f64],
    changed: &mut Vec<(usize, State)>,
) {
    let number = (run.number + from) as usize;
    let first: MapLanes<W> = field.maps.lanes((run.first + from) as usize);
    let second: MapLanes<W> = field.maps.lanes((run.second + from) as usize);
    let kind = &field.interfaces.kinds[run.kind as usize];
    let squared_gap = interface::squared_gap(kind, &first, &second);
    let is_tight = match &field.limit.quick {
        None => false,
        Some(quick) => {
            let spacing = field.limit.spacing;
            let gradients = [
                first.deformation_gradient(kind.elements[0].sign, spacing),
                second.deformation_gradient(kind.elements[1].sign, spacing),
            ];
            quick.holds(gradients, squared_gap)
        }
    };
    let mut open = [false; W];
    for (lane, open) in open.iter_mut().enumerate() {
        let before = field.states[number + lane];
        *open = before == State::Open;
        if !is_tight && !*open {
            let pair = Pair::new(field.mesh, field.interfaces, number + lane, field.position);
            let state = pair.state(&field.limit, squared_gap[lane].sqrt());
            *open = state == State::Open;
            if state > before {
                changed.push((number + lane, state));
            }
        }
    }
    if !field.strings.are_there(run.kind) {
        return;
    }
    let place = number % BLOCK;
    let limit = field.strings.hardly_open(field.limit.spacing);
    let [all, none] = [
        squared_gap.every(|gap| gap <= limit),
        squared_gap.every(|gap| gap > limit),
    ];
    let mut forces = StringForces::default();
    if all || none {
        let strings = field.strings.of(run.kind, all);
        forces = interface::string_forces(field.law, kind, &first, &second, strings);
    } else {
        for lane in 0..W {
            let strings = field.strings.of(run.kind, squared_gap[lane] <= limit);
            let [one, other] = [first.lane(lane), second.lane(lane)];
            let alone = interface::string_forces::<S, 1>(field.law, kind, &one, &other, strings);
            forces.set_lane(lane, &alone);
        }
    }
    for (plane, values) in forces.0.iter().enumerate() {
        let free = Lanes::<W>::each(|lane| if open[lane] { 0.0 } else { values[lane] });
        free.store(planes, plane * BLOCK + place);
    }
}
