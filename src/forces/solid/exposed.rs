//! Which sites of parts may meet sites of other elements before neighbours are searched again.
//!
//! These are the sites along whatever is open, may open soon, or borders on atoms or parts of another size; of free faces
//! those that are near a part to which no firm interface joins theirs, or near atoms.

use std::collections::HashSet;

use rayon::prelude::*;

use super::Planes;
use super::extents::{Directions, Extents};
use super::grid::Grid;
use crate::domain::Domain;
use crate::mesh::solid::Solid;
use crate::mesh::solid::interfaces::{Interfaces, Side};

/// Parts and sites, ascending.
pub struct Exposed {
    /// Parts that have any side which is free or along which such sites lie.
    pub parts: Vec<u32>,
    /// Each with its part and its local coordinates there.
    pub sites: Vec<(u32, [i32; 3])>,
}

/// What decides.
pub struct Scene<'a> {
    pub mesh: &'a Solid,
    pub interfaces: &'a Interfaces,
    pub position: &'a Planes,
    /// Whose points are sought.
    pub domain: &'a Domain,
    /// Interfaces that are open or may open soon, ascending.
    pub not_firm: &'a [u32],
    /// The radius of the lists, nm.
    pub radius: f64,
}

/// Parts that have a side which is free or along which something else lies.
pub struct Sides {
    /// Ascending.
    pub parts: Vec<u32>,
    /// Each side along which something else lies or may come to lie.
    of_others: Vec<(u32, Side)>,
    /// The free sides of each part that has any.
    free: Vec<(u32, Vec<Side>)>,
}

impl Sides {
    /// Of the whole solid, whatever has moved where.
    pub fn new(interfaces: &Interfaces, not_firm: &[u32]) -> Self {
        let of_pairs = not_firm.iter().flat_map(|&number| {
            let pair = interfaces.pair(number);
            pair.map(|part| (part, interfaces.side(number, part)))
        });
        let lonely = interfaces.lonely.iter().filter(|side| !side.is_free);
        let of_others: Vec<(u32, Side)> = of_pairs.chain(lonely.map(|side| (side.element, side.side))).collect();
        let free: Vec<(u32, Vec<Side>)> = interfaces
            .lonely
            .chunk_by(|one, other| one.element == other.element)
            .filter_map(|of_part| {
                let free = of_part.iter().filter(|side| side.is_free).map(|side| side.side);
                let free: Vec<Side> = free.collect();
                (!free.is_empty()).then_some((of_part[0].element, free))
            })
            .collect();
        let mut parts: Vec<u32> = of_others.iter().map(|side| side.0).collect();
        parts.extend(free.iter().map(|side| side.0));
        parts.sort_unstable();
        parts.dedup();
        Self { parts, of_others, free }
    }

    /// Those of a rank, and those of others that come within a distance of any of these.
    fn near(mut self, scene: &Scene) -> Self {
        let (domain, radius) = (scene.domain, scene.radius);
        if domain.count() == 1 {
            return self;
        }
        let directions = Directions::new(&scene.mesh.sites.frame);
        let is_mine = |part: u32| domain.is_mine(part as usize);
        let extents = |part: u32| extents_of(scene, &directions, part);
        let own = self.parts.iter().filter(|&&part| is_mine(part));
        let own = own.map(|&part| extents(part)).reduce(|all, one| all.and(&one));
        // Atoms of this rank meet the sites of others' parts, too.
        let [_, atoms] = domain.nodes();
        let of_atoms = (!atoms.is_empty()).then(|| {
            let place = |node: usize| scene.position.each_ref().map(|plane| plane[node]);
            Extents::of(&directions, atoms.map(place))
        });
        let own = own.into_iter().chain(of_atoms).reduce(|all, one| all.and(&one));
        let is_near = |part: u32| is_mine(part) || own.is_some_and(|own| !own.are_apart(&extents(part), radius));
        self.parts = self.parts.into_par_iter().filter(|&part| is_near(part)).collect();
        let is_kept = |part: u32| self.parts.binary_search(&part).is_ok();
        self.of_others.retain(|side| is_kept(side.0));
        self.free.retain(|side| is_kept(side.0));
        self
    }
}

