//! Sums over the whole specimen. Each rank gives what it computes, and all get the bits of one rank alone.

use std::ops::Range;

use rayon::prelude::*;

use super::Domain;
use crate::lanes::{self, BLOCK};

/// Consecutive terms of a sum that one rank has and that lie in one block.
#[derive(Clone, Debug, PartialEq)]
struct Piece {
    rank: usize,
    terms: Range<usize>,
    /// Whether they are all of their block. Such a piece travels as its sum, any other term by term.
    is_block: bool,
}

impl Domain {
    /// Some sums over all elements, of which each rank is asked for its own. All ranks must call this together.
    pub fn sum_elements<const N: usize>(&self, term: impl Fn(usize) -> [f64; N] + Sync) -> [f64; N] {
        self.sum(&self.pieces(&self.grouped), term)
    }

    /// The same over all nodes.
    pub fn sum_nodes<const N: usize>(&self, term: impl Fn(usize) -> [f64; N] + Sync) -> [f64; N] {
        self.sum(&self.pieces(&self.nodes), term)
    }

    fn sum<const N: usize>(&self, pieces: &[Piece], term: impl Fn(usize) -> [f64; N] + Sync) -> [f64; N] {
        let told = self.tell(pieces, term);
        let all = self.ranks.join(told.into_flattened());
        put_together(pieces, all.as_chunks().0)
    }

    /// All terms in pieces by rising number: those of elements in groups, which start there on every rank, then those of atoms.
    fn pieces(&self, grouped: &[usize]) -> Vec<Piece> {
        let first_atom = grouped[grouped.len() - 1];
        let classes = [(grouped, 0), (&self.atoms[..], first_atom)];
        let parts = classes.into_iter().flat_map(|(starts, first)| {
            let ends = starts.windows(2).enumerate();
            ends.map(move |(rank, ends)| (rank, first + ends[0]..first + ends[1]))
        });
        let parts: Vec<(usize, Range<usize>)> = parts.collect();
        let count = parts.last().map_or(0, |(_, terms)| terms.end);
        let cut = |(rank, terms): (usize, Range<usize>)| {
            let blocks = terms.start / BLOCK..terms.end.div_ceil(BLOCK);
            blocks.map(move |block| {
                let block = block * BLOCK..count.min((block + 1) * BLOCK);
                let terms = terms.start.max(block.start)..terms.end.min(block.end);
                let is_block = terms == block;
                Piece { rank, terms, is_block }
            })
        };
        parts
            .into_iter()
            .flat_map(cut)
            .filter(|piece| !piece.terms.is_empty())
            .collect()
    }

    /// What this rank tells of its pieces.
    fn tell<const N: usize>(&self, pieces: &[Piece], term: impl Fn(usize) -> [f64; N] + Sync) -> Vec<[f64; N]> {
        let mine = pieces.par_iter().filter(|piece| piece.rank == self.rank);
        let tell = |piece: &Piece| match piece.is_block {
            true => vec![lanes::block_sums(piece.terms.clone(), &term)],
            false => piece.terms.clone().map(&term).collect(),
        };
        mine.flat_map_iter(tell).collect()
    }
}

/// The sums, from what all ranks have told, one after the other.
fn put_together<const N: usize>(pieces: &[Piece], told: &[[f64; N]]) -> [f64; N] {
    let length = |piece: &Piece| if piece.is_block { 1 } else { piece.terms.len() };
    let ranks = pieces.iter().map(|piece| piece.rank + 1).max().unwrap_or(0);
    // Where what each rank has told starts.
    let mut next = vec![0; ranks + 1];
    pieces.iter().for_each(|piece| next[piece.rank + 1] += length(piece));
    (0..ranks).for_each(|rank| next[rank + 1] += next[rank]);
    let mut blocks = Vec::new();
    let mut unfinished: Vec<[f64; N]> = Vec::new();
    for (number, piece) in pieces.iter().enumerate() {
        let from = next[piece.rank];
        next[piece.rank] += length(piece);
        let told = &told[from..next[piece.rank]];
        if piece.is_block {
            blocks.extend_from_slice(told);
            continue;
        }
        unfinished.extend_from_slice(told);
        let is_last = number + 1 == pieces.len();
        if piece.terms.end % BLOCK == 0 || is_last {
            blocks.push(lanes::block_sums(0..unfinished.len(), |k| unfinished[k]));
            unfinished.clear();
        }
    }
    lanes::in_order(&blocks)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Ranks;

    /// Domains of so many ranks on a specimen of so many triangles and atoms, cut anywhere.
    fn domains(count: usize, triangles: usize, atoms: usize) -> Vec<Domain> {
        let cut =
            |length: usize| -> Vec<usize> { (0..=count).map(|rank| length * rank * rank / (count * count)).collect() };
        let domain = |rank| Domain {
            ranks: Ranks::alone(),
            rank,
            nodes: cut(triangles).into_iter().map(|start: usize| 3 * start).collect(),
            grouped: cut(triangles),
            atoms: cut(atoms),
            called: 0,
            heard: 0,
        };
        (0..count).map(domain).collect()
    }

    #[test]
    fn any_number_of_ranks_sums_to_the_same_bits() {
        let term = |item: usize| [1.0 / (1.0 + item as f64), (item as f64).sin()];
        for [triangles, atoms] in [[9_000, 13_001], [500, 0], [0, BLOCK], [0, 0]] {
            let alone = lanes::sums(3 * triangles + atoms, term);
            for ranks in [1, 2, 3, 7] {
                let domains = domains(ranks, triangles, atoms);
                let nodes = |domain: &Domain| domain.pieces(&domain.nodes);
                let told = domains.iter().flat_map(|domain| domain.tell(&nodes(domain), term));
                let together = put_together(&nodes(&domains[0]), &told.collect::<Vec<_>>());
                assert_eq!(together.map(f64::to_bits), alone.map(f64::to_bits), "{ranks} ranks");
            }
        }
    }
}
