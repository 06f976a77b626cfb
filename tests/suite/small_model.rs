//! Models A to E of Deng (2011) at a tenth of their size, as the shipped study computes them: the numbers that they gave when the
//! time step came to follow the bonds. Those after the start hang on the probe: waves in so small a slab swing J from -3 to 15.

use std::sync::atomic::AtomicBool;

use cgaft::analysis::series::Setting;
use cgaft::analysis::stress_intensity::Refusal;
use cgaft::analysis::{self, Findings};
use cgaft::domain::Ranks;
use cgaft::plan::plan;
use cgaft::record::{SERIES_FILE, read_series};
use cgaft::setup::run_case;
use cgaft::study;

/// Results do not depend on the machine; this leaves room for a probe or two when the order of a sum changes.
const ROUNDING: f64 = 0.01;

/// 1 eV/nm^2.5 in MPa √m. [CODATA 2018]
const MEGAPASCAL_ROOT_METRE: f64 = 160.217_663_4 * 3.162_277_660_168_379_4e-5;

fn small_model(name: &str) -> (Setting, Findings) {
    let plan = plan(&study::read("models-A-E-small.yaml").expect("it is shipped")).expect("it is right");
    let planned = plan
        .cases
        .iter()
        .find(|planned| planned.name == name)
        .expect("it is there");
    let folder = tempfile::tempdir().expect("there is room");
    let (stop, mut quiet) = (AtomicBool::new(false), |_: &str| ());
    let case = &planned.case;
    run_case(case, folder.path(), Ranks::alone(), 1, &stop, &mut |_| (), &mut quiet).expect("it runs to its end");
    let (setting, series) = read_series::<Setting>(&folder.path().join(SERIES_FILE)).expect("it is published");
    let findings = analysis::analyse(&series, &setting);
    (setting, findings)
}

/// What a model gave; `None` where nothing is to be told.
struct Given {
    model: &'static str,
    /// Strain at the start and at the first branch.
    start: f64,
    branch: Option<f64>,
    /// MPa √m
    near_tip: Option<f64>,
    from_j: Option<f64>,
    /// Highest speed over that of Rayleigh waves.
    speed: f64,
}

#[rustfmt::skip]
const GIVEN: [Given; 5] = [
    Given { model: "A", start: 0.031_616, branch: None, near_tip: None, from_j: None, speed: 0.738_0 },
    Given { model: "B", start: 0.025_907, branch: None, near_tip: None, from_j: Some(2.076), speed: 0.553_4 },
    Given { model: "C", start: 0.025_468, branch: None, near_tip: None, from_j: Some(2.042), speed: 0.444_4 },
    Given { model: "D", start: 0.026_017, branch: None, near_tip: None, from_j: Some(1.500), speed: 0.134_8 },
    Given { model: "E", start: 0.016_320, branch: None, near_tip: Some(1.286), from_j: Some(1.247), speed: 0.559_4 },
];

#[test]
fn where_the_fit_and_the_rings_do_not_hold_there_is_a_reason_and_no_number() {
    for (model, near_tip, from_j) in [
        ("A", Refusal::FewBins, Some(Refusal::NoRings)),
        ("D", Refusal::NotPositive, None),
    ] {
        let (_, findings) = small_model(model);
        assert_eq!(findings.near_tip_refused, Some(near_tip), "{model}");
        assert!(findings.near_tip.is_none(), "{model}");
        assert_eq!(findings.from_j_refused, from_j, "{model}");
        assert_eq!(findings.from_j.is_none(), from_j.is_some(), "{model}");
    }
}

#[test]
fn the_small_models_give_the_numbers_that_they_gave() {
    let mut wrong = Vec::new();
    for given in GIVEN {
        let (setting, findings) = small_model(given.model);
        let root_metre = |value: f64| value * MEGAPASCAL_ROOT_METRE;
        let found = [
            (
                "strain at the start",
                findings.initiation.map(|start| start.strain),
                Some(given.start),
            ),
            (
                "strain at the first branch",
                findings.first_branch().map(|branch| branch.strain),
                given.branch,
            ),
            (
                "K near the tip",
                findings.near_tip.map(|fit| root_metre(fit.value)),
                given.near_tip,
            ),
            ("K of J", findings.from_j.map(|k| root_metre(k.value)), given.from_j),
            (
                "speed",
                findings.peak_speed().map(|speed| speed / setting.rayleigh_speed),
                Some(given.speed),
            ),
        ];
        for (what, value, expected) in found {
            let agrees = match (value, expected) {
                (Some(value), Some(expected)) => (value / expected - 1.0).abs() < ROUNDING,
                (value, expected) => value.is_none() && expected.is_none(),
            };
            if !agrees {
                wrong.push(format!("{what} of {}: {value:?} instead of {expected:?}", given.model));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
