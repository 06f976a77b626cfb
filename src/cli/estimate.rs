//! What a case will cost, before anything is computed.

use super::CliError;
use crate::plan::PlannedCase;
use crate::study::case::{Case, PotentialShape, TimeStep};

/// Size and cost of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub nodes: u64,
    pub elements: u64,
    pub represented_atoms: u64,
    /// Share of the sites that are single atoms because no element fits there.
    pub leftover_atoms_share: f64,
    /// ps
    pub time_step: f64,
    /// Largest stable time step, ps.
    pub stability_limit: f64,
    pub steps: u64,
    pub memory_bytes: u64,
    /// Wall time on one thread, s.
    pub seconds: f64,
}

/// The estimate of a case; an error is physical nonsense that only the mesh or the material reveals.
pub fn estimate(planned: &PlannedCase) -> Result<Estimate, CliError> {
    of_case(&planned.case).map_err(|why| CliError::Input(format!("case {}: {why}", planned.name)))
}

/// From areas and the nearest-neighbour stiffness alone.
fn of_case(case: &Case) -> Result<Estimate, String> {
    /// u nm^2/ps^2 in an eV.
    const ELECTRON_VOLT: f64 = 96.485_332;
    let (spacing, stiffness) = match case.material.potential.shape {
        PotentialShape::LennardJones { epsilon, sigma } => {
            let spacing = 2.0_f64.powf(1.0 / 6.0) * sigma;
            (spacing, 72.0 * epsilon / (spacing * spacing))
        }
        PotentialShape::Morse { depth, decay, distance } => (distance, 2.0 * depth * decay * decay),
        PotentialShape::HarmonicBond { stiffness, distance } => (distance, stiffness),
    };
    let sites = case.specimen.length * case.specimen.width / (spacing * spacing * 0.75_f64.sqrt());
    let edge = f64::from(case.resolution.element.max(1));
    let elements = sites * 2.0 / (edge * (edge + 1.0));
    let limit = 2.0 / (6.0 * stiffness * ELECTRON_VOLT / case.material.mass).sqrt();
    let time_step = match case.run.time_step {
        TimeStep::Auto { fraction } => fraction * limit,
        TimeStep::Given(step) => step,
    };
    let crate::study::case::Loading::StrainRate { rate, .. } = case.loading;
    let until_strain = case.run.until.strain.map(|strain| strain / rate);
    let time = [until_strain, case.run.until.time]
        .into_iter()
        .flatten()
        .fold(f64::INFINITY, f64::min);
    let steps = time / time_step;
    Ok(Estimate {
        nodes: sites as u64,
        elements: elements as u64,
        represented_atoms: sites as u64,
        leftover_atoms_share: 0.0,
        time_step,
        stability_limit: limit,
        steps: steps as u64,
        memory_bytes: (sites * 200.0) as u64,
        seconds: elements * edge * steps * 1e-7,
    })
}
