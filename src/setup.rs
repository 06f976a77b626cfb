//! A resolved case becomes a ready solver, and a run its folder.

mod burden;
mod caution;
mod census;
mod error;
mod estimate;
mod geometry;
mod intervals;
mod leftovers;
pub mod memory;
mod recorder;
mod run;

pub use burden::burdens;
pub use caution::cautions;
pub use error::SetupError;
use estimate::refuse_what_does_not_fit;
pub use estimate::{Estimate, Estimator, Specimen};
pub use geometry::{Geometry, Notch, Size};
pub use leftovers::Leftovers;
pub use run::{Finished, MOST_THREADS_A_CORE, RunCaseError, run_case};

use std::time::Duration;

use crate::domain::Ranks;
use crate::forces::Summation;
use crate::lattice::triangular;
use crate::loading::{Grip, Layers, Sponge, Stretching};
use crate::material::{Material, WaveSpeeds};
use crate::mesh::cut::{Crack, Side, WantedEnd};
use crate::mesh::region::{Region, Shape};
use crate::mesh::sites::{Layout, SiteSet};
use crate::mesh::{Mesh, Plan};
use crate::potential::{AtCutoff, CutPotential, HarmonicBond, Interaction, LennardJones, Morse};
use crate::solver::{self, Solver, TimeStep};
use crate::study::case::{self, Case};
use crate::units::U_IN_EV_PS2_PER_NM2;

/// Longest cutoff in units of the distance of lowest energy.
const MOST_MINIMA: f64 = 10.0;

/// Atoms along a side. Columns are counted from the lowest row, so that they reach as far to the left as there are
/// rows; this leaves 32-bit numbers room for both.
const MOST_ATOMS_ALONG: f64 = 5e8;

/// The crystal of a case.
pub fn material(case: &Case) -> Result<Material, SetupError> {
    let potential = &case.material.potential;
    let at_cutoff = match potential.at_cutoff {
        case::AtCutoff::Truncated => AtCutoff::Truncated,
        case::AtCutoff::Shifted => AtCutoff::Shifted,
        case::AtCutoff::Smooth { from } => AtCutoff::Smooth { from },
    };
    let cutoff = potential.cutoff;
    let interaction = match potential.shape {
        case::PotentialShape::LennardJones { epsilon, sigma } => {
            Interaction::LennardJones(CutPotential::new(LennardJones { epsilon, sigma }, cutoff, at_cutoff))
        }
        case::PotentialShape::Morse { depth, decay, distance } => {
            Interaction::Morse(CutPotential::new(Morse { depth, decay, distance }, cutoff, at_cutoff))
        }
        case::PotentialShape::HarmonicBond { stiffness, distance } => Interaction::HarmonicBond(CutPotential::new(
            HarmonicBond { stiffness, distance },
            cutoff,
            at_cutoff,
        )),
    };
    let minimum = interaction.minimum();
    if cutoff > MOST_MINIMA * minimum {
        return Err(SetupError::CutoffTooLong {
            cutoff,
            minimum,
            most: MOST_MINIMA,
        });
    }
    let site_mass = case.material.mass * U_IN_EV_PS2_PER_NM2;
    Material::new(interaction, site_mass).ok_or(SetupError::NoLattice {
        cutoff,
        minimum: interaction.minimum(),
    })
}

/// What the mesh of a case is made from.
pub fn mesh_plan(case: &Case, material: &Material) -> Result<Plan, SetupError> {
    let case::Lattice::Triangular = case.specimen.lattice;
    let spacing = material.spacing;
    let specimen = &case.specimen;
    let atoms = specimen.length.max(specimen.width) / spacing;
    if atoms > MOST_ATOMS_ALONG {
        return Err(SetupError::TooLong {
            side: specimen.length.max(specimen.width),
            is_width: specimen.width > specimen.length,
            atoms,
            most: MOST_ATOMS_ALONG,
        });
    }
    let layout = Layout::nearest(
        specimen.length / spacing,
        specimen.width / spacing,
        specimen.block as i32,
    );
    if layout.rows < 4 || layout.triangles < 3 {
        return Err(SetupError::TooSmall {
            length: specimen.length,
            width: specimen.width,
            rows: layout.rows,
            triangles: layout.triangles.max(0),
            block: specimen.block,
            spacing,
        });
    }
    let case::Loading::StrainRate { rate, sponge, .. } = case.loading;
    let height = f64::from((layout.rows - 2) * layout.block) * triangular::ROW_HEIGHT * spacing;
    let speed = 0.5 * rate * height;
    let sound = WaveSpeeds::of(material).longitudinal;
    if speed > sound {
        return Err(SetupError::FasterThanSound { speed, sound });
    }
    let element_row = f64::from(case.resolution.element) * triangular::ROW_HEIGHT * spacing;
    if let Some(sponge) = sponge.filter(|sponge| 2.0 * sponge >= height) {
        return Err(SetupError::SpongesMeet { sponge, height });
    }
    if let Some(sponge) = sponge.filter(|&sponge| sponge < element_row) {
        return Err(SetupError::SpongeTooThin {
            sponge,
            row: element_row,
        });
    }
    refuse_cracks_beyond(case, &SiteSet::new(layout), spacing)?;
    let highest = (layout.rows - layout.rows / 2 - 1) * layout.block;
    let element = |element: u32| match u16::try_from(element) {
        Ok(fitting) if i32::from(fitting) <= highest => Ok(fitting),
        _ => Err(SetupError::ElementTooLarge { element, rows: highest }),
    };
    let region = |region: &case::Region| -> Result<Region, SetupError> {
        let shape = match region.shape {
            case::RegionShape::Band { half_width } => Shape::Band { half_width },
            case::RegionShape::Box { from, to } => Shape::Box { from, to },
            case::RegionShape::Disc { center, radius } => Shape::Disc { center, radius },
        };
        Ok(Region {
            shape,
            element: element(region.element)?,
        })
    };
    Ok(Plan {
        layout,
        element: element(case.resolution.element)?,
        regions: case.resolution.regions.iter().map(region).collect::<Result<_, _>>()?,
        crack: case.crack.as_ref().map(|crack| notch(crack, spacing)),
        grip_rows: specimen.block as i32,
        spacing,
    })
}

