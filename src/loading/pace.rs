//! How far the grips may move in one step.

/// Largest share of the lattice spacing by which the grips may outrun, in one step, what they pull at: no force answers before
/// its end. From 0.08 to 0.97 of the speed of sound a share of 1 % loses at most 0.8 % of the work in atoms and in triangles of
/// 10 an edge; 2 % loses up to 1.8 %, 8 % 4 % and 15 % 20 %.
pub const SHARE_OF_SPACING: f64 = 0.01;

/// The longest step that grips allow, ps, that part at a nominal rate (1/ps) over a height (nm), in a lattice of this spacing, nm.
///
/// A specimen at rest is left behind by the whole way of the grips, one with a `ramp`, which starts with its share of their
/// speed, by the strain of the step.
pub fn longest_step(rate: f64, height: f64, ramp: bool, spacing: f64) -> f64 {
    let outrun = if ramp { rate * spacing } else { 0.5 * rate * height };
    SHARE_OF_SPACING * spacing / outrun
}
