//! Neighbour search on a grid of cells.

use rayon::prelude::*;

use super::super::affine::site_position;
use super::super::interface::State;
use super::super::summation::Summation;
use super::super::{CHUNK, Planes};
use super::{Contacts, Partner};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::mesh::interfaces::Interfaces;

/// What decides which pairs belong to the search.
pub struct Field<'a> {
    pub mesh: &'a Mesh,
    pub interfaces: &'a Interfaces,
    pub states: &'a [State],
    pub summation: Summation,
}

impl Field<'_> {
    /// Triangles that may meet something other than their intact neighbours.
    fn searched(&self) -> Vec<bool> {
        let mut searched = self.interfaces.exposed.clone();
        let disturbed = self
            .interfaces
            .pairs
            .iter()
            .zip(self.states)
            .filter(|&(_, &state)| state != State::Tight);
        for (pair, _) in disturbed {
            searched[pair.first as usize] = true;
            searched[pair.second as usize] = true;
        }
        searched
    }

    /// Whether pairs of sites of these elements are summed elsewhere: inside a triangle or along intact strings.
    fn summed_elsewhere(&self, a: u32, b: u32) -> bool {
        let [a, b] = [a as usize, b as usize];
        if a == b {
            return true;
        }
        let triangles = self.mesh.triangles;
        a < triangles
            && b < triangles
            && self
                .interfaces
                .between(a, b)
                .is_some_and(|interface| self.states[interface] != State::Open)
    }
}

/// Sites that may have partners.
struct Candidates {
    element: Vec<u32>,
    local: Vec<[i16; 2]>,
    position: Vec<[f64; 2]>,
}

impl Contacts {
    /// Lists the partners of every site at these positions.
    pub fn search(field: &Field, material: &Material, position: &Planes) -> Self {
        let skin = Self::SKIN * material.spacing;
        let radius = material.interaction.cutoff() + skin;
        let searched = field.searched();
        let candidates = Candidates::new(field.mesh, &searched, position);
        let grid = Grid::new(&candidates.position, radius);
        let lists = candidates.partner_lists(field, &grid, radius);
        let mut contacts = Self::from_lists(field.mesh, candidates, lists);
        contacts.weigh_sites(field);
        contacts.half_skin = 0.5 * skin;
        contacts.spacing = material.spacing;
        contacts.reference = position.clone();
        contacts.searched = searched;
        contacts
    }

    fn weigh_sites(&mut self, field: &Field) {
        if field.summation == Summation::Nodal {
            let sites = self.element.iter().zip(&self.local);
            let weight = sites.map(|(&element, &local)| {
                let element = &field.mesh.elements[element as usize];
                field.summation.site_weight(element, local.map(i32::from))
            });
            self.weight = weight.collect();
        }
    }

    /// Keeps the sites that have partners and numbers them anew.
    fn from_lists(mesh: &Mesh, candidates: Candidates, lists: Vec<(Vec<u32>, Vec<Partner>)>) -> Self {
        let counts: Vec<u32> = lists.iter().flat_map(|(counts, _)| counts.iter().copied()).collect();
        let mut number = vec![u32::MAX; counts.len()];
        let mut contacts = Self {
            start: vec![0],
            of_element: vec![0; mesh.elements.len() + 1],
            ..Self::default()
        };
        for (candidate, &count) in counts.iter().enumerate().filter(|&(_, &count)| count > 0) {
            number[candidate] = contacts.element.len() as u32;
            contacts.element.push(candidates.element[candidate]);
            contacts.local.push(candidates.local[candidate]);
            contacts.start.push(contacts.start[contacts.start.len() - 1] + count);
            contacts.of_element[candidates.element[candidate] as usize + 1] += 1;
        }
        for element in 0..mesh.elements.len() {
            contacts.of_element[element + 1] += contacts.of_element[element];
        }
        let partners = lists.into_iter().flat_map(|(_, partners)| partners);
        let renumbered = partners.map(|partner| Partner::new(number[partner.site()] as usize, partner.severed()));
        contacts.partners = renumbered.collect();
        contacts
    }
}

impl Candidates {
    fn new(mesh: &Mesh, searched: &[bool], position: &Planes) -> Self {
        let mut element = Vec::new();
        let mut local = Vec::new();
        let triangles = (0..mesh.triangles).filter(|&triangle| searched[triangle]);
        for number in triangles.chain(mesh.triangles..mesh.elements.len()) {
            for [p, q] in mesh.elements[number].locals() {
                element.push(number as u32);
                local.push([p as i16, q as i16]);
            }
        }
        let place = |(&element, local): (&u32, &[i16; 2])| {
            site_position(mesh, element as usize, local.map(i32::from), position)
        };
        let position = element.par_iter().zip(&local).map(place).collect();
        Self {
            element,
            local,
            position,
        }
    }

