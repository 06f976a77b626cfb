//! Sites as nodes carry them: how a loading sees a face of a specimen.

use std::ops::Range;

use crate::domain::Domain;
use crate::mesh::solid::Solid;

/// Some sites of a specimen. A site stands at the sum of its weights times the places of its nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Carried {
    /// Where the carriers of each site start, and their number at the end.
    starts: Vec<u32>,
    /// Nodes and their weights.
    carriers: Vec<(u32, f64)>,
    /// Sites that follow each other and have the same nodes: an element each.
    elements: Vec<Range<usize>>,
}

impl Carried {
    /// The sites of elements, each with its nodes and their weights.
    pub fn new<S: IntoIterator<Item = (usize, f64)>>(elements: impl Iterator<Item = impl Iterator<Item = S>>) -> Self {
        let mut found = Self {
            starts: vec![0],
            ..Self::default()
        };
        for sites in elements {
            let first = found.len();
            for carriers in sites {
                found
                    .carriers
                    .extend(carriers.into_iter().map(|(node, weight)| (node as u32, weight)));
                found.starts.push(found.carriers.len() as u32);
            }
            if found.len() > first {
                found.elements.push(first..found.len());
            }
        }
        found
    }

    /// The sites of a solid that are wanted, and the elements that have some, ascending.
    pub fn of_solid(mesh: &Solid, is_wanted: impl Fn([i32; 3]) -> bool) -> (Vec<u32>, Self) {
        let wanted = |element: usize| -> Vec<[i32; 3]> {
            let shape = mesh.elements[element];
            shape.locals().filter(|&local| is_wanted(shape.site(local))).collect()
        };
        let all = (0..mesh.elements.len()).map(|element| (element, wanted(element)));
        let some: Vec<(usize, Vec<[i32; 3]>)> = all.filter(|(_, sites)| !sites.is_empty()).collect();
        let sites = some.iter().map(|(element, sites)| {
            let carriers = |&local| mesh.carriers(*element, local);
            sites.iter().map(carriers)
        });
        (
            some.iter().map(|(element, _)| *element as u32).collect(),
            Self::new(sites),
        )
    }

    /// Number of sites.
    pub fn len(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Sites of one element each.
    pub fn elements(&self) -> &[Range<usize>] {
        &self.elements
    }

    /// Nodes that carry some sites that follow each other, and their weights, site by site.
    pub fn carriers(&self, sites: Range<usize>) -> &[(u32, f64)] {
        &self.carriers[self.starts[sites.start] as usize..self.starts[sites.end] as usize]
    }

    /// Nodes that carry the sites, ascending, each with how many of them it stands for: forces of one a site are these on
    /// the nodes.
    pub fn shares(&self) -> Vec<(u32, f64)> {
        let mut sorted = self.carriers.clone();
        // In the order of the sites among those of one node.
        sorted.sort_by_key(|&(node, _)| node);
        let of_nodes = sorted.chunk_by(|one, other| one.0 == other.0);
        of_nodes
            .map(|same| (same[0].0, same.iter().map(|(_, weight)| weight).sum()))
            .collect()
    }

    /// What a field of the nodes is at a site.
    #[inline(always)]
    pub fn at<const D: usize>(&self, site: usize, planes: &[Vec<f64>; D]) -> [f64; D] {
        let carriers = self.carriers(site..site + 1);
        planes.each_ref().map(|plane| {
            carriers
                .iter()
                .map(|&(node, weight)| weight * plane[node as usize])
                .sum()
        })
    }
}

/// The mean of a field of the nodes over sites that nodes stand for in these shares. All ranks must ask for it together.
pub fn mean<const D: usize>(domain: &Domain, shares: &[(u32, f64)], planes: &[Vec<f64>; D]) -> [f64; D] {
    let ranges = domain.nodes();
    let mut terms = vec![[0.0; D]; shares.len()];
    for (term, &(node, share)) in terms.iter_mut().zip(shares) {
        let node = node as usize;
        if ranges.iter().any(|range| range.contains(&node)) {
            *term = planes.each_ref().map(|plane| share * plane[node]);
        }
    }
    let all = domain.ranks().merge(terms.as_flattened());
    let sites: f64 = shares.iter().map(|(_, share)| share).sum();
    let mut mean = [0.0; D];
    for term in all.as_chunks::<D>().0 {
        (0..D).for_each(|axis| mean[axis] += term[axis] / sites);
    }
    mean
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An edge of three sites between two nodes, and an atom.
    fn edge_and_atom() -> Carried {
        let edge = [vec![(4, 1.0)], vec![(4, 0.5), (2, 0.5)], vec![(2, 1.0)]];
        Carried::new([edge.to_vec(), vec![vec![(7, 1.0)]]].into_iter().map(Vec::into_iter))
    }

    #[test]
    fn a_site_stands_where_its_nodes_put_it_and_nodes_stand_for_all_sites() {
        let carried = edge_and_atom();
        assert_eq!((carried.len(), carried.elements()), (4, &[0..3, 3..4][..]));
        assert_eq!(carried.shares(), [(2, 1.5), (4, 1.5), (7, 1.0)]);
        let planes = [vec![0.0, 0.0, 6.0, 0.0, 2.0, 0.0, 0.0, 1.0]];
        assert_eq!(
            [0, 1, 2, 3].map(|site| carried.at(site, &planes)),
            [[2.0], [4.0], [6.0], [1.0]]
        );
    }
}
