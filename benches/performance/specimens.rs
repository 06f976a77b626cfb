//! The specimens of `benches/studies`.

use std::path::{Path, PathBuf};

use cgaft::solver::Solver;
use cgaft::study::case::Case;
use cgaft::{plan, setup, study};

use super::clock;

pub fn study(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/studies");
    folder.join(format!("{name}.yaml"))
}

/// A case of a study.
pub fn case(of: &str, name: &str) -> Case {
    let path = study(of);
    let read = study::read(path.to_str().expect("the path is text")).expect("the study is read");
    let plan = plan::plan(&read).expect("the study is sound");
    let found = plan.cases.into_iter().find(|case| case.name == name);
    found.expect("the study has the case").case
}

pub fn solver(of: &str, name: &str) -> Solver {
    let case = case(of, name);
    let slab = case.slab().expect("it is a slab");
    setup::slab::solver(&case, slab).expect("the case starts")
}

/// What a step takes, and what takes it.
#[derive(Clone, Copy)]
pub struct Measured {
    pub elements: usize,
    pub atoms: usize,
    pub open_interfaces: usize,
    /// Seconds of a core.
    pub step: f64,
}

impl Measured {
    /// Millions of represented atoms times steps a second and core.
    pub fn rate(&self) -> f64 {
        1e-6 * self.atoms as f64 / self.step
    }
}

/// Steps between two looks at the stability limit: a sample holds whole such rounds.
const ROUND: usize = 100;

/// Measures the steps of a specimen on one core, at least so many seconds a sample, the looks at the stability limit
/// included, without output.
pub fn measure(name: &str, seconds: f64) -> Measured {
    const SAMPLES: usize = 3;
    clock::with_threads(1, || {
        let mut solver = solver("specimens", name);
        let mut advance = |steps: usize| solver.advance_by(steps as u64).expect("the step is stable");
        let first = clock::core_seconds(|| advance(ROUND));
        let steps = ROUND * ((seconds / first).ceil() as usize).max(1);
        let sample = || clock::core_seconds(|| advance(steps)) / steps as f64;
        let step = clock::median_of(SAMPLES, sample);
        Measured {
            elements: solver.mesh().elements.len(),
            atoms: solver.mesh().sites.len(),
            open_interfaces: solver.checkpoint().open_interfaces.len(),
            step,
        }
    })
}
