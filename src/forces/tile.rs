//! Triangles in tiles: the forces of bonds inside them and along the strings of their interfaces.
//!
//! A tile is small enough to stay in the cache. It computes every interface that touches one of its triangles, so that
//! tiles need nothing of each other: interfaces between two tiles are computed twice. The sum of a triangle runs over
//! its interfaces by rising number, wherever the tile begins, so that tiles leave no trace in the result.

mod sums;

pub use sums::{Field, Output, Scratch, sum};

use std::ops::Range;

use super::summation::SampledStrings;
use crate::mesh::Mesh;
use crate::mesh::interfaces::Interfaces;

/// Triangles of a tile: at most as many as fit into the cache, at least as many as are worth a task, and otherwise so
/// many that all threads of a machine have some.
const LARGEST: usize = 4096;
const SMALLEST: usize = 256;
const TILES_A_THREAD: usize = 16;

/// Consecutive triangles, and the interfaces with strings that touch them.
pub struct Tile {
    pub triangles: Range<usize>,
    /// Whether some of the interfaces are to triangles of other ranks.
    pub is_at_border: bool,
    /// Parts of one size.
    sizes: Vec<(i32, Range<usize>)>,
    runs: Vec<Run>,
}

/// Interfaces of one kind with consecutive numbers whose triangles have consecutive numbers.
#[derive(Clone, Copy, Debug)]
struct Run {
    kind: u32,
    first: u32,
    second: u32,
    number: u32,
    count: u32,
    /// Whether the first and the second triangles belong to the tile.
    owned: [bool; 2],
}

/// Cuts consecutive triangles of a mesh, those of one rank, into tiles.
pub fn tiles(mesh: &Mesh, interfaces: &Interfaces, strings: &SampledStrings, mine: Range<usize>) -> Vec<Tile> {
    let wanted = mine.len() / (TILES_A_THREAD * rayon::current_num_threads());
    let length = wanted.next_multiple_of(SMALLEST).clamp(SMALLEST, LARGEST);
    let starts = mine.clone().step_by(length);
    let mut tiles: Vec<Tile> = starts
        .map(|start| Tile::empty(mesh, start..(start + length).min(mine.end)))
        .collect();
    let tile_of = |triangle: u32| {
        let is_mine = mine.contains(&(triangle as usize));
        is_mine.then(|| (triangle as usize - mine.start) / length)
    };
    for (number, pair) in interfaces.pairs.iter().enumerate() {
        if !strings.are_there(pair.kind) {
            continue;
        }
        let [one, other] = pair.both().map(tile_of);
        let mut entry = Run {
            kind: pair.kind,
            first: pair.first,
            second: pair.second,
            number: number as u32,
            count: 1,
            owned: [true, one == other],
        };
        let is_at_border = one.is_none() || other.is_none();
        if let Some(tile) = one {
            tiles[tile].push(entry);
            tiles[tile].is_at_border |= is_at_border;
        }
        if let Some(tile) = other.filter(|_| one != other) {
            entry.owned = [false, true];
            tiles[tile].push(entry);
            tiles[tile].is_at_border |= is_at_border;
        }
    }
    tiles
}

impl Tile {
    fn empty(mesh: &Mesh, triangles: Range<usize>) -> Self {
        let mut sizes: Vec<(i32, Range<usize>)> = Vec::new();
        for triangle in triangles.clone() {
            let size = mesh.elements[triangle].size;
            match sizes.last_mut().filter(|part| part.0 == size) {
                Some((_, part)) => part.end += 1,
                None => sizes.push((size, triangle..triangle + 1)),
            }
        }
        Self {
            triangles,
            is_at_border: false,
            sizes,
            runs: Vec::new(),
        }
    }

    /// Adds one interface, to the last run if it continues that.
    fn push(&mut self, entry: Run) {
        let follows = |run: &&mut Run| {
            let next = [run.first, run.second, run.number].map(|start| start + run.count);
            next == [entry.first, entry.second, entry.number] && run.kind == entry.kind && run.owned == entry.owned
        };
        match self.runs.last_mut().filter(follows) {
            Some(run) => run.count += 1,
            None => self.runs.push(entry),
        }
    }
}
