//! What a solid will cost, before anything is computed.

use std::collections::HashSet;

use super::specimen::{Kind, Specimen, site_count};
use super::{lay_out, material, refuse_nodes_beside_others, refuse_what_is_not_there, strain_rate};
use crate::domain::Ranks;
use crate::forces::solid::Forces;
use crate::material::Material;
use crate::mesh::solid::sites::{Frame, Outline, Sites};
use crate::mesh::solid::{Plan, SMALLEST_BLOCK, Solid as Mesh};
use crate::setup::expected::{Expected, ranks, time_of_run};
use crate::setup::intervals::between_pictures;
use crate::setup::{self, SetupError, memory};
use crate::study::case::{self, Case, MassMatrix, Solid, Summation, TimeStep};

/// Bytes of a process that computes hardly anything, and what an atom and a node of an element add, from the peaks of the film of
/// `quickstart-3d.yaml` in atoms and of the bar of `wave-bar.yaml` in blocks of five cells.
const BYTES_A_PROCESS: f64 = 36e6;
const BYTES_AN_ATOM: f64 = 480.0;
const BYTES_A_NODE: f64 = 340.0;

/// What of it every rank holds: of all parts of blocks where they lie and which have a face in common, of all atoms also who
/// may meet whom.
const BYTES_AN_ATOM_EVERYWHERE: f64 = 200.0;
const BYTES_A_NODE_EVERYWHERE: f64 = 50.0;

/// Seconds on one core: to start and to publish a run, of a probe, and in a step of an atom, of an element, and of a site
/// on its faces. Fitted to the film of `quickstart-3d.yaml` in atoms and to the bar of `wave-bar.yaml` in blocks of ten and of
/// five cells, on a shared EPYC; what is torn takes longer.
const SECONDS_A_RUN: f64 = 0.15;
const SECONDS_A_PROBE: f64 = 1e-4;
const SECONDS_AN_ATOM: f64 = 50e-9;
const SECONDS_AN_ELEMENT: f64 = 300e-9;
const SECONDS_A_FACE_SITE: f64 = 1e-9;

/// Estimates solids, and remembers what many cases of one study have in common.
#[derive(Default)]
pub struct Estimator {
    frequencies: Vec<(Kin, f64)>,
}

/// What has one squared highest frequency, 1/ps^2: elements of one size.
#[derive(Clone, PartialEq)]
struct Kin {
    material: case::Material,
    size: u32,
    mass: MassMatrix,
    summation: Summation,
}

impl Estimator {
    pub fn estimate(&mut self, case: &Case, solid: &Solid) -> Result<Expected<Specimen>, SetupError> {
        refuse_what_is_not_there(case)?;
        let material = material(solid)?;
        let laid = lay_out(solid, material.spacing)?;
        refuse_what_does_not_fit(site_count(&laid.plan), solid.resolution.element, ranks(case))?;
        let specimen = Specimen::of(case, solid, &laid, &material);
        let sizes: HashSet<u32> = specimen.kinds.iter().map(|kind| kind.size).collect();
        refuse_nodes_beside_others(case.run.summation, sizes.len())?;
        let stability_limit = self.stability_limit(&case.run, solid, &material, &specimen);
        let time_step = match case.run.time_step {
            TimeStep::Auto { fraction } => fraction * stability_limit,
            TimeStep::Given(step) => step,
        };
        let until = &case.run.until;
        let rate = strain_rate(solid);
        let by_strain = until.strain.zip(rate).map(|(strain, rate)| strain / rate);
        let end = by_strain
            .unwrap_or(f64::INFINITY)
            .min(until.time.unwrap_or(f64::INFINITY));
        let steps = (end / time_step).ceil() as u64;
        let time = time_of_run(case, rate, steps, time_step)?;
        let pictures = (time / between_pictures(case, rate).unwrap_or(f64::INFINITY))
            .floor()
            .min(steps as f64)
            + 2.0;
        let [nodes, elements] = [specimen.nodes as f64, specimen.elements as f64];
        let series = (time / case.probes.every + 2.0) * 16.0 * 40.0;
        let disk = pictures * (nodes * (48.0 + 36.0) + elements * (64.0 + 40.0)) + 96.0 * nodes + series;
        let bytes = memory_of(&specimen.kinds, ranks(case));
        let seconds = SECONDS_A_RUN
            + SECONDS_A_PROBE * time / case.probes.every
            + seconds_of_a_step(&specimen.kinds) * steps as f64;
        Ok(Expected {
            nodes: specimen.nodes,
            elements: specimen.elements,
            represented_atoms: specimen.sites,
            time_step,
            stability_limit,
            steps,
            memory_bytes: bytes as u64,
            disk_bytes: disk as u64,
            seconds,
            specimen,
        })
    }

