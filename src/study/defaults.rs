//! What a study may leave out, in one place. Choices that decide a result (material, size, load) have no default.

use super::case::solid::PulseShape;
use super::case::{AtCutoff, Edge, Grips, Lattice, MassMatrix, Mode, Ramp, Summation, TimeStep};

pub const AT_CUTOFF: AtCutoff = AtCutoff::Truncated;
pub const LATTICE: Lattice = Lattice::Triangular;
/// Where the elements are single atoms: the 55-atom triangle of the source's 2D models.
pub const BLOCK: u32 = 10;
pub const GRIPS: Grips = Grips::Clamped;
pub const EDGE: Edge = Edge::Left;
pub const MODE: Mode = Mode::I;
pub const PULSE: PulseShape = PulseShape::HalfSine;
/// Between a ball and its face, nm: farther than they reach.
pub const GAP: f64 = 0.5;
/// Of the thickness, each side.
pub const SHARE: f64 = 0.5;
pub const RAMP: Ramp = Ramp::InitialVelocity;
pub const TIME_STEP: TimeStep = TimeStep::Auto { fraction: 0.5 };
/// Of noise.
pub const SEED: u32 = 1;
pub const SUMMATION: Summation = Summation::Exact;
pub const MASS: MassMatrix = MassMatrix::Lumped;
/// Where elements become atoms, whose energy and angular momentum no other mass keeps.
pub const MASS_OF_REFINED: MassMatrix = MassMatrix::Blend(1.0);
pub const REFINE_ERROR: f64 = 0.02;
pub const REFINE_AHEAD: u32 = 2;
/// s
pub const CHECKPOINT_EVERY: f64 = 60.0;
/// ps
pub const PROBES_EVERY: f64 = 1.0;
