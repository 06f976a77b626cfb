//! How far a crack has come: its front along the notch, and the heights of its surface.

use super::grown::Root;
use super::joints::{cross, dot, minus};
use super::{How, Parted};
use crate::mesh::solid::Solid;
use crate::mesh::solid::cut::Cut;
use crate::mesh::solid::sites::{Frame, Outline};

/// Directions at a straight notch from one side of a solid, in the reference state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Directions {
    /// Out of its plane and into the solid, of length 1.
    pub up: [f64; 3],
    pub ahead: [f64; 3],
    /// The middle of its end, nm.
    pub end: [f64; 3],
    /// How long its front is, nm.
    pub width: f64,
    /// From its end through the solid along its plane, nm.
    pub ligament: f64,
    /// The axis of its front.
    axis: usize,
    frame: Frame,
}

impl Directions {
    /// `None` unless one slot or one severed plane reaches from a side of a rhombohedron of blocks into it, over its whole width.
    pub fn of(mesh: &Solid) -> Option<Self> {
        match mesh.sites.cut {
            Some(cut) => Self::of_cut(mesh, cut),
            None => Self::of_slot(mesh),
        }
    }

    fn of_cut(mesh: &Solid, cut: Cut) -> Option<Self> {
        let sites = &mesh.sites;
        let Outline::Rhombohedron(extent) = sites.outline else {
            return None;
        };
        let axis = |factors: [i32; 3]| factors.iter().position(|&factor| factor != 0);
        let (normal, into) = (axis(cut.normal)?, axis(cut.into)?);
        let width = 3 - normal - into;
        let placed = cut.placed(&sites.frame.vectors);
        let mut end = extent.map(|sites| 0.5 * f64::from(sites - 1));
        end[normal] = f64::from(cut.layer) - 0.5;
        end[into] = f64::from(cut.into[into]) * (f64::from(cut.end) - 0.5);
        let behind = match cut.into[into] {
            1 => cut.end,
            _ => cut.end - 1 + extent[into],
        };
        let step = dot(placed.ahead, sites.frame.vectors[into]).abs();
        Some(Self {
            up: placed.up,
            ahead: placed.ahead,
            end: sites.frame.place_between(end),
            width: f64::from(extent[width]) * mesh.spacing,
            ligament: f64::from(extent[into] - behind) * step,
            axis: width,
            frame: sites.frame,
        })
    }

    fn of_slot(mesh: &Solid) -> Option<Self> {
        let [slot] = mesh.sites.removed[..] else { return None };
        let bounds = mesh.sites.bounds();
        let touches = |axis: usize| [slot.from[axis] == bounds.from[axis], slot.to[axis] == bounds.to[axis]];
        let only = |wanted: &dyn Fn([bool; 2]) -> bool| {
            let mut axes = (0..3).filter(|&axis| wanted(touches(axis)));
            axes.next().filter(|_| axes.next().is_none())
        };
        let width = only(&|touches| touches == [true, true])?;
        let normal = only(&|touches| touches == [false, false])?;
        let into = only(&|[low, high]| low != high)?;
        let is_from_low = touches(into)[0];
        let vectors = mesh.sites.frame.vectors;
        let plane = cross(vectors[into], vectors[width]);
        let is_up = dot(plane, vectors[normal]) > 0.0;
        let up = unit(if is_up { plane } else { plane.map(|part| -part) });
        let inward = if is_from_low {
            vectors[into]
        } else {
            vectors[into].map(|part| -part)
        };
        let across = cross(unit(vectors[width]), up);
        let ahead = if dot(across, inward) > 0.0 {
            across
        } else {
            across.map(|part| -part)
        };
        let middle = |axis: usize| 0.5 * f64::from(slot.from[axis] + slot.to[axis] - 1);
        let mut end = [0, 1, 2].map(middle);
        let (last, rest) = match is_from_low {
            true => (slot.to[into] - 1, bounds.to[into] - slot.to[into]),
            false => (slot.from[into], slot.from[into] - bounds.from[into]),
        };
        end[into] = f64::from(last);
        let step = dot(ahead, vectors[into]).abs();
        Some(Self {
            up,
            ahead,
            end: mesh.sites.frame.place_between(end),
            width: f64::from(bounds.to[width] - bounds.from[width]) * mesh.spacing,
            ligament: f64::from(rest) * step,
            axis: width,
            frame: mesh.sites.frame,
        })
    }

