//! Which faces and bonds of a solid have opened or slid.

use std::cmp::Ordering;
use std::collections::HashMap;

use rayon::prelude::*;

use super::nearby::Nearby;
use super::{FAMILIES, How, Parted};
use crate::mesh::solid::Solid;
use crate::mesh::solid::bonds::{self, Bonds, End, place_of};
use crate::mesh::solid::interfaces::Interfaces;
use crate::mesh::solid::sites::Frame;
use crate::mesh::solid::template::{BORDERS, Contact};

/// Distance along a {111} plane of a site from those above it, squared, in spacings squared.
const ASIDE_SQUARED: f64 = 1.0 / 3.0;

/// Length of a partial dislocation's Burgers vector, a/6 <112>, spacings.
const PARTIAL: f64 = 0.577_350_269_189_625_8;

/// Two neighbours have lost so many others between them where a surface has opened: three each on a {111} plane, two each along
/// its sides. At the steps that slip leaves on a surface, and in the core of a dislocation, they lose fewer.
const LOST_BY_BOTH: i32 = 4;

/// Between first and second neighbours, spacings: how far what counts as a neighbour is.
const NEIGHBOUR: f64 = 1.207_106_781_186_547_5;

/// Open bonds so near tell in which plane one of them lies, spacings.
const AROUND: f64 = 2.5;

/// All that may open or slide in a solid: what a cut severs is not among it.
pub struct Joints<'a> {
    mesh: &'a Solid,
    /// Distance beyond which a bond of nearest neighbours is broken, nm.
    breaking_length: f64,
    faces: Vec<Face>,
    bonds: Bonds,
    /// Sites of parts at which single bonds end, by their number after those of the atoms.
    of_parts: Vec<End>,
    /// The single bonds of these.
    pairs: Vec<[u32; 2]>,
    /// How many single bonds end at each site.
    neighbours: Vec<u8>,
}

/// A tetrahedron and an octahedron along a face.
struct Face {
    /// Corners opposite to each other.
    nodes: [[u32; 3]; 2],
    size: i32,
    family: usize,
    /// Middle at rest, nm.
    middle: [f64; 3],
}

impl<'a> Joints<'a> {
    /// `breaking_length` is the distance beyond which a bond of nearest neighbours is broken, nm.
    pub fn new(mesh: &'a Solid, breaking_length: f64) -> Self {
        let interfaces = Interfaces::new(mesh, breaking_length / mesh.spacing);
        let bonds = Bonds::new(mesh, &interfaces.beside_others());
        let atoms = bonds.atom_count();
        let mut numbers: HashMap<End, u32> = HashMap::new();
        let mut of_parts = Vec::new();
        let mut number = |end: End| match (end.0 as usize).checked_sub(mesh.parts) {
            Some(atom) => atom as u32,
            None => *numbers.entry(end).or_insert_with(|| {
                of_parts.push(end);
                (atoms + of_parts.len() - 1) as u32
            }),
        };
        let site = |end: End| mesh.elements[end.0 as usize].site(end.1);
        let of_parts_bonds = bonds.of_parts.iter();
        let whole = of_parts_bonds.filter(|[a, b]| !mesh.sites.severs(site(*a), site(*b)));
        let pairs: Vec<[u32; 2]> = whole.map(|ends| ends.map(&mut number)).collect();
        let mut neighbours = vec![0; atoms + of_parts.len()];
        let between_atoms = (0..atoms).flat_map(|atom| bonds.of_atom(atom).map(move |(_, other)| [atom as u32, other]));
        let anchor = |atom: u32| mesh.elements[mesh.parts + atom as usize].anchor;
        let between_atoms = between_atoms.filter(|&[a, b]| !mesh.sites.severs(anchor(a), anchor(b)));
        let ends = between_atoms.chain(pairs.iter().copied()).flatten();
        ends.for_each(|site| neighbours[site as usize] += 1);
        Self {
            faces: faces(mesh, &interfaces),
            mesh,
            breaking_length,
            bonds,
            of_parts,
            pairs,
            neighbours,
        }
    }

    /// The pieces that have parted with the nodes at these places: faces, then bonds, in the order of the mesh.
    pub fn parted(&self, position: &[Vec<f64>; 3]) -> Vec<Parted> {
        let mut parted: Vec<Parted> = self
            .faces
            .par_iter()
            .filter_map(|face| self.state_of_face(face, position))
            .collect();
        parted.extend(self.parted_bonds(position));
        parted
    }

