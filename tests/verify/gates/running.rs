//! A running crack.

use cgaft::analysis::history::history;
use cgaft::analysis::initiation::initiation;
use cgaft::analysis::speed::{speeds, window};
use cgaft::mesh::cut::Crack;
use cgaft::mesh::sites::Layout;
use cgaft::mesh::{Mesh, Plan};
use cgaft::solver::Until;

use super::ledger::{run, solver};
use super::{SMOOTH, smooth};
use crate::verify::table::{Chapter, Gate};

#[test]
fn a_crack_in_mode_i_runs_slower_than_surface_waves() {
    let mut gate = Gate::new(Chapter::Fracture, "8 speed");
    let layout = Layout {
        block: 10,
        rows: 10,
        triangles: 59,
    };
    let mesh = Mesh::new(&Plan {
        layout,
        element: 1,
        regions: vec![],
        crack: Some(Crack::of_length(100.0)),
        grip_rows: 10,
        spacing: smooth().spacing,
    });
    let until = Until {
        crack_length: Some(300.0 * smooth().spacing),
        strain: Some(0.1),
        ..Until::default()
    };
    let mut solver = solver(mesh, 2e-4, 0.5, until, 1.0);
    let series = run(&mut solver);
    let setting = solver.setting();
    let history = history(&series, setting).expect("there is a crack");
    let start = initiation(&history.tips, &series, setting);
    let speeds = speeds(
        &history.tips,
        &series,
        start,
        window(&series, setting),
        &history.joined(),
        setting,
    );
    let fastest = speeds
        .into_iter()
        .flatten()
        .map(|speed| speed.value)
        .fold(0.0, f64::max);
    let start = start.expect("the crack starts");
    let name = format!("{SMOOTH}, n = 1, 330 x 71 r0, strain rate 2e-4");
    gate.report("strain at the start of the crack", &name, start.strain);
    gate.below(
        "fastest crack over the Rayleigh speed",
        &name,
        fastest / setting.rayleigh_speed,
        1.0,
    );
    gate.close();
}
