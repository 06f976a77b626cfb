//! Triangles in tiles: the forces of bonds inside them and along the strings of their interfaces.
//!
//! A tile computes every interface that touches one of its triangles, so that tiles need nothing of each other: interfaces
//! between two tiles are computed twice. Interfaces are numbered row by row, so that what a tile works on stays in the
//! cache. The sum of a triangle begins with its inside and runs over its interfaces by rising number, wherever the tile
//! begins, so that tiles leave no trace in the result.

mod groups;
mod rows;
mod runs;
mod sums;

pub use sums::{Advance, Ahead, Field, Output, sum};

use std::ops::Range;

use super::kinds::SampledStrings;
use crate::mesh::Mesh;
use crate::mesh::groups::Group;
use crate::mesh::interfaces::Interfaces;

/// Triangles of a tile, whole groups: so many that few interfaces lie between tiles, at least as many as are worth a task,
/// and otherwise so few that all threads of a machine have some.
const LARGEST: usize = 8192;
const SMALLEST: usize = 256;
const TILES_A_THREAD: usize = 4;

/// Groups that follow each other, and the interfaces with strings that touch them.
pub struct Tile {
    pub triangles: Range<usize>,
    /// Whether some of the interfaces are to triangles of other ranks.
    pub is_at_border: bool,
    /// The number of its first group.
    first_group: usize,
    groups: Vec<Group>,
    runs: Vec<Run>,
    /// How many groups are in work at once, and how many nodes the largest has.
    live: usize,
    slot: usize,
}

/// Interfaces of one kind with consecutive numbers whose triangles have consecutive numbers in their groups.
#[derive(Clone, Copy, Debug)]
struct Run {
    kind: u32,
    first: u32,
    second: u32,
    number: u32,
    count: u32,
    /// The nodes of its first interface on which its strings act, of the first and of the second triangle.
    nodes: [[u32; 3]; 2],
    /// Where the forces on these are gathered, if their triangles belong to the tile.
    places: [[u32; 3]; 2],
    /// Whether the first and the second triangles belong to the tile.
    owned: [bool; 2],
    /// How many groups of the tile there are up to the last that it acts on.
    groups: usize,
    /// How many of them no later run acts on.
    ended: usize,
}

/// Cuts consecutive triangles of a mesh, those of one rank, into tiles.
pub fn tiles(mesh: &Mesh, interfaces: &Interfaces, strings: &SampledStrings, mine: Range<usize>) -> Vec<Tile> {
    let wanted = match rayon::current_num_threads() {
        1 => mine.len(),
        threads => mine.len() / (TILES_A_THREAD * threads),
    };
    let length = wanted.clamp(SMALLEST, LARGEST);
    let mut tiles: Vec<Tile> = Vec::new();
    for group in mesh.groups.of_range(&mine) {
        match tiles.last_mut().filter(|tile| tile.triangles.len() < length) {
            Some(tile) => tile.add(group),
            None => tiles.push(Tile::of(group, mesh)),
        }
    }
    for (number, pair) in interfaces.pairs.iter().enumerate() {
        if !strings.are_there(pair.kind) {
            continue;
        }
        let both = pair.both().map(|triangle| triangle as usize);
        let [one, other] = both.map(|triangle| mine.contains(&triangle).then(|| of_triangle(&tiles, triangle)));
        let corners = strings.of(pair.kind).corners;
        let nodes = [0, 1].map(|side| corners[side].map(|corner| mesh.node(both[side], corner) as u32));
        let mut entry = Run {
            kind: pair.kind,
            first: pair.first,
            second: pair.second,
            number: number as u32,
            count: 1,
            nodes,
            places: [[0; 3]; 2],
            owned: [true, one == other],
            groups: 0,
            ended: 0,
        };
        let is_at_border = one.is_none() || other.is_none();
        if let Some(tile) = one {
            tiles[tile].push(entry, mesh);
            tiles[tile].is_at_border |= is_at_border;
        }
        if let Some(tile) = other.filter(|_| one != other) {
            entry.owned = [false, true];
            tiles[tile].push(entry, mesh);
            tiles[tile].is_at_border |= is_at_border;
        }
    }
    tiles.iter_mut().for_each(|tile| tile.finish(mesh));
    tiles
}

/// The tile of a triangle.
pub fn of_triangle(tiles: &[Tile], triangle: usize) -> usize {
    tiles.partition_point(|tile| tile.triangles.end <= triangle)
}

impl Tile {
    fn of(group: &Group, mesh: &Mesh) -> Self {
        Self {
            triangles: group.elements.clone(),
            is_at_border: false,
            first_group: mesh.groups.number_of(group.elements.start),
            groups: vec![group.clone()],
            runs: Vec::new(),
            live: 0,
            slot: 0,
        }
    }

    fn add(&mut self, group: &Group) {
        self.triangles.end = group.elements.end;
        self.groups.push(group.clone());
    }

    /// Adds one interface, to the last run if it continues that.
    fn push(&mut self, mut entry: Run, mesh: &Mesh) {
        entry.groups = self.groups_of(&entry, mesh).max().unwrap_or(0) + 1;
        let in_one_group = |a: u32, b: u32| mesh.groups.number_of(a as usize) == mesh.groups.number_of(b as usize);
        let follows = |run: &&mut Run| {
            let next = [run.first, run.second, run.number].map(|start| start + run.count);
            next == [entry.first, entry.second, entry.number]
                && run.kind == entry.kind
                && run.owned == entry.owned
                && in_one_group(run.first, entry.first)
                && in_one_group(run.second, entry.second)
        };
        match self.runs.last_mut().filter(follows) {
            Some(run) => run.count += 1,
            None => self.runs.push(entry),
        }
    }

    /// The groups that a run acts on, counted from the first of the tile.
    fn groups_of(&self, run: &Run, mesh: &Mesh) -> impl Iterator<Item = usize> {
        let first = self.first_group;
        let both = [run.first, run.second].into_iter().zip(run.owned);
        let owned = both.filter(|&(_, owned)| owned);
        owned.map(move |(triangle, _)| mesh.groups.number_of(triangle as usize) - first)
    }

    /// Tells every run how many groups have come to their end with it, and where its forces are gathered.
    fn finish(&mut self, mesh: &Mesh) {
        let mut ended = self.groups.len();
        for at in (0..self.runs.len()).rev() {
            self.runs[at].ended = ended;
            ended = self.groups_of(&self.runs[at], mesh).fold(ended, usize::min);
        }
        let [mut begun, mut ended] = [0; 2];
        for run in &self.runs {
            begun = begun.max(run.groups);
            self.live = self.live.max(begun - ended);
            ended = run.ended.min(begun);
        }
        self.live = self.live.max(1);
        self.slot = self.groups.iter().map(|group| group.nodes().len()).max().unwrap_or(0);
        for at in 0..self.runs.len() {
            let run = self.runs[at];
            let both = [run.first, run.second];
            for side in (0..2).filter(|&side| run.owned[side]) {
                let group = mesh.groups.number_of(both[side] as usize) - self.first_group;
                let start = self.groups[group].nodes().start;
                let place = |node: u32| (self.place(group) + node as usize - start) as u32;
                self.runs[at].places[side] = run.nodes[side].map(place);
            }
        }
    }

    /// Where the forces on a group, counted from the first of the tile, are gathered.
    fn place(&self, group: usize) -> usize {
        group % self.live * self.slot
    }
}
