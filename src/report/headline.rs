//! The quantities for which a study is run, each with what is not known of it.

use super::Analysed;
use super::tables::first_branch;
use super::units::{GIGAPASCAL, MEGAPASCAL_ROOT_METRE, PERCENT};

/// A value, and what it is not known to.
pub type Measured = (f64, Option<f64>);

/// A quantity of a case that a question is about.
pub struct Headline {
    /// Part of a file name.
    pub id: &'static str,
    /// Column of the table `summary`, and what a number of it is multiplied by to be the one shown here.
    pub column: &'static str,
    pub factor: f64,
    /// As a sentence and an axis name it.
    pub name: &'static str,
    pub unit: &'static str,
    /// What the number behind ± is.
    pub error: &'static str,
    /// The value, and what it is not known to.
    pub of: fn(&Analysed) -> Option<Measured>,
}

pub const START: Headline = Headline {
    id: "start",
    column: "initiation_strain",
    factor: PERCENT,
    name: "strain at the start of the crack",
    unit: "%",
    error: "one probe",
    of: |case| {
        let start = case.findings.initiation?;
        let before = start.probe.checked_sub(1);
        let before = before.and_then(|before| case.result.series.probes.get(before));
        let gap = before.map(|before| (start.strain - before.strain) * PERCENT);
        Some((start.strain * PERCENT, gap))
    },
};

pub const K: Headline = Headline {
    id: "k",
    column: "k_ic_j_integral_mpa_sqrt_m",
    factor: 1.0,
    name: "K at the start by the J-integral",
    unit: "MPa √m",
    // How well the rings agree is no error of K.
    error: "",
    of: |case| Some((case.findings.from_j?.value * MEGAPASCAL_ROOT_METRE, None)),
};

const K_NEAR_TIP: Headline = Headline {
    id: "k-near-tip",
    column: "k_ic_near_tip_mpa_sqrt_m",
    factor: 1.0,
    name: "K at the start near the tip",
    unit: "MPa √m",
    error: "the standard error of the fit",
    of: |case| {
        let fit = case.findings.near_tip?;
        Some((
            fit.value * MEGAPASCAL_ROOT_METRE,
            Some(fit.error * MEGAPASCAL_ROOT_METRE),
        ))
    },
};

pub const SPEED: Headline = Headline {
    id: "speed",
    column: "peak_speed_over_c_r",
    factor: 1.0,
    name: "highest crack speed",
    unit: "c_R",
    error: "the standard error of the fit",
    of: |case| {
        let speeds = case.findings.speeds.iter().flatten();
        let peak = speeds.max_by(|a, b| a.value.total_cmp(&b.value))?;
        let rayleigh = case.rayleigh_speed()?;
        Some((peak.value / rayleigh, Some(peak.error / rayleigh)))
    },
};

const BRANCH: Headline = Headline {
    id: "branch",
    column: "first_branch_time_ps",
    factor: 1.0,
    name: "first branch after the start",
    unit: "ps",
    error: "",
    of: |case| Some((first_branch::after_start(case)?, None)),
};

pub const STRESS: Headline = Headline {
    id: "stress",
    column: "",
    factor: 1.0,
    name: "largest mean stress across the specimen",
    unit: "GPa",
    error: "",
    of: |case| {
        let stresses = case
            .result
            .series
            .probes
            .iter()
            .map(|probe| probe.sigma_yy * GIGAPASCAL);
        Some((stresses.filter(|stress| stress.is_finite()).reduce(f64::max)?, None))
    },
};

const COST: Headline = Headline {
    id: "cost",
    column: "",
    factor: 1.0,
    name: "cost of the run",
    unit: "core-seconds",
    error: "",
    of: |case| Some((case.core_seconds()?, None)),
};

/// All of them, in the order in which they are read; those of a crack where there is one.
pub fn all(cases: &[Analysed]) -> Vec<&'static Headline> {
    match cases.iter().any(Analysed::has_crack) {
        true => vec![&START, &K, &K_NEAR_TIP, &SPEED, &BRANCH, &COST],
        false => vec![&STRESS, &COST],
    }
}