    fn state_of_face(&self, face: &Face, position: &[Vec<f64>; 3]) -> Option<Parted> {
        let spacing = self.mesh.spacing;
        let at = |node: u32| position.each_ref().map(|plane| plane[node as usize]);
        let [tetrahedron, octahedron] = face.nodes.map(|nodes| nodes.map(at));
        // The middles of the two faces lie one above the other, a layer apart.
        let apart = minus(middle(octahedron), middle(tetrahedron));
        let [a, b, c] = tetrahedron;
        let normal = cross(minus(b, a), minus(c, a));
        let length = dot(normal, normal).sqrt();
        let along = dot(apart, normal).abs() / length;
        let slide = (dot(apart, apart) - along * along).max(0.0).sqrt();
        let reach = self.breaking_length / spacing;
        let how = match (along / spacing, slide / spacing) {
            (open, _) if open > (reach * reach - ASIDE_SQUARED).sqrt() => How::Opened,
            (_, slide) if slide > 0.5 * PARTIAL => How::Slid,
            _ => return None,
        };
        let edge = f64::from(face.size) * spacing;
        Some(Parted {
            how,
            middle: face.middle,
            area: 0.25 * 3f64.sqrt() * edge * edge,
            size: face.size,
            family: face.family,
        })
    }

    fn parted_bonds(&self, position: &[Vec<f64>; 3]) -> Vec<Parted> {
        let (atoms, first) = (self.bonds.atom_count(), self.mesh.part_nodes());
        let place = |site: u32| match (site as usize).checked_sub(atoms) {
            None => position.each_ref().map(|plane| plane[first + site as usize]),
            Some(number) => place_of(self.mesh, self.of_parts[number], position),
        };
        let longest = self.breaking_length * self.breaking_length;
        let is_broken = |[a, b]: [u32; 2]| {
            let way = minus(place(a), place(b));
            dot(way, way) > longest
        };
        let of_atom = |atom: usize| {
            let others = self.bonds.of_atom(atom).map(move |(_, other)| [atom as u32, other]);
            let broken = others.filter(|&pair| is_broken(pair) && !self.is_severed(pair));
            broken.collect::<Vec<_>>()
        };
        let mut broken: Vec<[u32; 2]> = (0..atoms).into_par_iter().flat_map_iter(of_atom).collect();
        broken.extend(self.pairs.iter().filter(|&&pair| is_broken(pair)));
        if broken.is_empty() {
            return Vec::new();
        }
        let ends = broken.iter().flatten().map(|&site| place(site));
        let sites = (0..self.neighbours.len() as u32).map(|site| (site, place(site)));
        let radius = NEIGHBOUR * self.mesh.spacing;
        let nearby = Nearby::around(ends, sites, radius);
        let lost = |site: u32| {
            let others = nearby.within(place(site), radius).filter(|&other| other != site);
            let others = others.filter(|&other| !self.have_no_bond(site, other) && !self.is_severed([site, other]));
            i32::from(self.neighbours[site as usize]) - others.count() as i32
        };
        let pieces = broken.par_iter().map(|&ends| {
            let [a, b] = ends;
            let how = match lost(a) + lost(b) >= LOST_BY_BOTH {
                true => How::Opened,
                false => How::Slid,
            };
            Broken::new(how, ends, ends.map(|site| self.site(site)))
        });
        let pieces: Vec<Broken> = pieces.collect();
        in_families(&pieces, &self.mesh.sites.frame, self.mesh.spacing)
    }

    /// Whether two sites are of parts between which there are no single bonds.
    fn have_no_bond(&self, one: u32, other: u32) -> bool {
        let atoms = self.bonds.atom_count();
        let size = |site: u32| {
            let number = (site as usize).checked_sub(atoms)?;
            Some(self.mesh.elements[self.of_parts[number].0 as usize].size)
        };
        size(one).is_some_and(|size_of_one| Some(size_of_one) == size(other))
    }

    fn is_severed(&self, ends: [u32; 2]) -> bool {
        let [a, b] = ends.map(|site| self.site(site));
        self.mesh.sites.severs(a, b)
    }

    /// The lattice site of a number.
    fn site(&self, site: u32) -> [i32; 3] {
        let (element, local) = match (site as usize).checked_sub(self.bonds.atom_count()) {
            None => (self.mesh.parts + site as usize, [0; 3]),
            Some(number) => (self.of_parts[number].0 as usize, self.of_parts[number].1),
        };
        self.mesh.elements[element].site(local)
    }
}

