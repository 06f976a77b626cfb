//! Models A to E of Deng (2011) at a tenth of their size, as the shipped study computes them.

use std::sync::atomic::AtomicBool;

use cgaft::analysis;
use cgaft::analysis::history::history;
use cgaft::analysis::series::Series;
use cgaft::domain::Ranks;
use cgaft::plan::plan;
use cgaft::record::{SERIES_FILE, read_series};
use cgaft::setup::run_case;
use cgaft::solver::Ending;
use cgaft::study;

use crate::verify::table::{Chapter, Gate};

/// Results do not depend on the machine; this leaves room for a probe or two when the order of a sum changes.
const START: f64 = 0.01;

/// Nominal strain at which the crack starts, as first computed.
const STARTS: [(&str, f64); 5] = [
    ("A", 0.03165),
    ("B", 0.02598),
    ("C", 0.02554),
    ("D", 0.02605),
    ("E", 0.01643),
];

#[test]
fn the_small_models_start_where_they_did() {
    let mut gate = Gate::new(Chapter::Fracture, "9 models");
    let plan = plan(&study::read("models-A-E-small.yaml").expect("it is shipped")).expect("it is right");
    for (planned, (name, expected)) in plan.cases.iter().zip(STARTS) {
        assert_eq!(planned.name, name);
        let folder = tempfile::tempdir().expect("there is room");
        let (stop, mut quiet) = (AtomicBool::new(false), |_: &str| ());
        let alone = Ranks::alone();
        run_case(&planned.case, folder.path(), alone, 1, &stop, &mut |_| (), &mut quiet).expect("it runs to its end");
        let (setting, series) = read_series(&folder.path().join(SERIES_FILE)).expect("it is published");
        let findings = analysis::analyse(&series, &setting);
        let start = findings.initiation.expect("the crack starts");
        let claim = format!("strain at which the crack of model {name} starts");
        let setting = "truncated 0.34 nm, n = 10, a tenth of the size, 1.5e8 /s";
        gate.within(&claim, setting, start.strain, expected, START);
    }
    gate.close();
}

#[test]
fn a_run_goes_on_for_the_asked_time_after_the_first_branch() {
    const AFTER: f64 = 4.0;
    let text = study::read("models-A-E-small.yaml").expect("it is shipped");
    let plan = plan(&text).expect("it is right");
    let named = plan.cases.iter().find(|planned| planned.name == "E");
    let mut case = named.expect("model E is there").case.clone();
    case.run.until.after_branch = Some(AFTER);
    let folder = tempfile::tempdir().expect("there is room");
    let (stop, mut quiet) = (AtomicBool::new(false), |_: &str| ());
    let finished =
        run_case(&case, folder.path(), Ranks::alone(), 1, &stop, &mut |_| (), &mut quiet).expect("it runs to its end");
    assert!(matches!(finished.ending, Ending::AfterBranch(_)), "{}", finished.ending);
    let (setting, series) = read_series(&folder.path().join(SERIES_FILE)).expect("it is published");
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
        history(&part, &setting).is_some_and(|history| history.branches.len() > 1)
    };
    let number = (1..=series.probes.len())
        .find(|&probes| has_branched(probes))
        .expect("it has branched");
    let [.., before_last, last] = &series.probes[..] else {
        panic!("there are probes");
    };
    let [after, interval] = [series.probes[number - 1], *before_last].map(|probe| last.time - probe.time);
    assert!((AFTER..=AFTER + interval).contains(&after), "{after} ps");
}
