//! What a case will cost, before anything is computed.

use crate::loading::{Grip, Stretching};
use crate::material::Material;
use crate::mesh::element::Element;
use crate::mesh::sites::Layout;
use crate::mesh::{Mesh, Plan};
use crate::setup::{SetupError, material, mesh_plan, time_step};
use crate::solver::{Settings, Solver, SolverError, TimeStep, Until};
use crate::study::case::{self, Case};

/// Size and cost of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    pub nodes: u64,
    pub elements: u64,
    pub represented_atoms: u64,
    /// Share of the sites that are smaller elements than asked for, because no larger one fits there.
    pub leftover_share: f64,
    /// ps
    pub time_step: f64,
    /// Largest stable time step, ps.
    pub stability_limit: f64,
    pub steps: u64,
    pub memory_bytes: u64,
    /// Wall time on one thread, s.
    pub seconds: f64,
}

/// Seconds of a step on one core of a 2.6 GHz EPYC: an atom, a triangle with its share of the interfaces, and for
/// each site along its edges.
const SECONDS_AN_ATOM: f64 = 6e-8;
const SECONDS_A_TRIANGLE: f64 = 2e-7;
const SECONDS_AN_EDGE_SITE: f64 = 1.5e-8;

/// The estimate of a case; an error is physical nonsense that only the mesh or the material reveals.
pub fn estimate(case: &Case) -> Result<Estimate, SetupError> {
    let material = material(case)?;
    let plan = mesh_plan(case, &material)?;
    refuse_what_does_not_fit(&plan)?;
    let mesh = Mesh::new(&plan);
    let stability_limit = stability_limit(&mesh, &material)?;
    let time_step = time_step(case).choose(stability_limit)?;
    let case::Loading::StrainRate { rate, .. } = case.loading;
    let until = Until {
        strain: case.run.until.strain,
        time: case.run.until.time,
        ..Until::default()
    };
    let steps = until.steps(0, 0.0, time_step, rate);
    let atoms = mesh.elements.len() - mesh.triangles;
    let triangle = |size: i32| SECONDS_A_TRIANGLE + SECONDS_AN_EDGE_SITE * 3.0 * f64::from(size);
    let coarse: f64 = mesh.elements[..mesh.triangles]
        .iter()
        .map(|element| triangle(element.size))
        .sum();
    Ok(Estimate {
        nodes: mesh.node_count() as u64,
        elements: mesh.elements.len() as u64,
        represented_atoms: mesh.sites.len() as u64,
        leftover_share: leftover_share(&mesh, &plan),
        time_step,
        stability_limit,
        steps,
        memory_bytes: memory(&mesh),
        seconds: (coarse + SECONDS_AN_ATOM * atoms as f64) * steps as f64,
    })
}

/// The stability limit of the perfect crystal in this mesh, ps. The bound goes element by element, so each size is
/// looked at in a small specimen of its own.
fn stability_limit(mesh: &Mesh, material: &Material) -> Result<f64, SolverError> {
    let mut sizes: Vec<i32> = mesh.elements.iter().map(|element| element.size).collect();
    sizes.dedup();
    let limits = sizes.into_iter().map(|size| {
        let block = size.max(3);
        let layout = Layout {
            block,
            rows: 4,
            triangles: 5,
        };
        let spacing = material.spacing;
        let plan = Plan {
            layout,
            element: size as u16,
            regions: vec![],
            crack_length: None,
            grip_rows: block,
            spacing,
        };
        let patch = Mesh::new(&plan);
        let loading = Stretching::new(&patch, 1.0, Grip::Clamped, false);
        let settings = Settings {
            time_step: TimeStep::Auto { fraction: 1.0 },
            until: Until::default(),
            probe_every: f64::INFINITY,
            snapshot_every: None,
            checkpoint_every: std::time::Duration::MAX,
            thickness: 1.0,
        };
        Solver::new(patch, *material, loading, settings).map(|solver| solver.time_step()[1])
    });
    limits
        .into_iter()
        .try_fold(f64::INFINITY, |least, limit| Ok(least.min(limit?)))
}

/// Share of the sites that lie in smaller elements than their region asks for.
fn leftover_share(mesh: &Mesh, plan: &Plan) -> f64 {
    let wanted: Vec<i32> = plan
        .regions
        .iter()
        .map(|region| i32::from(region.element))
        .chain([i32::from(plan.element)])
        .collect();
    let leftover = mesh.elements.iter().filter(|element| !wanted.contains(&element.size));
    leftover.map(Element::site_count).sum::<usize>() as f64 / mesh.sites.len() as f64
}

/// Bytes that a solver of this mesh holds: nodes, sites, triangles with their interfaces, atoms with their partners.
fn memory(mesh: &Mesh) -> u64 {
    let [nodes, sites, triangles] = [mesh.node_count(), mesh.sites.len(), mesh.triangles];
    let atoms = mesh.elements.len() - triangles;
    (120 * nodes + 8 * sites + 1100 * triangles + 200 * atoms) as u64
}

/// Refuses a mesh that would not fit into what is free of this machine's memory, before it is made.
pub fn refuse_what_does_not_fit(plan: &Plan) -> Result<(), SetupError> {
    const GIBIBYTE: f64 = 1_073_741_824.0;
    let sites = plan.layout.site_count();
    let per_site = if plan.element == 1 {
        330.0
    } else {
        12.0 + 2000.0 / f64::from(plan.element).powi(2)
    };
    let needed = sites as f64 * per_site / GIBIBYTE;
    match free_memory() {
        Some(present) if needed > present / GIBIBYTE => Err(SetupError::TooLarge {
            sites,
            needed,
            present: present / GIBIBYTE,
        }),
        _ => Ok(()),
    }
}

/// Bytes of memory that are free, where the system tells.
fn free_memory() -> Option<f64> {
    let table = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = table.lines().find(|line| line.starts_with("MemAvailable:"))?;
    line.split_whitespace()
        .nth(1)?
        .parse::<f64>()
        .ok()
        .map(|kibibytes| 1024.0 * kibibytes)
}
