use super::Course;

/// What an action does to its nodes, as data.
#[derive(Clone, Debug, PartialEq)]
pub enum Act<const D: usize> {
    /// They move with a velocity, nm/ps.
    Move { nodes: Vec<u32>, velocity: [f64; D] },
    /// They are pushed with a force a site, eV/nm, that takes its course; each stands for so many sites.
    Push {
        shares: Vec<(u32, f64)>,
        force: [f64; D],
        course: Course,
    },
    /// A ball of a radius (nm) pushes each of their sites with its stiffness (eV/nm^3) times the square of its depth. Its middle
    /// starts at a place, nm, and has a velocity, nm/ps.
    Strike {
        nodes: Vec<u32>,
        radius: f64,
        stiffness: f64,
        centre: [f64; D],
        velocity: [f64; D],
    },
}

impl<const D: usize> Act<D> {
    /// The nodes that it acts on.
    pub fn nodes(&self) -> Vec<u32> {
        match self {
            Self::Move { nodes, .. } | Self::Strike { nodes, .. } => nodes.clone(),
            Self::Push { shares, .. } => shares.iter().map(|&(node, _)| node).collect(),
        }
    }
}
