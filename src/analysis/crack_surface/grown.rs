//! The crack: what has opened and hangs together with the notch.

use super::joints::{dot, minus};
use super::nearby::Nearby;
use super::{How, Parted};
use crate::mesh::solid::Solid;
use crate::mesh::solid::sites::Range3;

/// Middles of neighbouring pieces are less than this apart: of faces over the edges of their blocks, where two that share an
/// edge are 0.58 apart at most; of bonds in spacings.
const LINK_OF_FACES: f64 = 0.65;
const LINK_OF_BONDS: f64 = 1.1;

/// Where cracks begin.
#[derive(Clone, Copy, Debug)]
pub enum Root<'a> {
    /// At the sides of what is left out of a solid, and along a severed plane.
    Notch(&'a Solid),
    /// Wherever something opens.
    Anywhere,
}

impl<'a> Root<'a> {
    pub fn of(mesh: &'a Solid) -> Self {
        match mesh.sites.removed.is_empty() && mesh.sites.cut.is_none() {
            true => Self::Anywhere,
            false => Self::Notch(mesh),
        }
    }

    /// How far a place is from where cracks begin, nm.
    pub fn distance(&self, place: [f64; 3]) -> f64 {
        let Self::Notch(mesh) = self else { return 0.0 };
        let frame = &mesh.sites.frame;
        let here = frame.lattice(place);
        let to = |slot: &Range3| {
            let nearest =
                [0, 1, 2].map(|axis| here[axis].clamp(f64::from(slot.from[axis]), f64::from(slot.to[axis] - 1)));
            let way = minus(frame.place_between(nearest), place);
            dot(way, way).sqrt()
        };
        let to_cut = mesh.sites.cut.map(|cut| cut.placed(&frame.vectors).distance(place));
        let all = mesh.sites.removed.iter().map(to).chain(to_cut);
        all.fold(f64::INFINITY, f64::min)
    }
}

/// Of each piece whether it belongs to a crack that grows from the root.
pub fn grown(parted: &[Parted], root: &Root, spacing: f64) -> Vec<bool> {
    let opened = || (0..parted.len()).filter(|&number| parted[number].how == How::Opened);
    let link = |piece: &Parted| match piece.size {
        1 => LINK_OF_BONDS * spacing,
        size => LINK_OF_FACES * f64::from(size) * spacing,
    };
    let farthest = opened().map(|number| link(&parted[number])).fold(spacing, f64::max);
    let middles = || opened().map(|number| (number as u32, parted[number].middle));
    let nearby = Nearby::around(middles().map(|piece| piece.1), middles(), farthest);
    let mut is_crack = vec![false; parted.len()];
    // A layer lies between the outermost sites of a notch and the sites around it.
    let begins = |&number: &usize| root.distance(parted[number].middle) <= link(&parted[number]) + spacing;
    let mut new: Vec<usize> = opened().filter(begins).collect();
    new.iter().for_each(|&number| is_crack[number] = true);
    while let Some(number) = new.pop() {
        let here = &parted[number];
        for other in nearby.within(here.middle, farthest) {
            let there = &parted[other as usize];
            let way = minus(here.middle, there.middle);
            let reach = link(here).max(link(there));
            if !is_crack[other as usize] && dot(way, way) <= reach * reach {
                is_crack[other as usize] = true;
                new.push(other as usize);
            }
        }
    }
    is_crack
}
