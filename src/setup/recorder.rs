//! Writes what a solver gives into the folder of its run.

mod slab;
mod solid;

use std::path::{Path, PathBuf};

use super::RunCaseError;
use crate::record::checkpoint::Keep;
use crate::record::frames::{FieldMesh, Vector};
use crate::record::rows::{Described, Rows};
use crate::record::{self, CHECKPOINT_FILE, Give, RecordError};
use crate::solver::checkpoint::Checkpoint;
use crate::solver::{self, Cost, Instruments, Moment, Motion, Observer, Progress, Solver};
use crate::store::{Account, Phase, Spent};

/// What of a kind of specimen goes into the folder of its run.
pub trait Recorded<const D: usize>: Instruments<D, Kept: Keep> + Sized {
    /// What must be known to understand its series.
    type Setting: Described<Rows: Clone>;
    /// A vector of its space.
    type Vector: Vector;

    fn setting(&self) -> Self::Setting;

    /// The rows of its series, none yet.
    fn no_rows(&self) -> RowsOf<Self, D>;

    /// Adds what a probe has read.
    fn add_row(rows: &mut RowsOf<Self, D>, reading: &Self::Reading);

    /// Cells and reference positions of its pictures.
    fn field_mesh(mesh: &Self::Mesh) -> FieldMesh<Self::Vector>;

    /// Writes a picture into a folder, on the first rank; the others give it what it shows of their parts.
    fn write_frame(folder: &Path, moment: &Moment<Self, D>, site_volume: f64) -> Result<(), RecordError>;

    /// Reference volume of a site, nm^3.
    fn site_volume(&self) -> f64;
}

/// The rows of the series of a kind of specimen.
pub type RowsOf<B, const D: usize> = <<B as Recorded<D>>::Setting as Described>::Rows;

/// Keeps probes in memory until the next checkpoint, and writes snapshots at once.
pub struct Recorder<'a, R: Rows> {
    folder: PathBuf,
    case_id: String,
    /// Probes since the last segment, and the number of the first of them.
    part: R,
    first_probe: u64,
    /// A part without probes.
    empty: R,
    site_volume: f64,
    account: Account,
    tell: &'a mut (dyn FnMut(&Progress) + Send),
}

impl<'a, R: Rows + Clone> Recorder<'a, R> {
    pub fn new<B: Recorded<D, Setting: Described<Rows = R>>, const D: usize>(
        folder: &Path,
        case_id: String,
        solver: &Solver<B, D>,
        tell: &'a mut (dyn FnMut(&Progress) + Send),
    ) -> Self {
        let empty = solver.body().no_rows();
        Self {
            folder: folder.to_path_buf(),
            case_id,
            part: empty.clone(),
            first_probe: solver.probe_count(),
            empty,
            site_volume: solver.body().site_volume(),
            account: Account::open(folder),
            tell,
        }
    }

    /// Writes the probes kept in memory.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        record::write_segment(&self.folder, self.first_probe, &self.part)?;
        self.first_probe += self.part.steps().len() as u64;
        self.part = self.empty.clone();
        Ok(())
    }

    /// What this attempt and those before it have cost.
    pub fn total_cost(&self, cost: &Cost) -> Spent {
        self.account.total(&spent(cost))
    }
}

impl<B: Recorded<D>, const D: usize> Observer<B, D> for Recorder<'_, RowsOf<B, D>> {
    type Error = RunCaseError;

    fn probe(&mut self, reading: &B::Reading) -> Result<(), RunCaseError> {
        B::add_row(&mut self.part, reading);
        Ok(())
    }

    fn snapshot(&mut self, moment: &Moment<B, D>) -> Result<(), RunCaseError> {
        Ok(B::write_frame(&self.folder, moment, self.site_volume)?)
    }

    fn checkpoint(
        &mut self,
        checkpoint: &Checkpoint<B::Kept, D>,
        motion: &Motion<D>,
        cost: &Cost,
    ) -> Result<(), RunCaseError> {
        self.flush()?;
        let path = self.folder.join(CHECKPOINT_FILE);
        let plane = |number: usize, give: Give<'_, f64>| motion.plane(number, give);
        record::checkpoint::write_with(&path, &self.case_id, checkpoint, |_| motion.nodes(), plane)?;
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
