//! What a run says about its crack: pure functions of series, no input or output.

pub mod columns;
pub mod comparison;
pub mod crack;
pub mod crack_surface;
pub mod damage;
pub mod frame;
pub mod history;
pub mod initiation;
pub mod passage;
pub mod path;
pub mod regression;
pub mod scaling;
pub mod scatter;
pub mod series;
pub mod speed;
pub mod stress_intensity;
pub mod waves;

use crack::Tip;
use frame::Frame;
use history::{Branch, FirstBond, Join, LeavesPlane, PartedElsewhere};
use initiation::Initiation;
use series::{Series, Setting};
use speed::Speed;
use stress_intensity::{Ahead, FromJ, NearTip, Refusal};
use waves::Arrival;

/// Everything extracted from one case. Internal units (nm, ps, eV); what was not detected is `None` or empty.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// The foremost tip at every probe; empty without a crack.
    pub tips: Vec<Tip>,
    /// The tree of cracks at the end of the run; the first entry is the main crack.
    pub branches: Vec<Branch>,
    /// When the first bond of the crack breaks, and when the crack sets out for good.
    pub first_bond: Option<FirstBond>,
    pub initiation: Option<Initiation>,
    /// When the crack joins one ahead of it, which is neither a speed nor a branch.
    pub joins: Vec<Join>,
    /// When a path of the crack first leaves the crack plane.
    pub leaves_plane: Option<LeavesPlane>,
    /// When the specimen parts along a band that is no part of the crack.
    pub parted_elsewhere: Option<PartedElsewhere>,
    /// Width of the window in time over which speeds are fitted, ps.
    pub speed_window: Option<f64>,
    /// Crack speed at every probe; `None` before initiation and where the window holds too few probes.
    pub speeds: Vec<Option<Speed>>,
    /// Share of the time from initiation to the last advance that has a speed.
    pub speed_share: Option<f64>,
    /// The stress ahead of the tip at the probe before initiation.
    pub ahead: Vec<Ahead>,
    /// Near-tip fit of the stress intensity at the probe before initiation, or why there is none.
    pub near_tip: Option<NearTip>,
    pub near_tip_refused: Option<Refusal>,
    /// Stress intensity of the J-integral at the same probe, or why there is none.
    pub from_j: Option<FromJ>,
    pub from_j_refused: Option<Refusal>,
    /// Stress intensity at which the elastic energy pays for the surfaces, eV/nm^2.5.
    pub griffith: Option<f64>,
    pub arrivals: Vec<Arrival>,
}

/// Extracts everything from the series of one case.
pub fn analyse(series: &Series, setting: &Setting) -> Findings {
    let frame = Frame::of(setting);
    frame.findings(in_its_frame(&frame.series(series), &frame.setting(setting)))
}

fn in_its_frame(series: &Series, setting: &Setting) -> Findings {
    let Some(history) = history::history(series, setting) else {
        return Findings::default();
    };
    let initiation = initiation::initiation(&history.tips, series, setting);
    let window = speed::window(series, setting);
    let speeds = speed::speeds(&history.tips, series, initiation, window, &history.joined(), setting);
    let before = initiation.and_then(|start| start.probe.checked_sub(1));
    let near_tip = before.map(|probe| stress_intensity::near_tip(series, probe, history.tips[probe], setting));
    let from_j = before.map(|probe| stress_intensity::from_j(series, probe, setting));
    Findings {
        speed_share: initiation.and_then(|start| speed::share(&history.tips, start.probe, &speeds)),
        ahead: before.map_or_else(Vec::new, |probe| {
            stress_intensity::ahead(series, probe, history.tips[probe].x).collect()
        }),
        arrivals: waves::arrivals(&history.tips, initiation, series, setting),
        tips: history.tips,
        branches: history.branches,
        first_bond: history.first_bond,
        joins: history.joins,
        leaves_plane: history.leaves_plane,
        parted_elsewhere: history.parted_elsewhere,
        initiation,
        speed_window: window,
        speeds,
        near_tip: near_tip.and_then(Result::ok),
        near_tip_refused: near_tip.and_then(Result::err),
        from_j: from_j.and_then(Result::ok),
        from_j_refused: from_j.and_then(Result::err),
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

    /// The earliest branch off the main crack or off another branch; what a join leaves of the old tip is none.
    pub fn first_branch(&self) -> Option<&Branch> {
        self.branches
            .iter()
            .filter(|branch| branch.parent.is_some() && !branch.joined)
            .min_by_key(|branch| branch.probe)
    }
}
