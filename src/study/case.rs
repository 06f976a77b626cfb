//! A resolved case: every choice explicit, every quantity in internal units (nm, ps, eV, u).
//!
//! `setup` reads nothing else. What a person may leave out of a study file is filled in
//! by `study::defaults`, so that the numbers that were used can always be shown.

use serde::Serialize;

mod slab;
pub mod solid;

pub use slab::*;
pub use solid::Solid;

/// One computation, fully specified. Its identity is the hash of everything here but [`Execution`].
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Case {
    #[serde(flatten)]
    pub body: Body,
    pub run: Run,
    pub probes: Probes,
    pub snapshots: Snapshots,
    #[serde(skip)]
    pub execution: Execution,
}

/// What is loaded: of two dimensions or of three.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Body {
    Slab(Slab),
    Solid(Solid),
}

impl Case {
    pub fn slab(&self) -> Option<&Slab> {
        match &self.body {
            Body::Slab(slab) => Some(slab),
            Body::Solid(_) => None,
        }
    }

    pub fn solid(&self) -> Option<&Solid> {
        match &self.body {
            Body::Slab(_) => None,
            Body::Solid(solid) => Some(solid),
        }
    }

    /// Atoms an edge of the elements outside all regions; 1 is the single atom.
    pub fn element(&self) -> u32 {
        match &self.body {
            Body::Slab(slab) => slab.resolution.element,
            Body::Solid(solid) => solid.resolution.element,
        }
    }
}

/// What the atoms are.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Material {
    pub potential: Potential,
    /// Mass of one atom, u.
    pub mass: f64,
}

/// Pair potential together with what happens at its cutoff.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Potential {
    pub shape: PotentialShape,
    /// Distance beyond which a pair does not interact, nm.
    pub cutoff: f64,
    pub at_cutoff: AtCutoff,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum PotentialShape {
    /// 4 epsilon ((sigma/r)^12 - (sigma/r)^6); eV, nm.
    LennardJones { epsilon: f64, sigma: f64 },
    /// depth ((1 - exp(-decay (r - distance)))^2 - 1); eV, 1/nm, nm.
    Morse { depth: f64, decay: f64, distance: f64 },
    /// stiffness/2 (r - distance)^2 up to the cutoff, where the bond snaps; eV/nm^2, nm.
    HarmonicBond { stiffness: f64, distance: f64 },
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum AtCutoff {
    /// The potential is cut where it stands: energy and force jump.
    Truncated,
    /// The energy is shifted to zero at the cutoff; the force jumps.
    Shifted,
    /// Energy and force are taken to zero between `from` and the cutoff, nm.
    Smooth { from: f64 },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Ramp {
    /// The interior starts with the linear velocity profile of the loading, so that no shock enters.
    InitialVelocity,
    /// The interior starts at rest.
    AtRest,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Run {
    pub until: Until,
    pub time_step: TimeStep,
    pub summation: Summation,
    pub mass: MassMatrix,
    /// Nominal strain under which the specimen comes to rest before it moves; `None`: it moves from the perfect lattice.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub relax: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub noise: Option<Noise>,
}

/// Displacements of all nodes at the start, along each axis evenly up to the amplitude.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Noise {
    /// In lattice spacings.
    pub amplitude: f64,
    pub seed: u32,
}

/// The run stops at whichever of these comes first; at least one of `strain` and `time` is given.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Until {
    /// Nominal strain.
    pub strain: Option<f64>,
    /// ps
    pub time: Option<f64>,
    /// Distance of the foremost tip from the edge the crack starts at, or from the middle of a notch inside, nm.
    pub crack_length: Option<f64>,
    /// The crack has started and then stood still for this long, ps.
    pub arrest: Option<f64>,
    /// The crack was first seen to have a branch so long ago, ps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub after_branch: Option<f64>,
    /// The crack has left its plane so long ago, ps.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub leaves_the_plane: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum TimeStep {
    /// This fraction of the stability limit.
    Auto { fraction: f64 },
    /// ps; refused above the stability limit.
    Given(f64),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Summation {
    Exact,
    Gauss {
        points: u32,
    },
    /// Also where strings are bent or parted.
    StrictGauss {
        points: u32,
    },
    Nodal,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum MassMatrix {
    Lumped,
    /// This share of the consistent matrix; 1 is the consistent matrix itself.
    Blend(f64),
}

impl MassMatrix {
    /// The share of the consistent matrix.
    pub fn consistent_share(self) -> f64 {
        match self {
            Self::Lumped => 0.0,
            Self::Blend(share) => share,
        }
    }
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Probes {
    /// Simulated time between rows of the time series, ps.
    pub every: f64,
}

#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Snapshots {
    pub every: Option<SnapshotInterval>,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum SnapshotInterval {
    Strain(f64),
    /// ps
    Time(f64),
}

/// More threads a process, and more processes, than any machine has.
pub const MOST_THREADS: u32 = 4096;
pub const MOST_RANKS: u32 = 1 << 24;

/// How a case is carried out. Never part of its identity: results do not depend on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Execution {
    /// Processes a case is shared between; `None`: what a cluster's job has, else one.
    pub ranks: Option<u32>,
    /// Threads per rank; `None`: what the machine has, shared between the jobs.
    pub threads: Option<u32>,
    /// Wall time between checkpoints, s.
    pub checkpoint_every: f64,
}
