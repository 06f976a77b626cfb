//! The input script of a solid: its actions as fixes on groups of atoms.

use super::atom_types::AtomTypes;
use super::pair_styles::PairStyles;
use super::{Crystal, ExportError, Times, exact, refuse_what_is_not_there};
use crate::loading::{Act, Course};
use crate::material::Material;
use crate::study::case::solid::Notch;
use crate::study::case::{Case, Solid};

/// What LAMMPS must know of a solid of atoms.
pub struct SolidModel {
    pub crystal: Crystal,
    /// nm^3, what stresses are taken over.
    volume: f64,
    actions: Vec<Action>,
}

/// An action with its name and the types of its atoms.
struct Action {
    name: String,
    act: Act<3>,
    types: Vec<u32>,
}

/// Components of the stress as cgaft calls them, and their place in a pressure of LAMMPS.
const STRESS: [(&str, u32); 6] = [("xx", 1), ("yy", 2), ("zz", 3), ("yz", 6), ("xz", 5), ("xy", 4)];
const AXES: [&str; 3] = ["x", "y", "z"];

impl SolidModel {
    /// Of so many atoms with this reference volume, nm^3.
    pub fn new<'a>(
        case: &Case,
        solid: &Solid,
        material: &Material,
        (atoms, volume): (usize, f64),
        acts: impl Iterator<Item = (&'a str, Act<3>)>,
    ) -> Result<Self, ExportError> {
        refuse_what_is_not_there(case)?;
        if let Some(Notch::Plane { .. }) = solid.notch {
            return Err(ExportError::Severed);
        }
        let (names, acts): (Vec<&str>, Vec<Act<3>>) = acts.unzip();
        let groups: Vec<Vec<u32>> = acts.iter().map(Act::nodes).collect();
        let (types, of_groups) = AtomTypes::of_groups(atoms, &groups);
        let actions = names.into_iter().zip(acts).zip(of_groups);
        Ok(Self {
            crystal: Crystal {
                dimension: 3,
                spacing: material.spacing,
                site_mass: material.site_mass,
                styles: PairStyles::new(&solid.material.potential, material)?,
                types,
            },
            volume,
            actions: actions
                .map(|((name, act), types)| Action {
                    name: name.to_owned(),
                    act,
                    types,
                })
                .collect(),
        })
    }

    /// The whole script: settings, actions, output and the run. `head` tells what it is, a line each; the data file is
    /// `data.NAME`, and LAMMPS writes `dump.NAME`.
    pub fn script(&self, head: &[String], name: &str, times: &Times) -> String {
        let remarks = [
            "Types tell what acts on an atom: on those of type 1 nothing does.".to_owned(),
            "Stresses are those of all pairs over the volume of the perfect crystal, eV/nm^3; forces are those on the specimen, eV/nm."
                .to_owned(),
        ];
        let mut text = self.crystal.script(head, &remarks, name) + "\nfix motion all nve\n";
        let mut told = "pe ke".to_owned();
        // Forces come first: what holds an atom takes all of them off it.
        let (movers, pushers): (Vec<&Action>, Vec<&Action>) = self
            .actions
            .iter()
            .filter(|action| !action.types.is_empty())
            .partition(|action| matches!(action.act, Act::Move { .. }));
        for action in pushers.into_iter().chain(movers) {
            text += &action.lines();
            if let Act::Move { .. } = action.act {
                AXES.iter()
                    .for_each(|axis| told += &format!(" v_{}_force_{axis}", action.name));
            }
        }
        text += "\ncompute pairs all pressure NULL virial\n";
        for (component, place) in STRESS {
            text += &format!(
                "variable sigma_{component} equal -c_pairs[{place}]*vol/{}\n",
                exact(self.volume)
            );
            told += &format!(" v_sigma_{component}");
        }
        text + "\n" + &times.run(name, &told, "x y z vx vy vz")
    }
}

impl Action {
    fn lines(&self) -> String {
        let Self { name, act, types } = self;
        let types: Vec<String> = types.iter().map(u32::to_string).collect();
        let mut lines = vec![String::new(), format!("group {name} type {}", types.join(" "))];
        match act {
            Act::Move { .. } => {
                lines.push("# they keep the velocity of the data file, since no force moves them".to_owned());
                lines.push(format!("fix {name} {name} setforce 0.0 0.0 0.0"));
                let forces = AXES.iter().enumerate();
                lines.extend(
                    forces
                        .map(|(axis, letter)| format!("variable {name}_force_{letter} equal -f_{name}[{}]", axis + 1)),
                );
            }
            Act::Push { force, course, .. } => {
                lines.push(format!("variable {name}_course equal {}", in_time(*course)));
                for (letter, component) in AXES.iter().zip(force) {
                    lines.push(format!(
                        "variable {name}_{letter} equal v_{name}_course*{}",
                        bracketed(*component)
                    ));
                }
                let each = AXES.map(|letter| format!("v_{name}_{letter}")).join(" ");
                lines.push(format!("fix {name} {name} addforce {each}"));
            }
            Act::Strike {
                radius,
                stiffness,
                centre,
                velocity,
                ..
            } => {
                for (axis, letter) in AXES.iter().enumerate() {
                    let [start, speed] = [centre[axis], velocity[axis]].map(bracketed);
                    lines.push(format!("variable {name}_{letter} equal {start}+time*{speed}"));
                }
                let centre = AXES.map(|letter| format!("v_{name}_{letter}")).join(" ");
                lines.push(format!(
                    "fix {name} {name} indent {} sphere {centre} {} units box",
                    exact(*stiffness),
                    exact(*radius)
                ));
            }
        }
        lines.join("\n") + "\n"
    }
}

/// A number within a formula, where a sign must not follow an operator.
fn bracketed(number: f64) -> String {
    format!("({})", exact(number))
}

/// The factor of a course as a formula of the time; comparisons are 1 or 0.
fn in_time(course: Course) -> String {
    match course {
        Course::Rise { within } if within > 0.0 => {
            let within = exact(within);
            format!("(time<{within})*time/{within}+(time>={within})")
        }
        Course::Rise { .. } => "1.0".to_owned(),
        Course::HalfSine { duration } => {
            let duration = exact(duration);
            format!("(time<{duration})*sin(PI*time/{duration})")
        }
        Course::Gaussian { duration } => {
            format!("exp(-4.0*ln(2.0)*(4.0*(time/{}-0.5))^2)", exact(duration))
        }
    }
}
