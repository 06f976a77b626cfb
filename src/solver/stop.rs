//! When a run has reached its end.

use crate::analysis::initiation;
use crate::analysis::series::Setting;

/// A run stops at whichever of these comes first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Until {
    /// Nominal strain.
    pub strain: Option<f64>,
    /// ps
    pub time: Option<f64>,
    /// From the edge that the crack comes from, or the middle of a notch inside, to the foremost tip, nm.
    pub crack_length: Option<f64>,
    /// The crack has set out and then stood still for this long, ps.
    pub arrest: Option<f64>,
    /// The crack was first seen to have a branch so long ago, ps.
    pub after_branch: Option<f64>,
    /// The crack has left its plane so long ago, ps.
    pub leaves_plane: Option<f64>,
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    Strain(f64),
    Time(f64),
    CrackLength(f64),
    Arrest(f64),
    AfterBranch(f64),
    LeavesPlane(f64),
    /// Asked to stop; a checkpoint is there.
    Interrupted,
}

impl std::fmt::Display for Ending {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Strain(strain) => write!(f, "strain {:.4} % reached", 100.0 * strain),
            Self::Time(time) => write!(f, "time {time:.4} ps reached"),
            Self::CrackLength(tip) => write!(f, "crack length {tip:.3} nm reached"),
            Self::Arrest(time) => write!(f, "crack stood still for {time:.3} ps"),
            Self::AfterBranch(time) => write!(f, "crack branched {time:.3} ps ago"),
            Self::LeavesPlane(time) => write!(f, "crack left its plane {time:.3} ps ago"),
            Self::Interrupted => write!(f, "interrupted"),
        }
    }
}

impl Until {
    /// Steps in all if neither the crack nor a change of the time step ends the run otherwise.
    ///
    /// `time_of` tells when a nominal strain is reached, ps.
    pub fn steps(&self, step: u64, time: f64, time_step: f64, time_of: impl FnOnce(f64) -> f64) -> u64 {
        let end = self
            .strain
            .map(time_of)
            .unwrap_or(f64::INFINITY)
            .min(self.time.unwrap_or(f64::INFINITY));
        step.saturating_add(((end - time) / time_step).round().max(0.0) as u64)
    }
}

/// Follows the foremost tip and the damage ahead of it from probe to probe.
#[derive(Clone, Debug)]
pub struct Watch {
    /// Advance beyond the notch that means that the crack has set out, nm.
    threshold: f64,
    notch: f64,
    farthest: f64,
    /// Foremost bond that has broken in the way of the crack, nm, and when it or the tip last advanced, ps.
    front: f64,
    last_advance: f64,
    /// ps; infinite as long as the crack has no branch.
    branched: f64,
    /// ps; infinite as long as the crack keeps to its plane.
    left_plane: f64,
}

impl Watch {
    pub fn new(setting: &Setting) -> Self {
        let notch = setting.crack_length;
        Self {
            threshold: initiation::far(setting),
            notch,
            farthest: notch,
            front: notch,
            last_advance: 0.0,
            branched: f64::INFINITY,
            left_plane: f64::INFINITY,
        }
    }

    /// Where the foremost tip and the front of the damage are in the frame of the crack, nm, at a time, ps. A crack whose damage
    /// goes on ahead of its tip has not come to rest.
    pub fn follow(&mut self, tip: f64, front: f64, time: f64) {
        if tip.max(front) > self.farthest.max(self.front) {
            self.last_advance = time;
        }
        self.farthest = self.farthest.max(tip);
        self.front = self.front.max(front);
    }

    /// Takes note that the crack has left its plane by a time, ps; the first time counts.
    pub fn leave_plane(&mut self, time: f64) {
        self.left_plane = self.left_plane.min(time);
    }

    /// When the crack left its plane, ps; infinite as long as it keeps to it.
    pub fn left_plane(&self) -> f64 {
        self.left_plane
    }

