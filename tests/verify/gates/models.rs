//! Model E of Deng (2011) at a tenth of its size, until some time after its first branch.

use std::sync::atomic::AtomicBool;

use cgaft::analysis::history::history;
use cgaft::analysis::series::Series;
use cgaft::analysis::series::Setting;
use cgaft::domain::Ranks;
use cgaft::plan::plan;
use cgaft::record::{SERIES_FILE, read_series};
use cgaft::setup::run_case;
use cgaft::solver::Ending;
use cgaft::study;

use crate::verify::table::{Chapter, Gate};

#[test]
fn a_run_goes_on_for_the_asked_time_after_the_first_branch() {
    const AFTER: f64 = 4.0;
    let text = study::read("models-A-E-small.yaml").expect("it is shipped");
    let plan = plan(&text).expect("it is right");
    let named = plan.cases.iter().find(|planned| planned.name == "E");
    let mut case = named.expect("model E is there").case.clone();
    // Far beyond the strain at which it branches.
    case.run.until.strain = Some(0.06);
    case.run.until.after_branch = Some(AFTER);
    let folder = tempfile::tempdir().expect("there is room");
    let (stop, mut quiet) = (AtomicBool::new(false), |_: &str| ());
    let finished =
        run_case(&case, folder.path(), Ranks::alone(), 1, &stop, &mut |_| (), &mut quiet).expect("it runs to its end");
    assert!(matches!(finished.ending, Ending::AfterBranch(_)), "{}", finished.ending);
    let (setting, series) = read_series::<Setting>(&folder.path().join(SERIES_FILE)).expect("it is published");
    let has_branched = |probes: usize| {
        let part = Series {
            probes: series.probes[..probes].to_vec(),
            bonds: series
                .bonds
                .iter()
                .filter(|bond| (bond.probe as usize) < probes)
                .copied()
                .collect(),
            ..Series::default()
        };
        history(&part, &setting)
            .is_some_and(|history| history.branches.iter().any(|arm| arm.parent.is_some() && !arm.joined))
    };
    let number = (1..=series.probes.len())
        .find(|&probes| has_branched(probes))
        .expect("it has branched");
    let [.., before_last, last] = &series.probes[..] else {
        panic!("there are probes");
    };
    let [after, interval] = [series.probes[number - 1], *before_last].map(|probe| last.time - probe.time);
    let mut gate = Gate::new(Chapter::Fracture, "10 after a branch");
    let claim = "time that a run goes on after its first branch, ps, to a probe";
    gate.near(
        claim,
        "model E, small, until 4 ps after a branch",
        after,
        AFTER + 0.5 * interval,
        0.5 * interval,
    );
    gate.close();
}