    pub fn specimen(&mut self, case: &Case, solid: &Solid) -> Result<Specimen, SetupError> {
        let material = material(solid)?;
        let laid = lay_out(solid, material.spacing)?;
        refuse_what_does_not_fit(site_count(&laid.plan), solid.resolution.element, 1)?;
        Ok(Specimen::of(case, solid, &laid, &material))
    }

    /// The stability limit of the perfect crystal in this mesh, ps: that of its stiffest size of elements, each looked at in two
    /// blocks of its own.
    fn stability_limit(&mut self, run: &case::Run, solid: &Solid, material: &Material, specimen: &Specimen) -> f64 {
        let mut most = 0.0;
        for &Kind { size, .. } in &specimen.kinds {
            let kin = Kin {
                material: solid.material.clone(),
                size,
                mass: run.mass,
                summation: run.summation,
            };
            let found = self.frequencies.iter().find(|(known, _)| *known == kin);
            let found = found.map(|(_, squared)| *squared);
            let squared = found.unwrap_or_else(|| squared_frequency(material, &kin));
            if found.is_none() {
                self.frequencies.push((kin, squared));
            }
            most = f64::max(most, squared);
        }
        2.0 / most.sqrt()
    }
}

/// Of so many ranks together.
fn memory_of(kinds: &[Kind], ranks: u32) -> f64 {
    let others = f64::from(ranks) - 1.0;
    let each = |kind: &Kind| match kind.size {
        1 => BYTES_AN_ATOM + others * BYTES_AN_ATOM_EVERYWHERE,
        _ => (BYTES_A_NODE + others * BYTES_A_NODE_EVERYWHERE) * kind.nodes_each as f64,
    };
    let kept: f64 = kinds.iter().map(|kind| kind.number as f64 * each(kind)).sum();
    f64::from(ranks) * BYTES_A_PROCESS + kept
}

fn seconds_of_a_step(kinds: &[Kind]) -> f64 {
    let each = |kind: &Kind| match kind.size {
        1 => SECONDS_AN_ATOM,
        size => SECONDS_AN_ELEMENT + SECONDS_A_FACE_SITE * 2.0 * f64::from(size).powi(2),
    };
    kinds.iter().map(|kind| kind.number as f64 * each(kind)).sum()
}

/// Refuses a mesh that so many ranks on this machine would not fit into what is free of its memory, before it is made.
pub fn refuse_what_does_not_fit(sites: u64, element: u32, ranks: u32) -> Result<(), SetupError> {
    let volume = u64::from(element).pow(3);
    let others = f64::from(ranks) - 1.0;
    let a_site = match element {
        1 => BYTES_AN_ATOM + others * BYTES_AN_ATOM_EVERYWHERE,
        _ => (BYTES_A_NODE + others * BYTES_A_NODE_EVERYWHERE) * 14.0 / volume as f64,
    };
    let needed = (f64::from(ranks) * BYTES_A_PROCESS + a_site * sites as f64) as u64;
    match memory::free() {
        Some(present) if needed > present => Err(SetupError::TooLarge {
            sites,
            ranks,
            needed,
            present,
        }),
        _ => Ok(()),
    }
}

fn squared_frequency(material: &Material, kin: &Kin) -> f64 {
    let size = kin.size;
    let cells = size.max(SMALLEST_BLOCK as u32) as i32;
    let plan = Plan {
        sites: Sites {
            outline: Outline::Rhombohedron([2 * cells, cells, cells]),
            frame: Frame::of_blocks(material.spacing),
            removed: Vec::new(),
            cut: None,
        },
        element: size as u16,
        regions: Vec::new(),
        spacing: material.spacing,
    };
    let mesh = Mesh::new(&plan);
    let position = mesh.node_positions();
    let forces = Forces::shared(Ranks::alone(), mesh, *material, setup::summation(kin.summation));
    let forces = forces.with_consistent_mass(kin.mass.consistent_share());
    forces.squared_frequency_bound(&position)
}
