//! What a slab will cost, before anything is computed.

use super::census::{Census, MESHED};
use super::geometry::{self, Geometry, Notch};
use super::leftovers::Leftovers;
use super::{loading, material, mesh_plan, refined, settings};
use crate::forces::Summation;
use crate::lattice::triangular;
use crate::loading::{Grip, Stretching};
use crate::material::Material;
use crate::mesh::sites::Layout;
use crate::mesh::{Mesh, Plan};
use crate::setup::expected::{Expected, ranks, time_of_run};
use crate::setup::intervals::between_pictures;
use crate::setup::{SetupError, memory};
use crate::solver::{Settings, Solver, SolverError, TimeStep};
use crate::study::case::{self, Case, Slab};

/// A specimen as it is laid out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specimen {
    pub geometry: Geometry,
    /// `None` where the specimen is too large to be meshed for this question.
    pub leftovers: Option<Leftovers>,
    /// Atoms an edge that were asked for, in the whole or in a region, and that no element has.
    pub absent: Option<i32>,
    /// Equal for cases that are one computation, however they were asked for.
    pub computation: u64,
    pub nodes: u64,
    pub elements: u64,
    /// Sites, and those of them that are elements of their own.
    pub atoms: u64,
    pub atoms_alone: u64,
}

/// Seconds on one core of a 2.6 GHz EPYC: to start and to publish a run, of a probe whatever the specimen (the fields around
/// the tip), and of a step of an atom, of a triangle, and for each site along its edges, with pictures and a running crack.
/// Fitted to model A of Deng (2011) in one piece, 346 s, and to the cases of the study of speed against error.
const SECONDS_A_RUN: f64 = 0.15;
const SECONDS_A_PROBE: f64 = 1.5e-3;
const SECONDS_AN_ATOM: f64 = 14e-9;
const SECONDS_A_TRIANGLE: f64 = 70e-9;
const SECONDS_AN_EDGE_SITE: f64 = 2e-9;

/// Pairs up to so many cutoffs are looked at.
const LOOKED_AT: f64 = 1.1;

/// Estimates cases, and remembers what many cases of one study have in common.
#[derive(Default)]
pub struct Estimator {
    crystals: Vec<(case::Sheet, Material)>,
    /// Meshes without their cracks, which no element minds.
    meshes: Vec<(Plan, Census)>,
    /// The last one that was made.
    last: Option<(Plan, Mesh)>,
    /// Stability limits, ps, of elements of one size.
    limits: Vec<(Crystal, f64)>,
}

/// What the stability limit of an element depends on.
#[derive(Clone, PartialEq)]
struct Crystal {
    size: i32,
    material: case::Sheet,
    summation: Summation,
    consistent_mass: f64,
}

impl Estimator {
    /// The estimate of a case; an error is physical nonsense that only the mesh or the material reveals.
    pub fn estimate(&mut self, case: &Case, slab: &Slab) -> Result<Expected<Specimen>, SetupError> {
        let material = self.material(slab)?;
        let plan = mesh_plan(slab, &case.run.until, &material)?;
        refuse_what_does_not_fit(&plan, ranks(case))?;
        let longest = loading::longest_step_of(slab, &plan);
        let (specimen, census) = self.lay_out(case, slab, &plan);
        refuse_a_notch_beyond_the_end(case, &specimen.geometry)?;
        // What becomes atoms on the way does so evenly, and is there in full in the end.
        let growth = refined::growth(slab, &case.run.until, &material);
        let atoms = growth.map_or(0.0, |growth| growth.atoms);
        let censuses = match growth {
            None => [census.clone(), census],
            Some(_) => [0.5, 1.0].map(|share| census.with_atoms(share * atoms)),
        };
        let stability_limit = self.stability_limit(case, slab, &censuses[1], &material)?;
        estimate_with(case, slab, &material, specimen, &censuses, [stability_limit, longest])
    }

    /// The specimen of a case; an error is that of [`Self::estimate`].
    pub fn specimen(&mut self, case: &Case, slab: &Slab) -> Result<Specimen, SetupError> {
        let material = self.material(slab)?;
        let plan = mesh_plan(slab, &case.run.until, &material)?;
        refuse_what_does_not_fit(&plan, 1)?;
        Ok(self.lay_out(case, slab, &plan).0)
    }