    /// nm, in the frame of the crack
    pub fn front(&self) -> f64 {
        self.front
    }

    /// Takes note that the crack has a branch at a time, ps; the first time counts.
    pub fn branch(&mut self, time: f64) {
        self.branched = self.branched.min(time);
    }

    /// When the crack first had a branch, ps; infinite as long as it has none.
    pub fn branched(&self) -> f64 {
        self.branched
    }

    /// nm, in the frame of the crack
    pub fn farthest_tip(&self) -> f64 {
        self.farthest
    }

    /// ps
    pub fn last_advance(&self) -> f64 {
        self.last_advance
    }

    pub fn restore(&mut self, last_advance: f64, [farthest, front]: [f64; 2], [branched, left_plane]: [f64; 2]) {
        self.last_advance = last_advance;
        (self.farthest, self.front) = (farthest, front);
        (self.branched, self.left_plane) = (branched, left_plane);
    }

    /// The first reason to stop at this moment; times and strains count within half a step, and a run takes one at least.
    pub fn ending(&self, until: &Until, time: f64, time_step: f64, strain_at: impl Fn(f64) -> f64) -> Option<Ending> {
        let soon = time + 0.5 * time_step;
        let strain_soon = if time > 0.0 { strain_at(soon) } else { 0.0 };
        let set_out = self.farthest > self.notch + self.threshold;
        if until.strain.is_some_and(|end| strain_soon >= end) {
            return Some(Ending::Strain(strain_at(time)));
        }
        if until.time.is_some_and(|end| soon >= end) {
            return Some(Ending::Time(time));
        }
        if until.crack_length.is_some_and(|end| self.farthest >= end) {
            return Some(Ending::CrackLength(self.farthest));
        }
        let still = time - self.last_advance;
        if until.arrest.is_some_and(|end| set_out && still >= end) {
            return Some(Ending::Arrest(still));
        }
        let since = time - self.branched;
        if until.after_branch.is_some_and(|end| since >= end) {
            return Some(Ending::AfterBranch(since));
        }
        let since = time - self.left_plane;
        until
            .leaves_plane
            .filter(|&end| since >= end)
            .map(|_| Ending::LeavesPlane(since))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::series::CrackFrom;

    /// A notch of 10 nm in atoms 0.25 nm apart; the crack has set out beyond 13 nm.
    fn watch() -> Watch {
        let setting = Setting {
            spacing: 0.25,
            crack_length: 10.0,
            element_at_crack: 1,
            ..setting()
        };
        Watch::new(&setting)
    }

    fn at_a_thousandth(time: f64) -> f64 {
        1e-3 * time
    }

    fn setting() -> Setting {
        Setting {
            spacing: 1.0,
            length: 100.0,
            left_x: 0.0,
            height: 50.0,
            crack_row: Some(30),
            crack_from: CrackFrom::Left,
            crack_length: 10.0,
            strain_rate: 1e-3,
            thickness: 1.0,
            longitudinal_speed: 9.0,
            transverse_speed: 5.2,
            rayleigh_speed: 4.8,
            young_modulus: 66.0,
            poisson_ratio: 1.0 / 3.0,
            fracture_energy: 1.8,
            element_at_crack: 1,
            nodes: 1,
            elements: 1,
            represented_atoms: 1,
        }
    }

    #[test]
    fn the_strain_and_the_time_count_within_half_a_step() {
        let until = Until {
            strain: Some(0.02),
            time: Some(25.0),
            ..Until::default()
        };
        let watch = watch();
        assert_eq!(watch.ending(&until, 19.0, 0.2, at_a_thousandth), None);
        assert_eq!(
            watch.ending(&until, 19.95, 0.2, at_a_thousandth),
            Some(Ending::Strain(0.01995))
        );
        let until = Until {
            time: Some(15.0),
            ..until
        };
        assert_eq!(
            watch.ending(&until, 14.95, 0.2, at_a_thousandth),
            Some(Ending::Time(14.95))
        );
    }

    #[test]
    fn the_crack_length_is_that_of_the_farthest_tip() {
        let until = Until {
            strain: Some(0.5),
            crack_length: Some(30.0),
            ..Until::default()
        };
        let mut watch = watch();
        watch.follow(29.0, 29.0, 40.0);
        assert_eq!(watch.ending(&until, 40.0, 0.2, at_a_thousandth), None);
        watch.follow(30.5, 30.5, 41.0);
        watch.follow(20.0, 20.0, 42.0);
        assert_eq!(
            watch.ending(&until, 42.0, 0.2, at_a_thousandth),
            Some(Ending::CrackLength(30.5))
        );
    }

    #[test]
    fn a_run_goes_on_for_a_time_after_the_first_branch() {
        let until = Until {
            strain: Some(0.5),
            after_branch: Some(20.0),
            ..Until::default()
        };
        let mut watch = watch();
        assert_eq!(watch.ending(&until, 90.0, 0.2, at_a_thousandth), None);
        watch.branch(91.0);
        watch.branch(95.0);
        assert_eq!(watch.ending(&until, 110.0, 0.2, at_a_thousandth), None);
        let ending = watch.ending(&until, 111.0, 0.2, at_a_thousandth);
        assert_eq!(ending, Some(Ending::AfterBranch(20.0)));
    }

    #[test]
    fn a_crack_is_arrested_only_after_it_has_set_out() {
        let until = Until {
            strain: Some(0.5),
            arrest: Some(20.0),
            ..Until::default()
        };
        let mut watch = watch();
        watch.follow(12.9, 12.9, 5.0);
        assert_eq!(
            watch.ending(&until, 90.0, 0.2, at_a_thousandth),
            None,
            "it only opened some bonds"
        );
        watch.follow(15.0, 15.0, 91.0);
        assert_eq!(watch.ending(&until, 100.0, 0.2, at_a_thousandth), None);
        assert_eq!(
            watch.ending(&until, 111.0, 0.2, at_a_thousandth),
            Some(Ending::Arrest(20.0))
        );
    }

    #[test]
    fn a_crack_has_not_come_to_rest_while_damage_goes_on_ahead_of_its_tip() {
        let until = Until {
            arrest: Some(20.0),
            ..Until::default()
        };
        let mut watch = watch();
        watch.follow(15.0, 15.0, 91.0);
        watch.follow(15.0, 18.0, 105.0);
        assert_eq!(watch.ending(&until, 111.0, 0.2, at_a_thousandth), None);
        assert_eq!(watch.farthest_tip(), 15.0, "the tip hangs together with the notch");
        watch.follow(17.0, 17.0, 120.0);
        let ending = watch.ending(&until, 125.0, 0.2, at_a_thousandth);
        assert_eq!(ending, Some(Ending::Arrest(20.0)), "the tip only follows");
    }

    #[test]
    fn a_run_goes_on_for_a_time_after_the_crack_has_left_its_plane() {
        let until = Until {
            strain: Some(0.5),
            leaves_plane: Some(50.0),
            ..Until::default()
        };
        let mut watch = watch();
        assert_eq!(watch.ending(&until, 90.0, 0.2, at_a_thousandth), None);
        watch.leave_plane(91.0);
        watch.leave_plane(95.0);
        assert_eq!(watch.ending(&until, 140.0, 0.2, at_a_thousandth), None);
        let ending = watch.ending(&until, 141.0, 0.2, at_a_thousandth);
        assert_eq!(ending, Some(Ending::LeavesPlane(50.0)));
        let mut resumed = super::tests::watch();
        resumed.restore(
            watch.last_advance(),
            [watch.farthest_tip(), watch.front()],
            [watch.branched(), watch.left_plane()],
        );
        assert_eq!(resumed.ending(&until, 141.0, 0.2, at_a_thousandth), ending);
    }
}
