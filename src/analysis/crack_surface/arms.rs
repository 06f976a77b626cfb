//! Cracks that run from one place in all directions, as under a ball.

use super::Parted;
use super::joints::{cross, dot, minus};

/// Width of the sectors in which the reach of a crack is looked at, degrees.
const SECTOR: usize = 5;
const SECTORS: usize = 360 / SECTOR;

/// Two cracks are at least this far apart, degrees.
const APART: usize = 30;

/// A crack is at least this share as long as the longest.
const LONG: f64 = 0.4;

/// Between two cracks the reach falls below this share of the shorter.
const DIP: f64 = 0.8;

/// One of the cracks from a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arm {
    /// From the x axis towards y, seen against the normal, degrees.
    pub degrees: f64,
    /// nm
    pub length: f64,
}

/// The cracks from `center` in a plate with this normal, by their direction. The direction 0 is that of x in the plate.
pub fn arms(parted: &[Parted], is_crack: &[bool], center: [f64; 3], normal: [f64; 3]) -> Vec<Arm> {
    let axis = [1.0, 0.0, 0.0];
    let out = dot(axis, normal);
    let right = [0, 1, 2].map(|part| axis[part] - out * normal[part]);
    let length = dot(right, right).sqrt();
    let right = right.map(|part| part / length);
    let up = cross(normal, right);
    let mut farthest = [(0.0, 0.0); SECTORS];
    for (piece, _) in parted.iter().zip(is_crack).filter(|(_, is_crack)| **is_crack) {
        let way = minus(piece.middle, center);
        let [x, y] = [right, up].map(|direction| dot(way, direction));
        let degrees = y.atan2(x).to_degrees().rem_euclid(360.0);
        let sector = (degrees / SECTOR as f64) as usize % SECTORS;
        let reach = x.hypot(y);
        if reach > farthest[sector].0 {
            farthest[sector] = (reach, degrees);
        }
    }
    let mut order: Vec<usize> = (0..SECTORS).collect();
    order.sort_by(|&a, &b| farthest[b].0.total_cmp(&farthest[a].0));
    let mut found: Vec<usize> = Vec::new();
    let longest = farthest[order[0]].0;
    for sector in order {
        let is_long = farthest[sector].0 > 0.0 && farthest[sector].0 >= LONG * longest;
        if is_long && found.iter().all(|&other| are_two(&farthest, sector, other)) {
            found.push(sector);
        }
    }
    found.sort_unstable();
    let arm = |sector: usize| Arm {
        degrees: farthest[sector].1,
        length: farthest[sector].0,
    };
    found.into_iter().map(arm).collect()
}

/// Whether a sector and one that reaches farther hold two cracks.
fn are_two(farthest: &[(f64, f64); SECTORS], sector: usize, other: usize) -> bool {
    let ahead = (other + SECTORS - sector) % SECTORS;
    let (from, steps) = if 2 * ahead <= SECTORS {
        (sector, ahead)
    } else {
        (other, SECTORS - ahead)
    };
    let between = (1..steps).map(|step| farthest[(from + step) % SECTORS].0);
    steps * SECTOR >= APART && between.fold(f64::INFINITY, f64::min) < DIP * farthest[sector].0
}