impl Exposed {
    /// What may meet the sites of a rank, and these, among the sides of the whole solid, whose places must be known.
    pub fn new(scene: &Scene, sides: Sides) -> Self {
        let Scene { mesh, interfaces, .. } = *scene;
        let Sides {
            parts,
            of_others: mut sides,
            free,
        } = sides.near(scene);
        let neighbourhood = Neighbourhood::new(scene, &parts);
        let near: Vec<Vec<(u32, [i32; 3])>> = free
            .par_iter()
            .map(|(part, sides)| neighbourhood.near_others(scene, *part, sides))
            .collect();
        sides.sort_unstable_by_key(|&(part, side)| (part, side.border, side.is_second));
        let along = sides.iter().flat_map(|&(part, side)| {
            let locals = interfaces.facing(mesh.elements[part as usize], side);
            locals.iter().map(move |&local| (part, local))
        });
        let mut sites: Vec<(u32, [i32; 3])> = along.chain(near.into_iter().flatten()).collect();
        sites.par_sort_unstable_by_key(|&(part, [p, q, r])| (part, r, q, p));
        sites.dedup();
        Self { parts, sites }
    }
}

fn extents_of(scene: &Scene, directions: &Directions, part: u32) -> Extents {
    let nodes = scene.mesh.nodes_of(part as usize);
    let places = nodes.map(|node| scene.position.each_ref().map(|plane| plane[node]));
    Extents::of(directions, places)
}

/// Where parts are, and atoms.
struct Neighbourhood<'a> {
    parts: &'a [u32],
    directions: Directions,
    extents: Vec<Extents>,
    grid: Grid,
    /// As wide as the widest part and the radius.
    width: f64,
    with_atoms: HashSet<[i32; 3]>,
}

impl<'a> Neighbourhood<'a> {
    fn new(scene: &Scene, parts: &'a [u32]) -> Self {
        let Scene { mesh, position, .. } = *scene;
        let directions = Directions::new(&mesh.sites.frame);
        let of_part = |&part: &u32| extents_of(scene, &directions, part);
        let extents: Vec<Extents> = parts.par_iter().map(of_part).collect();
        let cubes: Vec<([f64; 3], f64)> = extents.iter().map(Extents::cube).collect();
        let width = scene.radius + cubes.iter().fold(0.0, |widest, cube| f64::max(widest, cube.1));
        let middles: Vec<[f64; 3]> = cubes.into_iter().map(|cube| cube.0).collect();
        let mut with_atoms = HashSet::new();
        if !parts.is_empty() {
            let mut last = None;
            for atom in mesh.part_nodes()..mesh.node_count() {
                let cell = cell(position.each_ref().map(|plane| plane[atom]), width);
                if last.replace(cell) != Some(cell) {
                    with_atoms.insert(cell);
                }
            }
        }
        Self {
            grid: Grid::new(&middles, |_| true, width),
            parts,
            directions,
            extents,
            width,
            with_atoms,
        }
    }

    /// The sites along free sides of a part that are near others.
    fn near_others(&self, scene: &Scene, part: u32, sides: &[Side]) -> Vec<(u32, [i32; 3])> {
        let number = self.parts.partition_point(|&other| other < part);
        let (own, radius) = (&self.extents[number], scene.radius);
        let (middle, _) = own.cube();
        let [x, y, z] = cell(middle, self.width);
        let has_atoms = (x - 1..=x + 1)
            .any(|x| (y - 1..=y + 1).any(|y| (z - 1..=z + 1).any(|z| self.with_atoms.contains(&[x, y, z]))));
        let firm = scene
            .interfaces
            .of(part as usize)
            .iter()
            .filter(|number| scene.not_firm.binary_search(number).is_err());
        let joined: Vec<u32> = firm.flat_map(|&number| scene.interfaces.pair(number)).collect();
        let mut near = Vec::new();
        self.grid.near(middle, |other| {
            let extents = &self.extents[other as usize];
            if !own.are_apart(extents, radius) {
                let other = self.parts[other as usize];
                let is_wanted = scene.domain.is_mine(part as usize) || scene.domain.is_mine(other as usize);
                if is_wanted && other != part && !joined.contains(&other) {
                    near.push(extents);
                }
            }
        });
        if near.is_empty() && !has_atoms {
            return Vec::new();
        }
        let element = scene.mesh.elements[part as usize];
        let locals = sides
            .iter()
            .flat_map(|&side| scene.interfaces.facing(element, side).iter().copied());
        let is_near = |local: &[i32; 3]| {
            let mut place = [0.0; 3];
            for (node, weight) in scene.mesh.carriers(part as usize, *local) {
                (0..3).for_each(|axis| place[axis] += weight * scene.position[axis][node]);
            }
            near.iter().any(|near| near.is_near(&self.directions, place, radius))
        };
        locals
            .filter(|local| has_atoms || is_near(local))
            .map(|local| (part, local))
            .collect()
    }
}

fn cell(place: [f64; 3], width: f64) -> [i32; 3] {
    place.map(|component| (component / width).floor() as i32)
}