    /// Ahead of the notch and above its plane, nm, and along its front as a share of the way between the sides of the solid.
    pub fn coordinates(&self, place: [f64; 3]) -> [f64; 3] {
        let way = minus(place, self.end);
        let [here, middle] = [place, self.end].map(|place| self.frame.lattice(place)[self.axis]);
        let spacing = unit_length(self.frame.vectors[self.axis]);
        let along = 0.5 + (here - middle) * spacing / self.width;
        [dot(way, self.ahead), dot(way, self.up), along]
    }
}

fn unit_length(vector: [f64; 3]) -> f64 {
    dot(vector, vector).sqrt()
}

fn unit(vector: [f64; 3]) -> [f64; 3] {
    let length = unit_length(vector);
    vector.map(|part| part / length)
}

/// A crack's front: how far it has come from the notch, in strips of equal width along it, nm; 0 where it has not set out.
pub fn front(parted: &[Parted], is_crack: &[bool], root: &Root, directions: &Directions, strips: usize) -> Vec<f64> {
    let mut front = vec![0.0; strips];
    for (piece, _) in parted.iter().zip(is_crack).filter(|(_, is_crack)| **is_crack) {
        let [ahead, _, along] = directions.coordinates(piece.middle);
        // What opens beside or behind the end of the notch does not advance it.
        if ahead > 0.0 {
            let strip = ((along * strips as f64).max(0.0) as usize).min(strips - 1);
            front[strip] = f64::max(front[strip], root.distance(piece.middle));
        }
    }
    front
}

/// Speed of a front from that of a time before, normal to itself, in nm/ps: the mean over the strips.
pub fn normal_speed(before: &[f64], now: &[f64], time: f64, directions: &Directions) -> f64 {
    let strips = now.len();
    let step = directions.width / strips as f64;
    let of_strip = |strip: usize| {
        let [low, high] = [strip.saturating_sub(1), (strip + 1).min(strips - 1)];
        let slope = if high > low {
            (now[high] - now[low]) / ((high - low) as f64 * step)
        } else {
            0.0
        };
        (now[strip] - before[strip]) / time / (1.0 + slope * slope).sqrt()
    };
    (0..strips).map(of_strip).sum::<f64>() / strips as f64
}

/// Roughness of a crack's surface: the root of the mean square height over its mean plane, nm, in the outer quarters of its
/// width and in the inner half. `None` where it has fewer pieces than three.
pub fn roughness(parted: &[Parted], is_crack: &[bool], directions: &Directions) -> [Option<f64>; 2] {
    let pieces = parted
        .iter()
        .zip(is_crack)
        .filter(|(piece, is_crack)| **is_crack && piece.how == How::Opened);
    let mut zones = [Vec::new(), Vec::new()];
    for (piece, _) in pieces {
        let [_, up, along] = directions.coordinates(piece.middle);
        let is_inner = (along - 0.5).abs() < 0.25;
        zones[usize::from(is_inner)].push((up, piece.area));
    }
    zones.map(|zone| {
        let area: f64 = zone.iter().map(|piece| piece.1).sum();
        let mean = zone.iter().map(|(up, area)| up * area).sum::<f64>() / area;
        let square = zone.iter().map(|(up, area)| (up - mean).powi(2) * area).sum::<f64>() / area;
        (zone.len() >= 3).then(|| square.sqrt())
    })
}
