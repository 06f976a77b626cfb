//! What a run says about its crack: pure functions of series, no input or output.

pub mod comparison;
pub mod crack;
pub mod history;
pub mod initiation;
pub mod regression;
pub mod scaling;
pub mod series;
pub mod speed;
pub mod stress_intensity;
pub mod waves;

use crack::Tip;
use history::Branch;
use initiation::Initiation;
use series::{Series, Setting};
use speed::Speed;
use stress_intensity::{FromJ, NearTip};
use waves::Arrival;

/// Everything extracted from one case. Internal units (nm, ps, eV); what was not detected is `None` or empty.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// The foremost tip at every probe; empty without a crack.
    pub tips: Vec<Tip>,
    /// The tree of cracks at the end of the run; the first entry is the main crack.
    pub branches: Vec<Branch>,
    pub initiation: Option<Initiation>,
    /// Width of the window in time over which speeds are fitted, ps.
    pub speed_window: Option<f64>,
    /// Crack speed at every probe; `None` before initiation and where the window holds too few probes.
    pub speeds: Vec<Option<Speed>>,
    /// Near-tip fit of the stress intensity at the probe before initiation.
    pub near_tip: Option<NearTip>,
    /// Stress intensity of the J-integral at the same probe.
    pub from_j: Option<FromJ>,
    /// Stress intensity at which the elastic energy pays for the surfaces, eV/nm^2.5.
    pub griffith: Option<f64>,
    pub arrivals: Vec<Arrival>,
}

/// Extracts everything from the series of one case.
pub fn analyse(series: &Series, setting: &Setting) -> Findings {
    let Some(history) = history::history(series, setting) else {
        return Findings::default();
    };
    let initiation = initiation::initiation(&history.tips, series, setting);
    let window = speed::window(series, setting);
    let speeds = speed::speeds(&history.tips, series, initiation, window, setting);
    let before = initiation.and_then(|start| start.probe.checked_sub(1));
    let near_tip = before.and_then(|probe| stress_intensity::near_tip(series, probe, history.tips[probe], setting));
    let from_j = before.and_then(|probe| stress_intensity::from_j(series, probe, setting));
    Findings {
        arrivals: waves::arrivals(&history.tips, initiation, series, setting),
        tips: history.tips,
        branches: history.branches,
        initiation,
        speed_window: window,
        speeds,
        near_tip,
        from_j,
        griffith: Some(stress_intensity::griffith(setting)),
    }
}

impl Findings {
    /// The highest fitted speed, nm/ps.
    pub fn peak_speed(&self) -> Option<f64> {
        self.speeds
            .iter()
            .flatten()
            .map(|speed| speed.value)
            .max_by(f64::total_cmp)
    }

    /// The earliest branch off the main crack or off another branch.
    pub fn first_branch(&self) -> Option<&Branch> {
        self.branches
            .iter()
            .filter(|branch| branch.parent.is_some())
            .min_by_key(|branch| branch.probe)
    }
}
