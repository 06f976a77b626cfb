//! What some triangles border on, and what everybody must know of it to number all interfaces alike.

use std::collections::HashMap;
use std::ops::Range;

use super::neighbours;
use super::{Interface, InterfaceKind, REACH, rows};
use crate::lattice::triangular;
use crate::mesh::Mesh;
use crate::mesh::element::Element;

/// Two triangles and where the second lies, seen from the first: size and sign of both, columns and rows between their anchors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Kind(pub [i32; 6]);

/// What is to be known of the neighbours of all triangles, or of some.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Told {
    /// The kinds of interfaces in the order in which they are met, triangle by triangle.
    pub kinds: Vec<Kind>,
    /// Triangles that border an atom or a free surface or a cut, ascending.
    pub exposed: Vec<u32>,
    /// How many interfaces start at the triangles of each row, with strings and without.
    pub counts: Vec<[f64; 2]>,
}

/// The neighbours of consecutive triangles.
pub struct Survey {
    triangles: Range<usize>,
    /// By the first triangle, then by the second.
    found: Vec<Interface>,
    told: Told,
    bonds: Vec<[i32; 2]>,
    around: Vec<[i32; 2]>,
    numbers: HashMap<Kind, u32>,
    surroundings: HashMap<(i32, i32), Vec<[i32; 2]>>,
}

impl Kind {
    fn between(first: &Element, second: &Element) -> Self {
        let [columns, rows] = [second.column - first.column, second.row - first.row];
        Self([first.size, first.sign, second.size, second.sign, columns, rows])
    }

    /// With the strings of these bonds.
    pub fn in_full(self, bonds: &[[i32; 2]]) -> InterfaceKind {
        let Self([size, sign, other_size, other_sign, column, row]) = self;
        let first = Element {
            size,
            sign,
            column: 0,
            row: 0,
        };
        let second = Element {
            size: other_size,
            sign: other_sign,
            column,
            row,
        };
        InterfaceKind::between(&first, &second, bonds)
    }
}

impl Told {
    /// What surveys of triangles that follow each other, and are all that there are, have told.
    pub fn joined(parts: &[Self]) -> Self {
        let kinds = parts.iter().flat_map(|part| part.kinds.iter().copied());
        let exposed = parts.iter().flat_map(|part| part.exposed.iter().copied());
        let mut counts = vec![[0.0; 2]; parts.first().map_or(0, |part| part.counts.len())];
        for part in parts {
            for (sum, of_part) in counts.iter_mut().zip(&part.counts) {
                (0..2).for_each(|half| sum[half] += of_part[half]);
            }
        }
        Self {
            exposed: exposed.collect(),
            counts,
            kinds: Vec::new(),
        }
        .with_kinds(kinds)
    }

    /// The same with these kinds, each once and where it is first met.
    pub fn with_kinds(self, kinds: impl Iterator<Item = Kind>) -> Self {
        let mut known: HashMap<Kind, ()> = HashMap::new();
        let kinds = kinds.filter(|&kind| known.insert(kind, ()).is_none()).collect();
        Self { kinds, ..self }
    }
}

impl Survey {
    /// Of consecutive triangles, with strings of bonds no longer than `bond_length` spacings.
    pub fn new(mesh: &Mesh, bond_length: f64, triangles: Range<usize>) -> Self {
        let mut survey = Self {
            triangles: triangles.clone(),
            found: Vec::new(),
            told: Told::default(),
            bonds: triangular::vectors_within(bond_length),
            around: triangular::vectors_within(REACH.max(bond_length)),
            numbers: HashMap::new(),
            surroundings: HashMap::new(),
        };
        let mut found = Vec::new();
        for triangle in triangles {
            if survey.look_at(mesh, triangle, &mut found) {
                survey.told.exposed.push(triangle as u32);
            }
        }
        let has_strings: Vec<bool> = {
            let kinds = survey.told.kinds.iter();
            kinds
                .map(|kind| !kind.in_full(&survey.bonds).strings.is_empty())
                .collect()
        };
        let starts = rows(mesh);
        let mut counts = vec![[0.0; 2]; starts.len()];
        let mut row = 0;
        for pair in &found {
            while starts[row].end <= pair.first as usize {
                row += 1;
            }
            counts[row][usize::from(!has_strings[pair.kind as usize])] += 1.0;
        }
        survey.told.counts = counts;
        survey.found = found;
        survey
    }

    /// What it tells others.
    pub fn tell(&mut self) -> Told {
        std::mem::take(&mut self.told)
    }

    /// Bonds of strings.
    pub(super) fn bonds(&self) -> &[[i32; 2]] {
        &self.bonds
    }

    /// How many lattice rows apart neighbours may be.
    pub(super) fn reach(&self) -> i32 {
        self.around.iter().map(|vector| vector[1]).max().unwrap_or(0)
    }

    /// Numbers kinds as they are in the whole mesh.
    pub(super) fn know(&mut self, kinds: &[Kind]) {
        let numbers: HashMap<Kind, u32> = kinds.iter().copied().zip(0..).collect();
        let mut own = vec![0; self.numbers.len()];
        for (kind, &number) in &self.numbers {
            own[number as usize] = numbers[kind];
        }
        self.found
            .iter_mut()
            .for_each(|pair| pair.kind = own[pair.kind as usize]);
        self.numbers = numbers;
    }

    /// Adds the interfaces that start at some consecutive triangles, by the first and then by the second triangle.
    pub(super) fn pairs_of(&mut self, mesh: &Mesh, triangles: Range<usize>, pairs: &mut Vec<Interface>) {
        let known = triangles.start.max(self.triangles.start)..triangles.end.min(self.triangles.end);
        if known.is_empty() {
            for triangle in triangles {
                self.look_at(mesh, triangle, pairs);
            }
            return;
        }
        for triangle in triangles.start..known.start {
            self.look_at(mesh, triangle, pairs);
        }
        let before = |end: usize| self.found.partition_point(|pair| (pair.first as usize) < end);
        pairs.extend_from_slice(&self.found[before(known.start)..before(known.end)]);
        for triangle in known.end..triangles.end {
            self.look_at(mesh, triangle, pairs);
        }
    }

    /// Adds the interfaces of a triangle with later ones; returns whether it is exposed.
    fn look_at(&mut self, mesh: &Mesh, number: usize, pairs: &mut Vec<Interface>) -> bool {
        let element = &mesh.elements[number];
        let around = &self.around;
        let shape = (element.size, element.sign);
        let surrounding = self
            .surroundings
            .entry(shape)
            .or_insert_with(|| neighbours::surrounding(element, around));
        let mut near = Vec::new();
        let borders_others = neighbours::collect(mesh, element, surrounding, &mut near);
        for &other in near.iter().filter(|&&other| other as usize > number) {
            let second = &mesh.elements[other as usize];
            let kind = Kind::between(element, second);
            let next = self.numbers.len() as u32;
            let kind = *self.numbers.entry(kind).or_insert_with(|| {
                self.told.kinds.push(kind);
                next
            });
            pairs.push(Interface {
                first: number as u32,
                second: other,
                kind,
                severed: neighbours::is_severed(mesh, element, second, around),
            });
        }
        borders_others || neighbours::borders_cut(mesh, element, around)
    }
}
