//! What holds of a crystal of atoms in any number of dimensions: units, masses, pair styles, and the data file.

use std::io::{self, Write};

use super::atom_types::AtomTypes;
use super::exact;
use super::pair_styles::{PairStyles, Style};
use crate::state::State;

/// Atoms of one mass, in two or three dimensions. Atom k of LAMMPS is node k - 1 of the mesh.
pub struct Crystal {
    pub(super) dimension: usize,
    /// nm
    pub(super) spacing: f64,
    /// eV ps^2/nm^2
    pub(super) site_mass: f64,
    pub(super) styles: PairStyles,
    pub(super) types: AtomTypes,
}

/// Bonds reach this much beyond the cutoff in LAMMPS' neighbour lists, in spacings. It changes the speed only.
const SKIN: f64 = 0.35;

impl Crystal {
    /// Units, atoms from a data file, masses and pair styles: all that energies and forces depend on.
    pub fn settings(&self, data_file: &str) -> String {
        let mut lines = vec![
            "units lj".to_owned(),
            format!("dimension {}", self.dimension),
            format!("boundary s s {}", if self.dimension == 2 { "p" } else { "s" }),
            "atom_style atomic".to_owned(),
            format!("read_data {data_file}"),
            format!("mass * {}", exact(self.site_mass)),
            String::new(),
        ];
        lines.extend(self.interactions());
        lines.push(String::new());
        lines.push(format!("neighbor {} bin", exact(SKIN * self.spacing)));
        lines.push("neigh_modify every 1 delay 0 check yes".to_owned());
        lines.join("\n") + "\n"
    }

    fn interactions(&self) -> Vec<String> {
        let (bonded, severed) = (&self.styles.bonded, &self.styles.severed);
        if self.types.severed.is_empty() {
            let mut lines = vec![format!("pair_style {} {}", bonded.name, bonded.settings)];
            lines.extend(bonded.shifted.then(|| "pair_modify shift yes".to_owned()));
            lines.push(format!("pair_coeff * * {}", bonded.coefficients));
            return lines;
        }
        // A style that hybrid holds twice is called by its number.
        let [first, second] = if bonded.name == severed.name {
            [" 1", " 2"]
        } else {
            ["", ""]
        };
        let shift = |style: &Style, number: &str| {
            let line = format!("pair_modify pair {}{number} shift yes", style.name);
            style.shifted.then_some(line)
        };
        let pairs = |pair: &str, style: &Style, number: &str| {
            format!("pair_coeff {pair} {}{number} {}", style.name, style.coefficients)
        };
        let mut lines = vec![format!(
            "pair_style hybrid {} {} {} {}",
            bonded.name, bonded.settings, severed.name, severed.settings
        )];
        lines.extend(shift(bonded, first).into_iter().chain(shift(severed, second)));
        lines.push(pairs("* *", bonded, first));
        lines.push("# pairs that the cut severs: they only repel".to_owned());
        let severed_pairs = self.types.severed.iter();
        lines.extend(severed_pairs.map(|[low, high]| pairs(&format!("{low} {high}"), severed, second)));
        lines
    }

    /// The beginning of a script: what it is, a line each, remarks, and the settings.
    pub(super) fn script(&self, head: &[String], remarks: &[String], name: &str) -> String {
        let units = [
            "Lengths are in nm, energies in eV, times in ps, masses in eV ps^2/nm^2: `units lj` multiplies by no",
            "conversion constants, so these are the very numbers of cgaft, and nothing here is reduced.",
        ];
        let lines = head.iter().map(String::as_str).chain([""]).chain(units);
        let lines = lines.chain(remarks.iter().map(String::as_str));
        let comments: String = lines
            .map(|line| format!("# {line}").trim_end().to_owned() + "\n")
            .collect();
        comments + "\n" + &self.settings(&format!("data.{name}"))
    }

    /// Writes atoms with these positions (nm) and velocities (nm/ps). `title` must be one line.
    pub fn write_data<const D: usize>(&self, title: &str, state: &State<D>, out: &mut impl Write) -> io::Result<()> {
        writeln!(out, "# {title}\n")?;
        writeln!(out, "{} atoms\n{} atom types\n", state.nodes(), self.types.count)?;
        for (plane, axis) in state.position.iter().zip(["x", "y", "z"]) {
            let [low, high] = extent(plane);
            let [low, high] = [low - self.spacing, high + self.spacing].map(exact);
            writeln!(out, "{low} {high} {axis}lo {axis}hi")?;
        }
        if D == 2 {
            writeln!(out, "-0.5 0.5 zlo zhi")?;
        }
        writeln!(out, "\nAtoms # atomic\n")?;
        for (node, kind) in self.types.of_site.iter().enumerate() {
            writeln!(out, "{} {kind} {}", node + 1, components(&state.position, node))?;
        }
        writeln!(out, "\nVelocities\n")?;
        for node in 0..state.nodes() {
            writeln!(out, "{} {}", node + 1, components(&state.velocity, node))?;
        }
        Ok(())
    }
}

/// The three components of a node; a plane has none out of it.
fn components<const D: usize>(planes: &[Vec<f64>; D], node: usize) -> String {
    let of_axis = |axis: usize| planes.get(axis).map_or("0.0".to_owned(), |plane| exact(plane[node]));
    [0, 1, 2].map(of_axis).join(" ")
}

fn extent(plane: &[f64]) -> [f64; 2] {
    plane
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| {
            [low.min(x), high.max(x)]
        })
}
