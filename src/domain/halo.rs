//! What a rank must know of elements that others compute, and others of its own.

use std::ops::Range;

use super::Domain;
use crate::mesh::grouped::Grouped;

/// Which elements some ranks know beside their own, and the parcels in which others tell them of these.
///
/// In every step those travel that a rank's forces depend on, in each probe those that the first rank reads.
#[derive(Debug, Default)]
pub struct Halo {
    outgoing: Vec<Parcel>,
    incoming: Vec<Parcel>,
    /// Elements of others of which it is told, ascending and all in groups or all atoms in each range.
    elements: Vec<Range<usize>>,
}

/// What one rank sends to another.
#[derive(Debug, Default)]
pub struct Parcel {
    /// The other rank.
    #[cfg_attr(not(feature = "mpi"), expect(dead_code, reason = "without MPI there are no others"))]
    pub peer: usize,
    /// None with elements in groups and atoms.
    elements: Vec<Range<usize>>,
    nodes: Vec<Range<usize>>,
    /// Those of one plane after those of the other.
    pub numbers: Vec<f64>,
}

/// Whose numbers travel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    Nodes,
    Elements,
}

impl Halo {
    /// Asks the other ranks for these elements of theirs, ascending. All ranks must do so at once.
    pub fn ask(domain: &Domain, mesh: &impl Grouped, needed: &[u32]) -> Self {
        let asked: Vec<Vec<u32>> = by_owner(domain, needed);
        let wanted = domain.ranks.swap(&asked);
        let parcels = |lists: &[Vec<u32>]| {
            let parcels = lists.iter().enumerate().filter(|(_, list)| !list.is_empty());
            parcels
                .map(|(peer, list)| Parcel::new(domain, mesh, peer, list))
                .collect()
        };
        Self {
            outgoing: parcels(&wanted),
            incoming: parcels(&asked),
            elements: ranges(domain, needed),
        }
    }

    /// Atoms of others whose positions arrive, counted from 0.
    pub fn atoms(&self, domain: &Domain) -> impl Iterator<Item = Range<usize>> {
        let count = domain.grouped_count();
        let atoms = self.elements.iter().filter(move |range| range.start >= count);
        atoms.map(move |range| range.start - count..range.end - count)
    }

    /// Brings the positions of others' nodes up to date while some work is done that does not need them.
    pub fn exchange<T, const D: usize>(
        &mut self,
        domain: &Domain,
        position: &mut [Vec<f64>; D],
        work: impl FnOnce(&[Vec<f64>; D]) -> T,
    ) -> T {
        self.pack(Of::Nodes, position.each_ref().map(Vec::as_slice));
        let done = domain
            .ranks
            .exchange(&self.outgoing, &mut self.incoming, || work(position));
        self.unpack(Of::Nodes, position.each_mut().map(Vec::as_mut_slice));
        done
    }

    /// Brings numbers of others' nodes or elements up to date. All ranks must call this together.
    pub fn bring<const N: usize>(&mut self, domain: &Domain, of: Of, planes: [&mut [f64]; N]) {
        self.pack(of, planes.each_ref().map(|plane| &**plane));
        domain.ranks.exchange(&self.outgoing, &mut self.incoming, || ());
        self.unpack(of, planes);
    }

    fn pack<const N: usize>(&mut self, of: Of, planes: [&[f64]; N]) {
        self.outgoing.iter_mut().for_each(|parcel| parcel.pack(of, planes));
        self.incoming.iter_mut().for_each(|parcel| parcel.make_room::<N>(of));
    }

    fn unpack<const N: usize>(&self, of: Of, mut planes: [&mut [f64]; N]) {
        self.incoming.iter().for_each(|parcel| parcel.unpack(of, &mut planes));
    }
}

impl Parcel {
    fn new(domain: &Domain, mesh: &impl Grouped, peer: usize, elements: &[u32]) -> Self {
        let elements = ranges(domain, elements);
        Self {
            peer,
            nodes: elements
                .iter()
                .flat_map(|elements| mesh.nodes_of_range(elements))
                .collect(),
            elements,
            numbers: Vec::new(),
        }
    }

    fn places(&self, of: Of) -> &[Range<usize>] {
        match of {
            Of::Nodes => &self.nodes,
            Of::Elements => &self.elements,
        }
    }

    fn pack<const N: usize>(&mut self, of: Of, planes: [&[f64]; N]) {
        let mut numbers = std::mem::take(&mut self.numbers);
        numbers.clear();
        for plane in planes {
            for place in self.places(of) {
                numbers.extend_from_slice(&plane[place.clone()]);
            }
        }
        self.numbers = numbers;
    }

    fn make_room<const N: usize>(&mut self, of: Of) {
        let places: usize = self.places(of).iter().map(Range::len).sum();
        self.numbers.resize(N * places, 0.0);
    }

    fn unpack<const N: usize>(&self, of: Of, planes: &mut [&mut [f64]; N]) {
        let mut rest = self.numbers.as_slice();
        for plane in planes {
            for place in self.places(of) {
                let (numbers, others) = rest.split_at(place.len());
                plane[place.clone()].copy_from_slice(numbers);
                rest = others;
            }
        }
    }
}

/// Ascending elements, sorted by the rank that computes them.
fn by_owner(domain: &Domain, elements: &[u32]) -> Vec<Vec<u32>> {
    let mut lists = vec![Vec::new(); domain.grouped.len() - 1];
    elements
        .iter()
        .for_each(|&element| lists[domain.owner(element as usize)].push(element));
    lists
}

/// Ascending elements as ranges, none with elements in groups and atoms.
fn ranges(domain: &Domain, elements: &[u32]) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for element in elements.iter().map(|&element| element as usize) {
        match ranges.last_mut() {
            Some(last) if last.end == element && element != domain.grouped_count() => last.end += 1,
            _ => ranges.push(element..element + 1),
        }
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parcels_carry_numbers_of_nodes_and_elements_to_the_same_places() {
        let places = [vec![3..9, 30..31], std::iter::once(1..3).collect()];
        let mut parcel = Parcel {
            peer: 1,
            nodes: places[0].clone(),
            elements: places[1].clone(),
            numbers: Vec::new(),
        };
        let here = [0, 1000].map(|start| (start..start + 40).map(f64::from).collect::<Vec<_>>());
        for (of, places) in [Of::Nodes, Of::Elements].into_iter().zip(places) {
            let mut there = here.clone().map(|plane| vec![0.0; plane.len()]);
            parcel.pack(of, here.each_ref().map(Vec::as_slice));
            let packed = parcel.numbers.len();
            parcel.make_room::<2>(of);
            assert_eq!(parcel.numbers.len(), packed);
            parcel.unpack(of, &mut there.each_mut().map(Vec::as_mut_slice));
            for axis in 0..2 {
                for place in 0..40 {
                    let carried = places.iter().any(|range| range.contains(&place));
                    assert_eq!(there[axis][place], if carried { here[axis][place] } else { 0.0 });
                }
            }
        }
    }
}
