//! Where a solid has parted: the surfaces of its cracks and of its slip, from its mesh and the places of its nodes.
//!
//! A border between two parts of blocks along a face is one piece of a surface, with the area that it has in the crystal; what
//! its two faces have moved against each other says whether it has opened or slid. Between atoms the pieces are bonds of
//! nearest neighbours: three a site of a {111} plane. All lengths in nm, in the reference state where nothing else is said.

pub mod arms;
pub mod branches;
pub mod dislocated;
pub mod front;
pub mod grown;
mod joints;
mod nearby;
#[cfg(test)]
mod tests;

pub use joints::Joints;

/// The families of {111} planes: those of constant i, j, k and i + j + k of the lattice.
pub const FAMILIES: usize = 4;

/// A piece of a surface along which a solid has parted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parted {
    pub how: How,
    /// nm
    pub middle: [f64; 3],
    /// nm^2
    pub area: f64,
    /// Sites an edge of the larger of the blocks that it parts; 1 between atoms.
    pub size: i32,
    /// Number of the family of its plane.
    pub family: usize,
}

/// What two sides of a plane have done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum How {
    /// They are so far apart that no bond joins them.
    Opened,
    /// They have moved along each other by more than a half of a partial dislocation, and touch.
    Slid,
}

/// Areas at one moment, nm^2.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Areas {
    /// What has opened and hangs together with the notch, by family.
    pub crack: [f64; FAMILIES],
    /// What has opened elsewhere.
    pub elsewhere: f64,
    /// What has slid, by family.
    pub slip: [f64; FAMILIES],
}

impl Areas {
    /// `is_crack` tells of each piece whether it belongs to the crack that grows from the notch.
    pub fn of(parted: &[Parted], is_crack: &[bool]) -> Self {
        let mut areas = Self::default();
        for (piece, &is_crack) in parted.iter().zip(is_crack) {
            match piece.how {
                How::Opened if is_crack => areas.crack[piece.family] += piece.area,
                How::Opened => areas.elsewhere += piece.area,
                How::Slid => areas.slip[piece.family] += piece.area,
            }
        }
        areas
    }
}
