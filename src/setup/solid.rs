//! A solid becomes a mesh, a loading and a solver.

mod bar;
pub mod burden;
mod estimate;
mod experiment;
mod faces;
mod intensity;
mod plan;
mod severed;
mod specimen;
mod words;

pub use bar::bar;
pub use estimate::Estimator;
pub use intensity::Intensity;
pub use plan::{Laid, lay_out};
pub use specimen::{Kind, Specimen};

pub use experiment::{LOADING, gauge_name};

use super::{SetupError, interaction};
use crate::domain::Ranks;
use crate::material::Material;
use crate::mesh::solid::Solid as Mesh;
use crate::solver::solid::Experiment;
use crate::solver::{self, Solver};
use crate::study::Subject;
use crate::study::case::solid::Loading;
use crate::study::case::{Case, MassMatrix, Solid, Summation};

/// The crystal of a solid.
pub fn material(solid: &Solid) -> Result<Material, SetupError> {
    let (interaction, site_mass) = interaction(&solid.material)?;
    Material::face_centred_cubic(interaction, site_mass).ok_or(SetupError::NoLattice {
        cutoff: interaction.cutoff(),
        minimum: interaction.minimum(),
    })
}

/// Nominal strain a ps, where the loading makes one.
pub fn strain_rate(solid: &Solid) -> Option<f64> {
    let Loading::Velocity {
        face,
        speed,
        direction,
        depth,
        ..
    } = solid.loading
    else {
        return None;
    };
    let spacing = material(solid).ok()?.spacing;
    let laid = lay_out(solid, spacing).ok()?;
    Some(speed / laid.strained_length(solid, face, direction, depth))
}

fn settings(case: &Case, solid: &Solid) -> solver::Settings {
    let rate = strain_rate(solid);
    super::settings(case, |strain| rate.map_or(f64::INFINITY, |rate| strain / rate))
}

/// Refuses what a study may ask for and the forces of solids do not have.
pub fn refuse_what_is_not_there(case: &Case) -> Result<(), SetupError> {
    match case.run.summation {
        Summation::Exact | Summation::Gauss { .. } | Summation::Nodal => Ok(()),
        Summation::StrictGauss { .. } => Err(SetupError::NotThere {
            subject: Subject::Summation,
            message: "in this version a few points stand for the bonds of a solid only where its faces are hardly bent",
            help: "write `summation: {gauss: 6}`, `{gauss: 3}` or `exact`",
        }),
    }
}

/// A node of a block stands for dozens of atoms, and whatever borders on it would feel each of its bonds as often: nodes of
/// blocks of another size bear it, atoms would need time steps several times shorter. `sizes`: how many sizes elements have.
fn refuse_nodes_beside_others(summation: Summation, sizes: usize) -> Result<(), SetupError> {
    match summation {
        Summation::Nodal if sizes > 1 => Err(SetupError::NotThere {
            subject: Subject::Summation,
            message: "`nodal` takes a solid of whole blocks of one size, and here blocks border on atoms or on other blocks: \
                      their bonds would count for dozens",
            help: "give `specimen.blocks` and no `regions`; or write `summation: exact`",
        }),
        _ => Ok(()),
    }
}

/// Coupled masses of an element answer to forces together: either all of its nodes are free, or none.
fn refuse_half_held_elements(mesh: &Mesh, experiment: &Experiment) -> Result<(), SetupError> {
    let actions = experiment.actions.iter();
    let mut held: Vec<u32> = actions.flat_map(|(_, action)| action.held()).collect();
    held.sort_unstable();
    let is_held = |node: usize| held.binary_search(&(node as u32)).is_ok();
    let half_held = (0..mesh.parts).find(|&part| {
        let mut nodes = mesh.nodes_of(part);
        nodes.clone().any(is_held) && !nodes.all(is_held)
    });
    match half_held {
        Some(_) => Err(SetupError::NotThere {
            subject: Subject::Mass,
            message: "some elements are held or moved in part, and the masses of their nodes are coupled",
            help: "hold and move whole blocks: leave out `layers` and `depth`; or write `mass: lumped`",
        }),
        None => Ok(()),
    }
}

/// The part of this rank in a solver of a solid at the start of its run.
pub fn solver(case: &Case, solid: &Solid, ranks: Ranks) -> Result<Solver<solver::Solid, 3>, SetupError> {
    refuse_what_is_not_there(case)?;
    let material = material(solid)?;
    let laid = lay_out(solid, material.spacing)?;
    let sites = specimen::site_count(&laid.plan);
    estimate::refuse_what_does_not_fit(sites, solid.resolution.element, ranks.here())?;
    // All have looked at what is free before any takes of it.
    ranks.wait_for_all();
    let mesh = Mesh::new(&laid.plan);
    severed::refuse_severed_elements(&mesh)?;
    refuse_nodes_beside_others(case.run.summation, mesh.sizes().len())?;
    let experiment = experiment::experiment(solid, &laid, &mesh, &material)?;
    if case.run.mass != MassMatrix::Lumped {
        refuse_half_held_elements(&mesh, &experiment)?;
    }
    Ok(Solver::of_solid(
        ranks,
        mesh,
        material,
        experiment,
        settings(case, solid),
    )?)
}
