//! Leaving a run and going on with it.

use super::checkpoint::Checkpoint;
use super::crack::Crack;
use super::{Solver, SolverError};
use crate::forces::Planes;
use crate::lattice::triangular;

impl Solver {
    /// Everything that a later run needs to go on from here. All ranks must call this together; only the first has the
    /// whole.
    pub fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            position: self.state.position.clone(),
            velocity: self.state.velocity.clone(),
            ..self.checkpoint_without_motion()
        }
    }

    /// The same with no positions and velocities.
    pub(super) fn checkpoint_without_motion(&self) -> Checkpoint {
        Checkpoint {
            step: self.step,
            time: self.time,
            time_step: self.time_step,
            stability_limit: self.stability_limit,
            position: Planes::default(),
            velocity: Planes::default(),
            open_interfaces: self.forces.open_interfaces(),
            start: self.ledger.start(),
            grip_impulses: self.grip_impulse.gathered(self.ranks()),
            absorbed: self.loading.absorbed(self.ranks()),
            peak_work: self.ledger.peak_work(),
            peak_imbalance: self.ledger.peak_imbalance(),
            broken_bonds: self.broken.clone(),
            parted_bonds: self.crack.as_ref().map_or_else(Vec::new, Crack::parted),
            joins: self
                .crack
                .as_ref()
                .map_or_else(Vec::new, |crack| crack.joins().to_vec()),
            probes: self.probes.taken(),
            snapshots: self.snapshots.taken(),
            last_advance: self.stop.last_advance(),
            farthest_tip: self.stop.farthest_tip(),
            damage_front: self.stop.front(),
            branched: self.stop.branched(),
            left_plane: self.stop.left_plane(),
        }
    }

    /// Goes back to where a checkpoint was made; one of another specimen changes nothing.
    pub fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), SolverError> {
        self.check_is_of_this_specimen(checkpoint)
            .map_err(SolverError::OtherSpecimen)?;
        self.step = checkpoint.step;
        self.time = checkpoint.time;
        self.time_step = checkpoint.time_step;
        self.stability_limit = checkpoint.stability_limit;
        self.state.position.clone_from(&checkpoint.position);
        self.state.velocity.clone_from(&checkpoint.velocity);
        self.forces.restore_open_interfaces(&checkpoint.open_interfaces);
        self.compute(false).map_err(|source| self.blow_up(source))?;
        self.grip_impulse.restore(&checkpoint.grip_impulses);
        self.loading
            .restore_absorbed(&checkpoint.absorbed, &self.forces.domain().nodes());
        self.ledger
            .restore(checkpoint.start, checkpoint.peak_work, checkpoint.peak_imbalance);
        self.broken.clone_from(&checkpoint.broken_bonds);
        self.crack = Crack::new(&self.setting);
        if let Some(crack) = &mut self.crack {
            crack.go_on_from(&checkpoint.parted_bonds, &checkpoint.joins);
        }
        self.probes.restore(checkpoint.probes, checkpoint.step);
        self.snapshots.restore(checkpoint.snapshots, checkpoint.step);
        let Checkpoint {
            last_advance,
            farthest_tip,
            damage_front,
            branched,
            left_plane,
            ..
        } = *checkpoint;
        self.stop
            .restore(last_advance, [farthest_tip, damage_front], [branched, left_plane]);
        Ok(())
    }

    fn check_is_of_this_specimen(&self, checkpoint: &Checkpoint) -> Result<(), &'static str> {
        let Checkpoint { position, velocity, .. } = checkpoint;
        let nodes = self.state.nodes();
        if position.iter().chain(velocity).any(|axis| axis.len() != nodes) {
            return Err("it has another number of nodes");
        }
        if checkpoint.grip_impulses.len() != self.loading.held().count() {
            return Err("its grips hold another number of nodes");
        }
        if checkpoint.absorbed.len() != self.loading.sponge_size() {
            return Err("its sponges have another number of elements");
        }
        let interfaces = self.forces.interface_count();
        if checkpoint
            .open_interfaces
            .iter()
            .any(|&number| number as usize >= interfaces)
        {
            return Err("it has other interfaces");
        }
        let mesh = self.mesh();
        let exists = |[column, row, direction]: [i32; 3]| {
            usize::try_from(direction).is_ok_and(|direction| direction < triangular::NEAREST.len())
                && mesh.owner_of([column, row]).is_some()
        };
        let parted = checkpoint.parted_bonds.iter();
        let parted = parted.map(|bond| [bond.column, bond.row, i32::from(bond.direction)]);
        if checkpoint.broken_bonds.iter().copied().chain(parted).all(exists) {
            Ok(())
        } else {
            Err("it has bonds of other sites")
        }
    }
}
