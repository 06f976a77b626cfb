//! The data file: box, atoms and velocities.

use std::io::{self, Write};

use super::{Model, exact};
use crate::state::State;

impl Model<'_> {
    /// Writes atoms with these positions (nm) and velocities (nm/ps). `title` must be one line.
    pub fn write_data(&self, title: &str, state: &State, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "# {title}\n")?;
        writeln!(out, "{} atoms\n{} atom types\n", state.nodes(), self.types.count)?;
        for (plane, axis) in state.position.iter().zip(["x", "y"]) {
            let [low, high] = extent(plane);
            let margin = self.mesh.spacing;
            writeln!(
                out,
                "{} {} {axis}lo {axis}hi",
                exact(low - margin),
                exact(high + margin)
            )?;
        }
        writeln!(out, "-0.5 0.5 zlo zhi\n\nAtoms # atomic\n")?;
        let [x, y] = &state.position;
        for (node, kind) in self.types.of_site.iter().enumerate() {
            writeln!(out, "{} {kind} {} {} 0.0", node + 1, exact(x[node]), exact(y[node]))?;
        }
        writeln!(out, "\nVelocities\n")?;
        let [x, y] = &state.velocity;
        for node in 0..state.nodes() {
            writeln!(out, "{} {} {} 0.0", node + 1, exact(x[node]), exact(y[node]))?;
        }
        Ok(())
    }
}

fn extent(plane: &[f64]) -> [f64; 2] {
    plane
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| {
            [low.min(x), high.max(x)]
        })
}
