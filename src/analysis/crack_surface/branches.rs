//! Stretches of a crack, or of slip, along planes that lean out of the plane of the notch.

use std::collections::BTreeMap;

use super::Parted;
use super::front::Directions;

/// It holds its direction over this length, nm, within so many degrees.
pub const HELD_OVER: f64 = 10.0;
pub const WITHIN_DEGREES: f64 = 5.0;

/// A stretch that keeps one direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Branch {
    /// Between the direction ahead of the notch and its own, degrees, positive upwards.
    pub degrees: f64,
    /// Where it begins: ahead of the notch and above its plane, nm.
    pub start: [f64; 2],
    /// nm
    pub length: f64,
}

/// The bin of a piece along a strip, and its place.
type InBin = (i64, [f64; 2]);

/// Of the pieces that are wanted the longest stretch in each of these directions that is long enough to count. None of the
/// directions is straight ahead.
///
/// Seen along the front, a branch is a row of pieces without a gap in a strip: as wide as the larger of its blocks, and as the
/// way off that it may go within its degrees.
pub fn branches(parted: &[Parted], is_wanted: &[bool], directions: &Directions, degrees: &[f64]) -> Vec<Branch> {
    let pieces = parted.iter().zip(is_wanted);
    let pieces = pieces.filter(|(_, is_wanted)| **is_wanted).map(|(piece, _)| piece);
    let size = pieces.clone().map(|piece| piece.size).max().unwrap_or(1);
    // The edge of a block whose faces have this area.
    let edge = pieces
        .clone()
        .filter(|piece| piece.size == size)
        .map(|piece| (4.0 / 3f64.sqrt() * piece.area).sqrt());
    let edge = edge.fold(0.0, f64::max);
    let bin = f64::max(edge, 1.0);
    let strip = edge + 2.0 * HELD_OVER * WITHIN_DEGREES.to_radians().tan();
    let places: Vec<[f64; 2]> = pieces
        .map(|piece| directions.coordinates(piece.middle))
        .map(|[ahead, up, _]| [ahead, up])
        .collect();
    let of_direction = |&degrees: &f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let mut rows: BTreeMap<(usize, i64), Vec<InBin>> = BTreeMap::new();
        for &[ahead, up] in &places {
            let [far, aside] = [ahead * cosine + up * sine, up * cosine - ahead * sine];
            // Strips at two offsets, so that none is cut by the border of both.
            for shift in 0..2 {
                let row = (aside / strip + 0.5 * shift as f64).floor() as i64;
                let place = ((far / bin).floor() as i64, [ahead, up]);
                rows.entry((shift, row)).or_default().push(place);
            }
        }
        let longest = rows.into_values().filter_map(longest_run);
        let (bins, start) = longest.max_by_key(|run| run.0)?;
        // So much of a crack straight ahead is in the strip too.
        let length = bins as f64 * bin - strip / sine.abs();
        (length >= HELD_OVER).then_some(Branch { degrees, start, length })
    };
    degrees.iter().filter_map(of_direction).collect()
}

/// How many bins in a row are taken at most, and the place in the first of them.
fn longest_run(mut places: Vec<InBin>) -> Option<(i64, [f64; 2])> {
    places.sort_by_key(|place| place.0);
    let runs = places.chunk_by(|a, b| b.0 - a.0 <= 1);
    let runs = runs.map(|run| (run[run.len() - 1].0 - run[0].0 + 1, run[0].1));
    runs.rev().max_by_key(|run| run.0)
}