    /// For every chunk of sites the number of partners of each and the partners, ascending.
    fn partner_lists(&self, field: &Field, grid: &Grid, radius: f64) -> Vec<(Vec<u32>, Vec<Partner>)> {
        let chunks = self.element.len().div_ceil(CHUNK);
        let list = |chunk: usize| {
            let mut counts = Vec::with_capacity(CHUNK);
            let mut partners = Vec::with_capacity(8 * CHUNK);
            for site in chunk * CHUNK..self.element.len().min((chunk + 1) * CHUNK) {
                let first = partners.len();
                self.collect_partners(field, grid, radius, site, &mut partners);
                partners[first..].sort_unstable_by_key(|partner| partner.site());
                counts.push((partners.len() - first) as u32);
            }
            (counts, partners)
        };
        (0..chunks).into_par_iter().map(list).collect()
    }

    fn collect_partners(&self, field: &Field, grid: &Grid, radius: f64, site: usize, partners: &mut Vec<Partner>) {
        let [x, y] = self.position[site];
        let limit = radius * radius;
        grid.for_each_near([x, y], |other| {
            let [dx, dy] = [self.position[other][0] - x, self.position[other][1] - y];
            if dx * dx + dy * dy < limit && !field.summed_elsewhere(self.element[site], self.element[other]) {
                let [a, b] = [site, other].map(|k| {
                    let element = &field.mesh.elements[self.element[k] as usize];
                    element.site(self.local[k].map(i32::from))
                });
                partners.push(Partner::new(other, field.mesh.severed(a, b)));
            }
        });
    }
}

/// Points sorted into square cells no smaller than the search radius.
struct Grid {
    origin: [f64; 2],
    cell: f64,
    size: [usize; 2],
    /// Where each cell's points start, and the total at the end.
    start: Vec<u32>,
    points: Vec<u32>,
}

impl Grid {
    fn new(position: &[[f64; 2]], radius: f64) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for place in position {
            for axis in 0..2 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
        }
        let extent = [0, 1].map(|axis| (high[axis] - low[axis]).max(0.0));
        // Fragments that fly far apart must not make more cells than there are points.
        let fitting = (extent[0] * extent[1] / position.len().max(1) as f64).sqrt();
        let longest = extent[0].max(extent[1]) / (position.len().max(1) as f64);
        let cell = radius.max(0.5 * fitting).max(longest);
        let size = extent.map(|length| (length / cell) as usize + 1);
        let mut grid = Self {
            origin: low,
            cell,
            size,
            start: vec![0; size[0] * size[1] + 1],
            points: vec![],
        };
        let cells: Vec<u32> = position
            .iter()
            .map(|&place| grid.number(grid.cell_of(place)) as u32)
            .collect();
        cells.iter().for_each(|&cell| grid.start[cell as usize + 1] += 1);
        for cell in 0..size[0] * size[1] {
            grid.start[cell + 1] += grid.start[cell];
        }
        let mut next = grid.start.clone();
        grid.points = vec![0; position.len()];
        for (point, &cell) in cells.iter().enumerate() {
            grid.points[next[cell as usize] as usize] = point as u32;
            next[cell as usize] += 1;
        }
        grid
    }

    fn cell_of(&self, place: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|axis| (((place[axis] - self.origin[axis]) / self.cell) as usize).min(self.size[axis] - 1))
    }

    fn number(&self, [column, row]: [usize; 2]) -> usize {
        row * self.size[0] + column
    }

    /// Calls with every point in the cell of a place and in the cells around it.
    #[inline(always)]
    fn for_each_near(&self, place: [f64; 2], mut call: impl FnMut(usize)) {
        let [column, row] = self.cell_of(place);
        let columns = [column.saturating_sub(1), (column + 1).min(self.size[0] - 1)];
        for row in row.saturating_sub(1)..=(row + 1).min(self.size[1] - 1) {
            let first = self.start[self.number([columns[0], row])] as usize;
            let last = self.start[self.number([columns[1], row]) + 1] as usize;
            self.points[first..last].iter().for_each(|&point| call(point as usize));
        }
    }
}