/// A notch must sever a bond and leave one whole, on either side of it where it lies inside, and no crack comes farther than
/// the last. A tip is told where the next bond would be. Bonds cross the crack plane half a spacing apart.
fn refuse_cracks_beyond(case: &Case, sites: &SiteSet, spacing: f64) -> Result<(), SetupError> {
    let Some(crack) = &case.crack else { return Ok(()) };
    let [first, last] = [sites.first_bond(), sites.last_bond()].map(|bond| bond * spacing);
    let (shortest, longest) = match crack.edge {
        case::Edge::Left | case::Edge::Right => (first.max(spacing), last),
        case::Edge::None { center } => (0.5 * spacing, last - center),
    };
    if crack.measured() <= shortest {
        let [crack, shortest] = [crack.length, crack.length / crack.measured() * shortest];
        return Err(SetupError::CrackTooShort { crack, shortest });
    }
    let length = crack.length;
    match crack.edge {
        case::Edge::None { center } if crack.measured() > longest.min(center - first) => {
            return Err(SetupError::NotchNotInside {
                length,
                center,
                bonds: [first, last],
            });
        }
        case::Edge::Left | case::Edge::Right if length > longest => {
            return Err(SetupError::CrackTooLong { crack: length, longest });
        }
        _ => {}
    }
    match case.run.until.crack_length {
        Some(end) if end > longest + 0.5 * spacing => Err(SetupError::CrackOutOfReach { end, longest }),
        _ => Ok(()),
    }
}

/// The crack of a case, in units of the lattice spacing.
fn notch(crack: &case::Crack, spacing: f64) -> Crack {
    let case::Crack { edge, length, end } = *crack;
    Crack {
        side: match edge {
            case::Edge::Left => Side::Left,
            case::Edge::Right => Side::Right,
            case::Edge::None { center } => Side::Inside {
                center: center / spacing,
            },
        },
        length: length / spacing,
        end: end.map(|end| match end {
            case::NotchEnd::Corner => WantedEnd::Corner,
            case::NotchEnd::MidEdge => WantedEnd::MidEdge,
        }),
    }
}

/// The solver of a case at the start of its run.
pub fn solver(case: &Case) -> Result<Solver, SetupError> {
    shared_solver(case, Ranks::alone())
}

/// The part of this rank in a solver of a case.
pub fn shared_solver(case: &Case, ranks: Ranks) -> Result<Solver, SetupError> {
    let material = material(case)?;
    let plan = mesh_plan(case, &material)?;
    estimate::refuse_what_does_not_fit(&plan, ranks.here())?;
    // All have looked at what is free before any takes of it.
    ranks.wait_for_all();
    let mesh = Mesh::new(&plan);
    let case::Loading::StrainRate {
        mode: case::Mode::I,
        rate,
        ramp,
        sponge,
        damping,
    } = case.loading;
    let grip = match case.specimen.grips {
        case::Grips::Clamped => Grip::Clamped,
        case::Grips::Sliding => Grip::Sliding,
    };
    let loading = Stretching::new(&mesh, rate, grip, ramp == case::Ramp::InitialVelocity);
    let wave_speed = WaveSpeeds::of(&material).longitudinal;
    let layers = sponge.map(|width| Layers { width, wave_speed });
    let is_damped = layers.is_some() || damping.is_some();
    let sponge = is_damped.then(|| Sponge::new(&mesh, rate, layers, damping.unwrap_or(0.0)));
    let loading = loading.from_strain(case.run.relax.unwrap_or(0.0)).with_sponge(sponge);
    Ok(Solver::shared(ranks, mesh, material, loading, settings(case, rate))?)
}

fn settings(case: &Case, rate: f64) -> solver::Settings {
    solver::Settings {
        time_step: match case.run.time_step {
            case::TimeStep::Auto { fraction } => TimeStep::Auto { fraction },
            case::TimeStep::Given(step) => TimeStep::Given(step),
        },
        summation: match case.run.summation {
            case::Summation::Exact => Summation::Exact,
            case::Summation::Gauss { points } => Summation::Gauss { points },
            case::Summation::StrictGauss { points } => Summation::StrictGauss { points },
            case::Summation::Nodal => Summation::Nodal,
        },
        consistent_mass: match case.run.mass {
            case::MassMatrix::Lumped => 0.0,
            case::MassMatrix::Blend(share) => share,
        },
        relax: case.run.relax.is_some(),
        until: solver::Until {
            strain: case.run.until.strain,
            time: case.run.until.time,
            crack_length: case.run.until.crack_length,
            arrest: case.run.until.arrest,
            after_branch: case.run.until.after_branch,
            leaves_plane: case.run.until.leaves_the_plane,
        },
        probe_every: case.probes.every,
        snapshot_every: case.snapshots.every.map(|interval| match interval {
            case::SnapshotInterval::Strain(strain) => strain / rate,
            case::SnapshotInterval::Time(time) => time,
        }),
        checkpoint_every: Duration::from_secs_f64(case.execution.checkpoint_every),
        thickness: case.material.thickness,
    }
}
