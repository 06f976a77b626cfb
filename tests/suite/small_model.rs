//! Model E of Deng (2011) at a tenth of its size, as the shipped study computes it: the numbers that it gave first. The
//! other models are those of `make verify`.

use std::sync::atomic::AtomicBool;

use cgaft::analysis::series::Setting;
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
    let (setting, series) = read_series(&folder.path().join(SERIES_FILE)).expect("it is published");
    let findings = analysis::analyse(&series, &setting);
    (setting, findings)
}

#[test]
fn the_small_model_e_gives_the_numbers_that_it_gave() {
    let (setting, findings) = small_model("E");
    let start = findings.initiation.expect("the crack starts");
    let branch = findings.first_branch().expect("it branches");
    let speed = findings.peak_speed().expect("it runs") / setting.rayleigh_speed;
    let [near_tip, from_j] = [
        findings.near_tip.expect("there is a field").value,
        findings.from_j.expect("there is room for rings").value,
    ];
    let found = [
        ("strain at the start", start.strain, 0.016_43),
        ("K near the tip, MPa √m", near_tip * MEGAPASCAL_ROOT_METRE, 1.275),
        ("K of J, MPa √m", from_j * MEGAPASCAL_ROOT_METRE, 1.228),
        ("strain at the first branch", branch.strain, 0.022_27),
        ("crack speed over c_R", speed, 0.425),
    ];
    let off = found
        .iter()
        .filter(|(_, value, expected)| (value / expected - 1.0).abs() > ROUNDING);
    let off: Vec<_> = off.collect();
    assert!(off.is_empty(), "{off:?}");
}
