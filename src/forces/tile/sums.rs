//! The forces on the triangles of a tile, several triangles or interfaces side by side.

use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};

use super::Tile;
use crate::forces::Planes;
use crate::forces::bulk::BulkBonds;
use crate::forces::interface::{IntactLimit, State};
use crate::forces::kinds::SampledStrings;
use crate::forces::measure::PARTS;
use crate::mesh::Mesh;
use crate::potential::{CutPotential, PairShape};
use crate::state::Strip;

/// What the sums are taken over.
pub struct Field<'a, S> {
    pub arch: Arch,
    pub law: CutPotential<S>,
    pub limit: &'a IntactLimit,
    pub mesh: &'a Mesh,
    pub strings: &'a SampledStrings,
    pub bulk: &'a BulkBonds,
    pub states: &'a [State],
    pub position: &'a Planes,
}

/// Where the sums of a tile go, an entry a node or a triangle.
pub struct Output<'a> {
    pub force: [&'a mut [f64]; 2],
    /// Empty where nothing is measured.
    pub held: [&'a mut [f64]; PARTS],
}

/// Forces on the nodes of a tile, and what its triangles hold if that is to be `MEASURED`; returns its triangles with
/// irregular bonds, inside or across an interface that is not open: their interfaces may loosen or open.
pub fn sum<S: PairShape, const MEASURED: bool>(
    field: &Field<S>,
    tile: &Tile,
    output: Output,
    ahead: Option<Ahead>,
) -> Vec<u32> {
    field.arch.dispatch(Sum::<S, MEASURED> {
        law: field.law,
        field,
        tile,
        gathered: [0, 1].map(|_| vec![0.0; tile.live * tile.slot]),
        irregular: Vec::new(),
        output,
        ahead,
    })
}

/// What moves on as soon as its forces are known.
pub struct Ahead<'a> {
    /// Triangles of the tile whose forces nothing but the tile can change, ascending.
    pub certain: &'a [Range<usize>],
    /// Whether the forces on each group are to be kept all the same.
    pub looked_at: &'a [bool],
    /// How fast all nodes were.
    pub before: &'a Planes,
    /// Planes of the tile's nodes.
    pub velocity: [&'a mut [f64]; 2],
    pub next: [&'a mut [f64]; 2],
    pub advance: &'a Advance<'a>,
}

/// Moves triangles from these positions into the next.
pub type Advance<'a> = dyn Fn(Strip, &Planes) + Sync + 'a;

pub(super) struct Sum<'a, S, const MEASURED: bool> {
    pub(super) law: CutPotential<S>,
    pub(super) field: &'a Field<'a, S>,
    pub(super) tile: &'a Tile,
    /// Forces on the groups in work.
    pub(super) gathered: Planes,
    pub(super) irregular: Vec<u32>,
    pub(super) output: Output<'a>,
    pub(super) ahead: Option<Ahead<'a>>,
}

impl<S: PairShape, const MEASURED: bool> WithSimd for Sum<'_, S, MEASURED> {
    type Output = Vec<u32>;

    #[inline(always)]
    fn with_simd<L: Simd>(mut self, simd: L) -> Vec<u32> {
        // A copy that stays in registers.
        let law = self.law;
        let tile = self.tile;
        let [mut begun, mut ended] = [0; 2];
        for run in &tile.runs {
            // What is inside comes first, and soon before what is across, while it is still in the cache.
            for group in begun..run.groups.max(begun) {
                self.begin_group(simd, &law, group);
            }
            begun = begun.max(run.groups);
            let kind = self.field.strings.of(run.kind);
            let regular = self
                .field
                .limit
                .untouched
                .filter(|_| !MEASURED && run.owned == [true; 2]);
            match (kind.reach, regular) {
                (1, Some(regular)) if kind.is_corner => self.add_corners(simd, &law, &regular, run),
                (1, _) => self.add_run::<L, 1>(simd, &law, run),
                (2, Some(regular)) if kind.is_edge => self.add_edges(simd, &law, &regular, run),
                (2, _) => self.add_run::<L, 2>(simd, &law, run),
                _ => self.add_run::<L, 3>(simd, &law, run),
            }
            let end = run.ended.min(begun).max(ended);
            (ended..end).for_each(|group| self.end_group(group));
            ended = end;
        }
        for group in ended..tile.groups.len() {
            // What has no runs of its own begins and ends alone.
            if group >= begun {
                self.begin_group(simd, &law, group);
            }
            self.end_group(group);
        }
        self.irregular
    }
}
