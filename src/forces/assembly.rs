//! Adds up bulk, interfaces and contacts on the nodes, element by element.

use multiversion::multiversion;
use rayon::prelude::*;

use super::affine::Affine;
use super::bulk::{self, Reach};
use super::lanes::Lanes;
use super::maps::MapLanes;
use super::{CHUNK, Forces, Planes};
use crate::potential::{CutPotential, PairShape};

/// Triangles computed at a time.
const WIDTH: usize = 8;

/// Forces on all nodes. Interfaces and contacts must be summed already.
pub fn assemble<S: PairShape>(forces: &Forces, law: &CutPotential<S>, position: &Planes, force: &mut Planes) {
    let triangles = forces.mesh.triangles;
    let [force_x, force_y] = force;
    let (triangle_x, atom_x) = force_x.split_at_mut(3 * triangles);
    let (triangle_y, atom_y) = force_y.split_at_mut(3 * triangles);
    let planes = triangle_x
        .par_chunks_mut(3 * CHUNK)
        .zip(triangle_y.par_chunks_mut(3 * CHUNK));
    planes
        .enumerate()
        .for_each(|(chunk, (x, y))| triangle_forces(forces, law, position, chunk * CHUNK, x, y));
    let planes = atom_x.par_chunks_mut(CHUNK).zip(atom_y.par_chunks_mut(CHUNK));
    planes.enumerate().for_each(|(chunk, (x, y))| {
        for k in 0..x.len() {
            let element = triangles + chunk * CHUNK + k;
            let sites = forces.contacts.sites_of(element);
            [x[k], y[k]] = if sites.is_empty() {
                [0.0, 0.0]
            } else {
                forces.contacts.force_on(sites.start)
            };
        }
    });
}

/// Forces on the nodes of consecutive triangles, from the one with this number on.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+avx2+fma", "x86_64+avx2+fma"))]
fn triangle_forces<S: PairShape>(
    forces: &Forces,
    law: &CutPotential<S>,
    position: &Planes,
    from: usize,
    x: &mut [f64],
    y: &mut [f64],
) {
    let count = x.len() / 3;
    let size = |k: usize| forces.mesh.elements[from + k].size;
    let mut at = 0;
    while at < count {
        if at + WIDTH <= count && size(at) == size(at + WIDTH - 1) {
            let bulk = bulk_lanes::<S, WIDTH>(forces, law, position, from + at);
            for lane in 0..WIDTH {
                let nodal = bulk.map(|component| component[lane]);
                store(forces, from + at + lane, nodal, at + lane, x, y);
            }
            at += WIDTH;
        } else {
            let bulk = bulk_lanes::<S, 1>(forces, law, position, from + at);
            store(forces, from + at, bulk.map(|component| component[0]), at, x, y);
            at += 1;
        }
    }
}

/// Adds to the bulk forces of a triangle those of its interfaces and contacts.
#[inline(always)]
fn store(forces: &Forces, triangle: usize, mut nodal: [f64; 6], at: usize, x: &mut [f64], y: &mut [f64]) {
    forces.intact.add_to(triangle, &mut nodal);
    for site in forces.contacts.sites_of(triangle) {
        let weights = forces.mesh.elements[triangle].shape_functions(forces.contacts.local(site));
        let force = forces.contacts.force_on(site);
        for node in 0..3 {
            (0..2).for_each(|axis| nodal[2 * node + axis] += weights[node] * force[axis]);
        }
    }
    for node in 0..3 {
        x[3 * at + node] = nodal[2 * node];
        y[3 * at + node] = nodal[2 * node + 1];
    }
}

#[inline(always)]
fn bulk_lanes<S: PairShape, const W: usize>(
    forces: &Forces,
    law: &CutPotential<S>,
    position: &Planes,
    from: usize,
) -> [Lanes<W>; 6] {
    let size = forces.mesh.elements[from].size;
    let map: MapLanes<W> = forces.maps.lanes(from);
    let reach = Reach {
        cutoff: law.cutoff(),
        spacing: forces.material.spacing,
    };
    if let Some(bonds) = forces.bulk.within_all(size, &map, &reach) {
        return bulk::force(law, size, &map, bonds);
    }
    let mut all = [Lanes::default(); 6];
    for lane in 0..W {
        let affine = Affine::of_triangle(size, forces.mesh.first_node(from + lane), position);
        let bonds = forces.bulk.within(size, &affine, reach.spacing, reach.cutoff);
        let alone = bulk::force::<S, 1>(law, size, &map.lane(lane), bonds);
        (0..6).for_each(|component| all[component].0[lane] = alone[component][0]);
    }
    all
}