fn faces(mesh: &Solid, interfaces: &Interfaces) -> Vec<Face> {
    let face = |(number, ([first, second], border)): (u32, ([u32; 2], usize))| {
        if interfaces.severed.binary_search(&number).is_ok() && is_severed(mesh, [first, second]) {
            return None;
        }
        let Contact::Face {
            tetrahedron,
            octahedron,
        } = BORDERS[border].contact
        else {
            return None;
        };
        let sides = [(first as usize, tetrahedron), (second as usize, octahedron)];
        let sites = sides.map(|(element, corners)| {
            let all = mesh.elements[element].corners();
            corners.map(|corner| mesh.elements[element].site(all[usize::from(corner)]))
        });
        let places = sites.map(|corners| middle(corners.map(|site| mesh.sites.frame.place(site))));
        let is_constant = |of: fn([i32; 3]) -> i32| sites[0].iter().all(|&site| of(site) == of(sites[0][0]));
        let planes: [fn([i32; 3]) -> i32; FAMILIES] = PLANES;
        Some(Face {
            nodes: sides.map(|(element, corners)| corners.map(|corner| mesh.node(element, usize::from(corner)) as u32)),
            size: mesh.elements[first as usize].size,
            family: planes.into_iter().position(is_constant).unwrap_or_default(),
            middle: [0, 1, 2].map(|axis| 0.5 * (places[0][axis] + places[1][axis])),
        })
    };
    (0..).zip(interfaces.pairs()).filter_map(face).collect()
}

/// Whether a cut severs most of the bonds between two elements.
fn is_severed(mesh: &Solid, [first, second]: [u32; 2]) -> bool {
    let site = |end: End| mesh.elements[end.0 as usize].site(end.1);
    let (mut all, mut severed) = (0, 0);
    for [a, b] in bonds::between(mesh, first, second) {
        all += 1;
        severed += i32::from(mesh.sites.severs(site(a), site(b)));
    }
    2 * severed > all
}

/// What is constant in the planes of each family.
const PLANES: [fn([i32; 3]) -> i32; FAMILIES] = [|[i, _, _]| i, |[_, j, _]| j, |[_, _, k]| k, |[i, j, k]| i + j + k];

/// A bond that is broken.
struct Broken {
    how: How,
    sites: [[i32; 3]; 2],
    /// Of the families whose planes it crosses, two of the four, the number of its end on the lower side.
    low_ends: [Option<u32>; FAMILIES],
}

impl Broken {
    fn new(how: How, ends: [u32; 2], sites: [[i32; 3]; 2]) -> Self {
        let low_end = |of: fn([i32; 3]) -> i32| match of(sites[0]).cmp(&of(sites[1])) {
            Ordering::Less => Some(ends[0]),
            Ordering::Equal => None,
            Ordering::Greater => Some(ends[1]),
        };
        Self {
            how,
            sites,
            low_ends: PLANES.map(low_end),
        }
    }
}

/// A bond crosses two planes; it lies in that of the two which more of the broken bonds around it cross. A site has its area of
/// the plane as soon as one of its bonds across it is broken: slip by one spacing breaks two of three, by a partial one.
fn in_families(pieces: &[Broken], frame: &Frame, spacing: f64) -> Vec<Parted> {
    let area_of_site = 0.5 * 3f64.sqrt() * spacing * spacing;
    let middle = |piece: &Broken| {
        let [one, other] = piece.sites;
        frame.place_between([0, 1, 2].map(|axis| 0.5 * f64::from(one[axis] + other[axis])))
    };
    let middles: Vec<[f64; 3]> = pieces.iter().map(middle).collect();
    let radius = AROUND * spacing;
    let nearby = Nearby::around(middles.iter().copied(), (0..).zip(middles.iter().copied()), radius);
    let family = |(piece, &middle): (&Broken, &[f64; 3])| {
        let mut votes = [0; FAMILIES];
        for other in nearby.within(middle, radius) {
            let other = &pieces[other as usize];
            for (family, vote) in votes.iter_mut().enumerate() {
                let both =
                    other.how == piece.how && other.low_ends[family].is_some() && piece.low_ends[family].is_some();
                *vote += u32::from(both);
            }
        }
        // The first of equals.
        (0..FAMILIES)
            .rev()
            .max_by_key(|&family| votes[family])
            .unwrap_or_default()
    };
    let families: Vec<usize> = pieces.par_iter().zip(&middles).map(family).collect();
    let key = |(piece, &family): (&Broken, &usize)| (piece.low_ends[family], family, piece.how == How::Opened);
    let mut bonds_of_site: HashMap<_, f64> = HashMap::new();
    for piece in pieces.iter().zip(&families) {
        *bonds_of_site.entry(key(piece)).or_default() += 1.0;
    }
    let parted = pieces.iter().zip(&families).zip(middles).map(|(piece, middle)| Parted {
        how: piece.0.how,
        middle,
        area: area_of_site / bonds_of_site[&key(piece)],
        size: 1,
        family: *piece.1,
    });
    parted.collect()
}

pub(super) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| a[axis] - b[axis])
}

pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|i: usize| {
        let [j, k] = [(i + 1) % 3, (i + 2) % 3];
        a[j] * b[k] - a[k] * b[j]
    })
}

fn middle(corners: [[f64; 3]; 3]) -> [f64; 3] {
    [0, 1, 2].map(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>() / 3.0)
}
