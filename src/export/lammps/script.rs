//! The input script of a slab.

use super::{Model, Times, exact};
use crate::loading::Grip;

/// How a slab moves and when it is looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Nominal strain rate, 1/ps.
    pub rate: f64,
    pub grip: Grip,
    pub times: Times,
}

impl Model<'_> {
    /// The whole script: settings, grips, output and the run. `head` tells what it is, a line each; the data file is
    /// `data.NAME`, and LAMMPS writes `dump.NAME`.
    pub fn script(&self, head: &[String], name: &str, motion: &Motion) -> String {
        self.crystal.script(head, &self.remarks(), name) + &self.motion(name, motion)
    }

    fn remarks(&self) -> Vec<String> {
        let mut remarks = vec!["Atoms are numbered row by row from the lower left.".to_owned()];
        if !self.crystal.types.severed.is_empty() {
            remarks.push(
                "Types tell which pairs the notch severs: 2 lies below it, 3 above, those from 4 on at its tip."
                    .to_owned(),
            );
            remarks.push(format!(
                "The severed pairs are those of cgaft, except that of pairs that stood more than {:.2} spacings apart in",
                self.crystal.types.reach
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
        let rate = exact(motion.rate);
        format!(
            "
# the grips keep the velocity of the data file, since no force moves them
group bottom id 1:{first}
group top id {last}:{atoms}
fix motion all nve
fix bottom bottom setforce {hold}
fix top top setforce {hold}
fix plane all enforce2d

# nominal strain, and the force with which the specimen pulls the grips together, eV/nm
variable strain equal time*{rate}
variable pull equal 0.5*(f_bottom[2]-f_top[2])
"
        ) + &motion.times.run(name, "v_strain pe ke v_pull", "x y vx vy")
    }

    /// The last atom of the lower grip and the first of the upper one.
    fn grip_atoms(&self) -> [usize; 2] {
        let sites = &self.mesh.sites;
        let rows = sites.rows();
        let before = |row: i32| (0..row).map(|row| sites.columns(row).len()).sum::<usize>();
        [before(self.mesh.grip_rows), before(rows - self.mesh.grip_rows) + 1]
    }
}
