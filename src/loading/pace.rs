//! How far the grips may move in one step.

use super::Stretching;

/// Largest share of the lattice spacing by which the grips may outrun, in one step, what they pull at: no force answers before
/// its end. From 0.08 to 0.97 of the speed of sound a share of 1 % loses at most 0.8 % of the work in atoms and in triangles of
/// 10 an edge; 2 % loses up to 1.8 %, 8 % 4 % and 15 % 20 %.
const SHARE_OF_SPACING: f64 = 0.01;

/// The longest step that grips allow, ps, that part at a nominal rate (1/ps) over a height (nm), in a lattice of this spacing, nm.
///
/// A specimen at rest is left behind by the whole way of the grips, one with a `ramp`, which starts with its share of their
/// speed, by the strain of the step.
pub fn longest_step(rate: f64, height: f64, ramp: bool, spacing: f64) -> f64 {
    let outrun = if ramp { rate * spacing } else { 0.5 * rate * height };
    SHARE_OF_SPACING * spacing / outrun
}

impl Stretching {
    /// The longest step that this motion allows, ps, in a lattice of this spacing, nm.
    pub fn longest_step(&self, spacing: f64) -> f64 {
        longest_step(self.rate, 2.0 * self.speed / self.rate, self.ramp, spacing)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::mesh;
    use super::*;
    use crate::loading::Grip;

    /// Rounding of a product.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn in_the_longest_step_the_grips_outrun_the_specimen_by_a_share_of_the_spacing() {
        let mesh = mesh();
        let [low, high] = mesh.grip_edges();
        let at_rest = Stretching::new(&mesh, 1e-3, Grip::Clamped, false).longest_step(0.25);
        let way = 0.5 * 1e-3 * (high - low) * at_rest;
        assert!((way / (0.01 * 0.25) - 1.0).abs() < ROUNDING);
        let along = Stretching::new(&mesh, 1e-3, Grip::Clamped, true).longest_step(0.25);
        assert!((along * 1e-3 / 0.01 - 1.0).abs() < ROUNDING);
    }
}
