//! Leaving a run and going on with it.

use std::array;

use super::Solver;
use super::body::Instruments;
use super::checkpoint::Checkpoint;
use super::clock::Clock;
use super::error::SolverError;
use super::observer::Motion;

impl<B: Instruments<D>, const D: usize> Solver<B, D> {
    /// Everything that a later run needs to go on from here. All ranks must call this together; only the first has the
    /// whole.
    pub fn checkpoint(&self) -> Checkpoint<B::Kept, D> {
        self.motion().complete(&self.checkpoint_without_motion())
    }

    /// Positions and velocities of all nodes.
    pub(super) fn motion(&self) -> Motion<'_, D> {
        Motion {
            domain: self.body.domain(),
            state: &self.state,
        }
    }

    /// The same with no positions and velocities.
    pub(super) fn checkpoint_without_motion(&self) -> Checkpoint<B::Kept, D> {
        Checkpoint {
            step: self.clock.step,
            time: self.clock.time,
            time_step: self.clock.time_step,
            step_after_next: self.step_after_next,
            longest_step: self.longest_step,
            stability_limit: self.stability_limit,
            position: array::from_fn(|_| Vec::new()),
            velocity: array::from_fn(|_| Vec::new()),
            open_interfaces: self.body.open_interfaces(),
            start: self.ledger.start(),
            refined_energy: self.ledger.refined(),
            peak_work: self.ledger.peak_work(),
            peak_imbalance: self.ledger.peak_imbalance(),
            closest_approach: self.body.closest_approach(),
            probes: self.probes.taken(),
            snapshots: self.snapshots.taken(),
            looks: self.looks.taken(),
            kept: self.body.keep(),
        }
    }

    /// Goes back to where a checkpoint was made; one of another specimen changes nothing.
    pub fn restore(&mut self, checkpoint: &Checkpoint<B::Kept, D>) -> Result<(), SolverError> {
        let Checkpoint { position, velocity, .. } = checkpoint;
        let nodes = position[0].len();
        if position.iter().chain(velocity).any(|axis| axis.len() != nodes) {
            return Err(SolverError::OtherSpecimen(
                "its nodes have unequal numbers of coordinates",
            ));
        }
        self.body
            .go_to_mesh_of(&checkpoint.kept, nodes, &mut self.state)
            .map_err(SolverError::OtherSpecimen)?;
        self.body
            .check_is_own(&checkpoint.open_interfaces, &checkpoint.kept)
            .map_err(SolverError::OtherSpecimen)?;
        self.clock = Clock {
            step: checkpoint.step,
            time: checkpoint.time,
            time_step: checkpoint.time_step,
        };
        self.step_after_next = checkpoint.step_after_next;
        self.longest_step = checkpoint.longest_step;
        self.stability_limit = checkpoint.stability_limit;
        let planes = self.state.position.iter_mut().chain(&mut self.state.velocity);
        for (plane, kept) in planes.zip(position.iter().chain(velocity)) {
            for nodes in self.body.domain().nodes() {
                plane[nodes.clone()].copy_from_slice(&kept[nodes]);
            }
        }
        self.body.restore(&checkpoint.open_interfaces, &checkpoint.kept);
        self.compute(false).map_err(|source| self.blow_up(source))?;
        self.ledger.restore(
            checkpoint.start,
            checkpoint.refined_energy,
            [checkpoint.peak_work, checkpoint.peak_imbalance],
        );
        self.body.restore_closest_approach(checkpoint.closest_approach);
        self.probes.restore(checkpoint.probes, checkpoint.step);
        self.snapshots.restore(checkpoint.snapshots, checkpoint.step);
        self.looks.restore(checkpoint.looks, checkpoint.step);
        Ok(())
    }
}