    fn material(&mut self, slab: &Slab) -> Result<Material, SetupError> {
        if let Some((_, known)) = self.crystals.iter().find(|(known, _)| *known == slab.material) {
            return Ok(*known);
        }
        let found = material(slab)?;
        self.crystals.push((slab.material.clone(), found));
        Ok(found)
    }

    fn lay_out(&mut self, case: &Case, slab: &Slab, plan: &Plan) -> (Specimen, Census) {
        let census = self.census(plan);
        let is_meshed = plan.layout.site_count() <= MESHED;
        let notch = plan.crack.filter(|_| is_meshed).and_then(|crack| {
            let mesh = self.mesh(plan).with_crack(Some(crack));
            let notch = Notch::of(slab, &mesh);
            self.last = Some((bare(plan), mesh.with_crack(None)));
            notch
        });
        let specimen = Specimen {
            geometry: Geometry::of(slab, plan, notch),
            leftovers: census.leftovers,
            absent: census.leftovers.and_then(|_| census.absent(plan)),
            computation: geometry::computation(case, slab, plan, census.fingerprint, notch.as_ref()),
            nodes: census.node_count(),
            elements: census.element_count(),
            atoms: census.sites,
            atoms_alone: census.atoms_alone(),
        };
        (specimen, census)
    }

    /// Counts the elements of a mesh, or in a specimen too large to be meshed for a question those that its area has
    /// room for.
    fn census(&mut self, plan: &Plan) -> Census {
        let bare = bare(plan);
        if let Some((_, census)) = self.meshes.iter().find(|(known, _)| *known == bare) {
            return census.clone();
        }
        let census = match plan.layout.site_count() {
            ..=MESHED => {
                let mesh = self.mesh(plan);
                let census = Census::counted(&bare, &mesh);
                self.last = Some((bare.clone(), mesh));
                census
            }
            _ => Census::by_area(&bare),
        };
        self.meshes.push((bare, census.clone()));
        census
    }

    /// The mesh of a plan without its crack, taken from what was made last if that is it.
    fn mesh(&mut self, plan: &Plan) -> Mesh {
        let bare = bare(plan);
        // What is kept of another plan goes before memory is taken for this one.
        let last = self.last.take().filter(|(known, _)| *known == bare);
        last.map_or_else(|| Mesh::new(&bare), |(_, mesh)| mesh)
    }

    /// The stability limit of the perfect crystal in this mesh, ps. The bound goes element by element, so each size is
    /// looked at in a small specimen of its own.
    fn stability_limit(
        &mut self,
        case: &Case,
        slab: &Slab,
        census: &Census,
        material: &Material,
    ) -> Result<f64, SolverError> {
        let settings = settings(case, slab);
        let mut least = f64::INFINITY;
        for &(size, _) in &census.elements {
            let crystal = Crystal {
                size,
                material: slab.material.clone(),
                summation: settings.summation,
                consistent_mass: settings.consistent_mass,
            };
            let limit = match self.limits.iter().find(|(known, _)| *known == crystal) {
                Some((_, limit)) => *limit,
                None => {
                    let limit = stability_limit_of(size, material, &settings)?;
                    self.limits.push((crystal, limit));
                    limit
                }
            };
            least = least.min(limit);
        }
        Ok(least)
    }
}

/// A notch that is moved to its end among the elements may come to be as long as the crack that ends the run.
fn refuse_a_notch_beyond_the_end(case: &Case, geometry: &Geometry) -> Result<(), SetupError> {
    let notch = geometry.notch.map(|notch| notch.length.actual);
    match notch.zip(case.run.until.crack_length) {
        Some((notch, end)) if notch >= end => Err(SetupError::NotchBeyondEnd { notch, end }),
        _ => Ok(()),
    }
}

fn bare(plan: &Plan) -> Plan {
    Plan {
        crack: None,
        ..plan.clone()
    }
}

