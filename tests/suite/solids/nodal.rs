//! Solids of which only the bonds of nodes are summed: [Deng2011] Eq. (3-33).

use super::*;

#[test]
fn the_ledger_closes_whether_blocks_stay_together_or_part() {
    let [(_, mesh), ..] = meshes();
    let settings = Settings {
        summation: Summation::Nodal,
        time_step: TimeStep::Auto { fraction: 0.125 },
        ..settings(8.0)
    };
    for (experiment, opens) in [
        (pulled(&mesh, 0.1, true), false),
        (hit(&mesh), true),
        (pulled(&mesh, 0.5, true), true),
    ] {
        let mut solver = solver(&mesh, experiment, settings.clone());
        let (keeper, _) = run(&mut solver);
        assert!(last(&keeper.columns, "work") > 0.1);
        assert_eq!(last(&keeper.columns, "open_interfaces") > 0.0, opens);
        let error = solver.ledger().relative_error().expect("work has been done");
        assert!(error < ENERGY_ERROR, "{error:e}");
    }
}
