//! Writes what a solver gives into the folder of its run.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use super::RunCaseError;
use crate::analysis::series::Series;
use crate::lattice::triangular;
use crate::mesh::Mesh;
use crate::mesh::element::Element;
use crate::record::frames::FieldMesh;
use crate::record::{self, CHECKPOINT_FILE, Picture, RecordError};
use crate::solver::checkpoint::Checkpoint;
use crate::solver::{self, Cost, Moment, Observer, Progress, Reading, Solver, site_volume};
use crate::store::{Account, Phase, Spent};

/// Keeps probes in memory until the next checkpoint, and writes snapshots at once.
pub struct Recorder<'a> {
    folder: PathBuf,
    case_id: String,
    /// Probes since the last segment, and the number of the first of them.
    part: Series,
    first_probe: u64,
    site_volume: f64,
    account: Account,
    tell: &'a mut (dyn FnMut(&Progress) + Send),
}

impl<'a> Recorder<'a> {
    pub fn new(folder: &Path, case_id: String, solver: &Solver, tell: &'a mut (dyn FnMut(&Progress) + Send)) -> Self {
        let part = Series {
            profile_x: solver.profile_x().to_vec(),
            gauge_places: solver.gauge_places().to_vec(),
            ..Series::default()
        };
        Self {
            folder: folder.to_path_buf(),
            case_id,
            part,
            first_probe: solver.probe_count(),
            site_volume: site_volume(solver.setting()),
            account: Account::open(folder),
            tell,
        }
    }

    /// Writes the probes kept in memory.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        record::write_segment(&self.folder, self.first_probe, &self.part)?;
        self.first_probe += self.part.probes.len() as u64;
        let profile_x = std::mem::take(&mut self.part.profile_x);
        let gauge_places = std::mem::take(&mut self.part.gauge_places);
        self.part = Series {
            profile_x,
            gauge_places,
            ..Series::default()
        };
        Ok(())
    }

    /// What this attempt and those before it have cost.
    pub fn total_cost(&self, cost: &Cost) -> Spent {
        self.account.total(&spent(cost))
    }
}

/// A moment as a picture shows it.
struct Snapshot<'a> {
    moment: &'a Moment<'a>,
    site_volume: f64,
}

impl Picture for Snapshot<'_> {
    fn moment(&self) -> (u64, f64, f64) {
        (self.moment.step, self.moment.time, self.moment.strain)
    }

    fn displacement(&self) -> Cow<'_, [[f64; 2]]> {
        let Moment { mesh, state, .. } = self.moment;
        let [x, y] = &state.position;
        let [from_x, from_y] = mesh.node_positions();
        let moved = x.iter().zip(from_x).zip(y.iter().zip(from_y));
        let displacement = moved.map(|((x, from_x), (y, from_y))| [x - from_x, y - from_y]);
        Cow::Owned(collected(state.nodes(), displacement))
    }

    fn velocity(&self) -> Cow<'_, [[f64; 2]]> {
        let [x, y] = &self.moment.state.velocity;
        Cow::Owned(x.iter().zip(y).map(|(&x, &y)| [x, y]).collect())
    }

    fn stress(&self) -> Cow<'_, [[f64; 3]]> {
        let Moment { mesh, measure, .. } = self.moment;
        let stress = mesh.elements.iter().enumerate().map(|(number, element)| {
            let volume = element.site_count() as f64 * self.site_volume;
            measure.virial(number).map(|component| component / volume)
        });
        Cow::Owned(stress.collect())
    }

    fn damage(&self) -> Cow<'_, [f64]> {
        Cow::Owned(damage(self.moment.mesh, self.moment.broken))
    }
}

/// So many items without a gap in memory behind them.
fn collected<T>(count: usize, items: impl Iterator<Item = T>) -> Vec<T> {
    let mut collected = Vec::with_capacity(count);
    collected.extend(items);
    collected
}

impl Observer for Recorder<'_> {
    type Error = RunCaseError;

    fn probe(&mut self, reading: &Reading) -> Result<(), RunCaseError> {
        self.part.probes.push(*reading.probe);
        self.part.profiles.extend_from_slice(reading.profile);
        self.part.tractions.extend_from_slice(reading.traction);
        self.part.gauges.extend_from_slice(reading.gauges);
        self.part.bonds.extend_from_slice(reading.bonds);
        Ok(())
    }

    fn snapshot(&mut self, moment: &Moment) -> Result<(), RunCaseError> {
        let snapshot = Snapshot {
            moment,
            site_volume: self.site_volume,
        };
        Ok(record::write_frame(&self.folder, &snapshot)?)
    }

    fn checkpoint(&mut self, checkpoint: &Checkpoint, cost: &Cost) -> Result<(), RunCaseError> {
        self.flush()?;
        record::checkpoint::write(&self.folder.join(CHECKPOINT_FILE), &self.case_id, checkpoint)?;
        Ok(self.account.save(&spent(cost))?)
    }

    fn progress(&mut self, progress: &Progress) {
        (self.tell)(progress);
    }
}

fn spent(cost: &Cost) -> Spent {
    let phase = |(phase, calls, seconds): (solver::Phase, u64, f64)| Phase {
        name: phase.name().to_owned(),
        calls,
        seconds,
    };
    Spent {
        core_seconds: cost.core_seconds,
        phases: cost.rows().map(phase).collect(),
    }
}

/// Cells and reference positions, x from the left edge and y from the crack plane.
pub fn field_mesh(solver: &Solver) -> FieldMesh {
    let mesh = solver.mesh();
    let [left, middle] = [solver.setting().left_x, mesh.middle_height()];
    let [x, y] = mesh.node_positions();
    let mut offsets = vec![0];
    for element in &mesh.elements {
        offsets.push(offsets[offsets.len() - 1] + element.node_count() as u32);
    }
    FieldMesh {
        points: x.iter().zip(&y).map(|(x, y)| [x - left, y - middle]).collect(),
        connectivity: (0..mesh.elements.len())
            .flat_map(|element| mesh.nodes_of(element))
            .map(|node| node as u32)
            .collect(),
        offsets,
        element_size: mesh.elements.iter().map(|element| element.size as u32).collect(),
    }
}

/// For every element the broken share of the reference bonds of its sites.
fn damage(mesh: &Mesh, broken: &[[i32; 3]]) -> Vec<f64> {
    let mut count = vec![0.0; mesh.elements.len()];
    for &[column, row, direction] in broken {
        let vector = triangular::NEAREST[direction as usize];
        for site in [[column, row], [column + vector[0], row + vector[1]]] {
            if let Some(owner) = mesh.owner_of(site) {
                count[owner] += 1.0;
            }
        }
    }
    let shares = count.iter_mut().zip(&mesh.elements);
    shares.for_each(|(broken, element)| *broken /= bonds_of(element));
    count
}

/// Nearest-neighbour bonds that touch the sites of an element: six a site, those inside counted once.
fn bonds_of(element: &Element) -> f64 {
    let inside = 3 * element.size * (element.size - 1) / 2;
    6.0 * element.site_count() as f64 - f64::from(inside)
}
