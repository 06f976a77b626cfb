//! The nodes of other ranks that a rank's forces depend on, and its own that others depend on.

use std::ops::Range;

use super::Domain;

/// Which positions travel between which ranks in every step.
#[derive(Debug, Default)]
pub struct Halo {
    outgoing: Vec<Parcel>,
    incoming: Vec<Parcel>,
    /// Elements of others whose positions arrive, ascending and all triangles or all atoms in each range.
    elements: Vec<Range<usize>>,
}

/// What one rank sends to another.
#[derive(Debug, Default)]
pub struct Parcel {
    /// The other rank.
    #[cfg_attr(not(feature = "mpi"), expect(dead_code, reason = "without MPI there are no others"))]
    pub peer: usize,
    nodes: Vec<Range<usize>>,
    /// x of the nodes, then y.
    pub numbers: Vec<f64>,
}

impl Halo {
    /// Asks the other ranks for these elements of theirs, ascending. All ranks must do so at once.
    pub fn ask(domain: &Domain, needed: &[u32]) -> Self {
        let asked: Vec<Vec<u32>> = by_owner(domain, needed);
        let wanted = domain.ranks.swap(&asked);
        let parcels = |lists: &[Vec<u32>]| {
            let parcels = lists.iter().enumerate().filter(|(_, list)| !list.is_empty());
            parcels.map(|(peer, list)| Parcel::new(domain, peer, list)).collect()
        };
        Self {
            outgoing: parcels(&wanted),
            incoming: parcels(&asked),
            elements: ranges(domain, needed),
        }
    }

    /// Triangles of others whose positions arrive.
    pub fn triangles(&self, domain: &Domain) -> impl Iterator<Item = Range<usize>> {
        let count = domain.triangle_count();
        self.elements.iter().filter(move |range| range.end <= count).cloned()
    }

    /// Atoms of others whose positions arrive, counted from 0.
    pub fn atoms(&self, domain: &Domain) -> impl Iterator<Item = Range<usize>> {
        let count = domain.triangle_count();
        let atoms = self.elements.iter().filter(move |range| range.start >= count);
        atoms.map(move |range| range.start - count..range.end - count)
    }

    /// Brings the positions of others' nodes up to date while some work is done that does not need them.
    pub fn exchange<T>(
        &mut self,
        domain: &Domain,
        position: &mut [Vec<f64>; 2],
        work: impl FnOnce(&[Vec<f64>; 2]) -> T,
    ) -> T {
        self.outgoing.iter_mut().for_each(|parcel| parcel.pack(position));
        let done = domain
            .ranks
            .exchange(&self.outgoing, &mut self.incoming, || work(position));
        self.incoming.iter().for_each(|parcel| parcel.unpack(position));
        done
    }
}

impl Parcel {
    fn new(domain: &Domain, peer: usize, elements: &[u32]) -> Self {
        let nodes: Vec<Range<usize>> = ranges(domain, elements)
            .into_iter()
            .map(|elements| domain.nodes_of(elements))
            .collect();
        let count: usize = nodes.iter().map(Range::len).sum();
        Self {
            peer,
            nodes,
            numbers: vec![0.0; 2 * count],
        }
    }

    fn pack(&mut self, position: &[Vec<f64>; 2]) {
        self.numbers.clear();
        for plane in position {
            for nodes in &self.nodes {
                self.numbers.extend_from_slice(&plane[nodes.clone()]);
            }
        }
    }

    fn unpack(&self, position: &mut [Vec<f64>; 2]) {
        let mut rest = self.numbers.as_slice();
        for plane in position {
            for nodes in &self.nodes {
                let (numbers, others) = rest.split_at(nodes.len());
                plane[nodes.clone()].copy_from_slice(numbers);
                rest = others;
            }
        }
    }
}

/// Ascending elements, sorted by the rank that computes them.
fn by_owner(domain: &Domain, elements: &[u32]) -> Vec<Vec<u32>> {
    let mut lists = vec![Vec::new(); domain.triangles.len() - 1];
    elements
        .iter()
        .for_each(|&element| lists[domain.owner(element as usize)].push(element));
    lists
}

/// Ascending elements as ranges, none with triangles and atoms.
fn ranges(domain: &Domain, elements: &[u32]) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for element in elements.iter().map(|&element| element as usize) {
        match ranges.last_mut() {
            Some(last) if last.end == element && element != domain.triangle_count() => last.end += 1,
            _ => ranges.push(element..element + 1),
        }
    }
    ranges
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parcels_carry_positions_to_the_same_places() {
        let nodes = vec![3..9, 30..31];
        let mut parcel = Parcel {
            peer: 1,
            nodes: nodes.clone(),
            numbers: Vec::new(),
        };
        let here = [0, 1000].map(|start| (start..start + 40).map(f64::from).collect::<Vec<_>>());
        let mut there = here.clone().map(|plane| vec![0.0; plane.len()]);
        parcel.pack(&here);
        parcel.unpack(&mut there);
        for axis in 0..2 {
            for node in 0..40 {
                let carried = nodes.iter().any(|range| range.contains(&node));
                assert_eq!(there[axis][node], if carried { here[axis][node] } else { 0.0 });
            }
        }
    }
}
