//! The input script.

use super::pair_styles::Style;
use super::{Model, exact};
use crate::loading::Grip;

/// How a case moves and when it is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Nominal strain rate, 1/ps.
    pub rate: f64,
    pub grip: Grip,
    /// ps
    pub time_step: f64,
    pub steps: u64,
    /// Steps between rows of the log, and between snapshots.
    pub probe_every: u64,
    pub snapshot_every: u64,
}

/// Bonds reach this much beyond the cutoff in LAMMPS' neighbour lists, in spacings. It changes the speed only.
const SKIN: f64 = 0.35;

impl Model<'_> {
    /// Units, atoms from a data file, masses and pair styles: all that energies and forces depend on.
    pub fn settings(&self, data_file: &str) -> String {
        let mut lines = vec![
            "units lj".to_owned(),
            "dimension 2".to_owned(),
            "boundary s s p".to_owned(),
            "atom_style atomic".to_owned(),
            format!("read_data {data_file}"),
            format!("mass * {}", exact(self.site_mass)),
            String::new(),
        ];
        lines.extend(self.interactions());
        lines.push(String::new());
        lines.push(format!("neighbor {} bin", exact(SKIN * self.mesh.spacing)));
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

    /// The whole script: settings, grips, output and the run. `head` tells what it is, a line each; the data file is
    /// `data.NAME`, and LAMMPS writes `dump.NAME`.
    pub fn script(&self, head: &[String], name: &str, motion: &Motion) -> String {
        let mut text: String = head
            .iter()
            .map(|line| format!("# {line}").trim_end().to_owned() + "\n")
            .collect();
        text += "#\n";
        for line in self.remarks() {
            text += &format!("# {line}\n");
        }
        text += "\n";
        text += &self.settings(&format!("data.{name}"));
        text += &self.motion(name, motion);
        text
    }

    fn remarks(&self) -> Vec<String> {
        let mut remarks = vec![
            "Lengths are in nm, energies in eV, times in ps, masses in eV ps^2/nm^2: `units lj` multiplies by no"
                .to_owned(),
            "conversion constants, so these are the very numbers of cgaft, and nothing here is reduced.".to_owned(),
            "Atoms are numbered row by row from the lower left.".to_owned(),
        ];
        if !self.types.severed.is_empty() {
            remarks.push(
                "Types tell which pairs the notch severs: 2 lies below it, 3 above, those from 4 on at its tip."
                    .to_owned(),
            );
            remarks.push(format!(
                "The severed pairs are those of cgaft, except that of pairs that stood more than {:.2} spacings apart in",
                self.types.reach
            ));
            remarks
                .push("the crystal only those are severed that stood straight below and above the notch.".to_owned());
        }
        remarks
    }

    fn motion(&self, name: &str, motion: &Motion) -> String {
        let [first, last] = self.grip_atoms();
        let (atoms, hold) = (
            self.mesh.sites.len(),
            match motion.grip {
                Grip::Clamped => "0.0 0.0 0.0",
                Grip::Sliding => "NULL 0.0 0.0",
            },
        );
        let Motion {
            probe_every,
            snapshot_every,
            steps,
            ..
        } = motion;
        let (time_step, rate) = (exact(motion.time_step), exact(motion.rate));
        format!(
            "
# the grips keep the velocity of the data file, since no force moves them
group bottom id 1:{first}
group top id {last}:{atoms}
fix motion all nve
fix bottom bottom setforce {hold}
fix top top setforce {hold}
fix plane all enforce2d
timestep {time_step}

# nominal strain, and the force with which the specimen pulls the grips together, eV/nm
variable strain equal time*{rate}
variable pull equal 0.5*(f_bottom[2]-f_top[2])
thermo_style custom step time v_strain pe ke v_pull
thermo_modify norm no format float %.16e
thermo {probe_every}
dump fields all custom {snapshot_every} dump.{name} id type x y vx vy
dump_modify fields sort id format float %.16e
run {steps}
"
        )
    }

    /// The last atom of the lower grip and the first of the upper one.
    fn grip_atoms(&self) -> [usize; 2] {
        let sites = &self.mesh.sites;
        let rows = sites.rows();
        let before = |row: i32| (0..row).map(|row| sites.columns(row).len()).sum::<usize>();
        [before(self.mesh.grip_rows), before(rows - self.mesh.grip_rows) + 1]
    }
}