/// With the elements that there are in the mean and at the end.
fn estimate_with(
    case: &Case,
    slab: &Slab,
    material: &Material,
    specimen: Specimen,
    [mean, census]: &[Census; 2],
    [stability_limit, longest]: [f64; 2],
) -> Result<Expected<Specimen>, SetupError> {
    let rate = slab.loading.strain_rate();
    let settings = settings(case, slab);
    let time_step = settings.time_step.choose(stability_limit, longest)?;
    let start = case.run.relax.unwrap_or(0.0);
    let time_of = |strain: f64| rate.map_or(f64::INFINITY, |rate| (strain - start) / rate);
    let steps = settings.until.steps(0, 0.0, time_step, time_of);
    let time = time_of_run(case, rate, steps, time_step)?;
    // The constants are those of nearest neighbours, three bonds a site; half of what an atom costs is not bonds.
    let reach = LOOKED_AT * material.interaction.cutoff() / material.spacing;
    let bonds = triangular::half_vectors_within(reach).len() as f64 / 3.0;
    let of_element = |size: i32| match size {
        1 => SECONDS_AN_ATOM * 0.5 * (1.0 + bonds),
        _ => (SECONDS_A_TRIANGLE + SECONDS_AN_EDGE_SITE * 3.0 * f64::from(size)) * bonds,
    };
    let seconds_of_probes = SECONDS_A_PROBE * time / case.probes.every;
    Ok(Expected {
        nodes: census.node_count(),
        elements: census.element_count(),
        represented_atoms: census.sites,
        specimen,
        time_step,
        stability_limit,
        steps,
        memory_bytes: census.memory(ranks(case)),
        disk_bytes: disk(case, slab, census, material.spacing, [time, steps as f64]),
        seconds: SECONDS_A_RUN + seconds_of_probes + mean.weigh(of_element) * steps as f64,
    })
}

/// Bytes on the disk of a run of so many ps and steps. A picture has four doubles a node and an element; put together, it has six
/// and seven singles, of which deflating may save little. A checkpoint has four doubles a node, and stands there twice
/// while it is replaced. A probe has some forty doubles and five for every bin of the profile, none narrower than two
/// spacings, and stands there twice while the series is put together.
fn disk(case: &Case, slab: &Slab, census: &Census, spacing: f64, [time, steps]: [f64; 2]) -> u64 {
    let every = between_pictures(case, slab.loading.strain_rate()).unwrap_or(f64::INFINITY);
    let pictures = (time / every).floor().min(steps) + 2.0;
    let [nodes, elements] = [census.node_count() as f64, census.element_count() as f64];
    let series =
        ((time / case.probes.every).min(steps) + 2.0) * 16.0 * (40.0 + 5.0 * 0.5 * slab.specimen.length / spacing);
    (pictures * (nodes * (32.0 + 24.0) + elements * (32.0 + 28.0)) + 64.0 * nodes + series) as u64
}

/// The stability limit of a perfect crystal of elements of one size, ps.
fn stability_limit_of(size: i32, material: &Material, settings: &Settings) -> Result<f64, SolverError> {
    let block = size.max(3);
    let layout = Layout {
        block,
        rows: 4,
        triangles: 5,
    };
    let plan = Plan {
        layout,
        element: size as u16,
        regions: vec![],
        crack: None,
        grip_rows: block,
        spacing: material.spacing,
    };
    let patch = Mesh::new(&plan);
    let loading = Stretching::new(&patch, 1.0, Grip::Clamped, false);
    let settings = Settings {
        time_step: TimeStep::Auto { fraction: 1.0 },
        ..settings.clone()
    };
    Solver::new(patch, *material, loading, settings).map(|solver| solver.time_step()[1])
}

/// Refuses a mesh that so many ranks on this machine, each with its part and the lay-out of the whole, would not fit into what
/// is free of its memory, before it is made.
pub fn refuse_what_does_not_fit(plan: &Plan, ranks: u32) -> Result<(), SetupError> {
    let census = Census::by_area(plan);
    let sites = census.sites;
    let needed = census.memory(ranks);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rank_counts_with_what_it_holds_beside_its_part() {
        let plan = Plan {
            layout: Layout {
                block: 10,
                rows: 4,
                triangles: 5,
            },
            element: 10,
            regions: vec![],
            crack: None,
            grip_rows: 10,
            spacing: 0.25,
        };
        refuse_what_does_not_fit(&plan, 1).unwrap();
        let refused = refuse_what_does_not_fit(&plan, u32::MAX).unwrap_err();
        let told = refused.refusal().message;
        assert!(told.contains("for 4294967295 ranks"), "{told}");
    }
}
