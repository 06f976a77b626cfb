//! Runs of solids that are stopped and go on.

use std::convert::Infallible;
use std::sync::atomic::{AtomicBool, Ordering};

use cgaft::mesh::solid::Solid as Mesh;
use cgaft::solver::checkpoint::Checkpoint;
use cgaft::solver::solid::{Experiment, Kept, Row};
use cgaft::solver::{Cost, Ending, Moment, Motion, Observer, Progress, Solid, SolverError};

use super::{Keeper, hit, meshes, opposed, pulled, run, settings, solver};

#[test]
fn a_run_from_a_checkpoint_ends_with_the_same_bits() {
    for (name, mesh) in meshes() {
        for experiment in [&pulled_fast as &dyn Fn(&Mesh) -> Experiment, &hit] {
            let mut whole = solver(&mesh, experiment(&mesh), settings(6.0));
            let (whole_kept, ending) = run(&mut whole);
            assert!(matches!(ending, Ending::Time(_)), "{ending}");
            let mut first = solver(&mesh, experiment(&mesh), settings(6.0));
            let mut kept = Keeper::new(&first);
            let stop = AtomicBool::new(false);
            struct StopAt<'a>(&'a mut Keeper, &'a AtomicBool);
            impl Observer<Solid, 3> for StopAt<'_> {
                type Error = Infallible;
                fn probe(&mut self, row: &Row) -> Result<(), Infallible> {
                    self.1.store(row.numbers[0] > 2.7, Ordering::Relaxed);
                    self.0.probe(row)
                }
                fn snapshot(&mut self, moment: &Moment<Solid, 3>) -> Result<(), Infallible> {
                    self.0.snapshot(moment)
                }
                fn checkpoint(
                    &mut self,
                    checkpoint: &Checkpoint<Kept, 3>,
                    motion: &Motion<3>,
                    cost: &Cost,
                ) -> Result<(), Infallible> {
                    self.0.checkpoint(checkpoint, motion, cost)
                }
                fn progress(&mut self, _: &Progress) {}
            }
            let ending = first.run(&mut StopAt(&mut kept, &stop), &stop).unwrap();
            assert_eq!(ending, Ending::Interrupted);
            let mut second = solver(&mesh, experiment(&mesh), settings(6.0));
            second.restore(kept.checkpoints.last().unwrap()).unwrap();
            let (rest, _) = run(&mut second);
            kept.columns.append(rest.columns).unwrap();
            kept.snapshots.extend(rest.snapshots);
            assert!(second.checkpoint() == whole.checkpoint(), "{name}: end states differ");
            assert_eq!(
                format!("{:?}", kept.columns),
                format!("{:?}", whole_kept.columns),
                "{name}"
            );
            assert_eq!(kept.snapshots, whole_kept.snapshots, "{name}");
        }
    }
}

/// Fast enough to open interfaces.
fn pulled_fast(mesh: &Mesh) -> Experiment {
    pulled(mesh, 1.0, false)
}

#[test]
fn a_checkpoint_of_another_solid_is_refused_and_changes_nothing() {
    let [elements, mixed, _] = meshes().map(|(_, mesh)| mesh);
    let mut own_solver = solver(&elements, pulled(&elements, 0.1, false), settings(1.0));
    let own = own_solver.checkpoint();
    let other_mesh = solver(&mixed, pulled(&mixed, 0.1, false), settings(1.0)).checkpoint();
    let other_loading = solver(&elements, opposed(&elements), settings(1.0)).checkpoint();
    let mut interfaces = own.clone();
    interfaces.open_interfaces = vec![u32::MAX];
    for foreign in [other_mesh, other_loading, interfaces] {
        let refused = own_solver.restore(&foreign);
        assert!(matches!(refused, Err(SolverError::OtherSpecimen(_))), "{refused:?}");
        assert!(own_solver.checkpoint() == own);
    }
}
