//! When a crack has come far enough, has come to rest or has left its plane.

use crate::analysis::initiation;
use crate::analysis::series::Setting;
use crate::solver::until::{Ending, Until};

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

    /// The first reason to stop at this moment that is the crack's.
    pub fn ending(&self, until: &Until, time: f64) -> Option<Ending> {
        let set_out = self.farthest > self.notch + self.threshold;
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
    fn the_crack_length_is_that_of_the_farthest_tip() {
        let until = Until {
            strain: Some(0.5),
            crack_length: Some(30.0),
            ..Until::default()
        };
        let mut watch = watch();
        watch.follow(29.0, 29.0, 40.0);
        assert_eq!(watch.ending(&until, 40.0), None);
        watch.follow(30.5, 30.5, 41.0);
        watch.follow(20.0, 20.0, 42.0);
        assert_eq!(watch.ending(&until, 42.0), Some(Ending::CrackLength(30.5)));
    }

    #[test]
    fn a_run_goes_on_for_a_time_after_the_first_branch() {
        let until = Until {
            strain: Some(0.5),
            after_branch: Some(20.0),
            ..Until::default()
        };
        let mut watch = watch();
        assert_eq!(watch.ending(&until, 90.0), None);
        watch.branch(91.0);
        watch.branch(95.0);
        assert_eq!(watch.ending(&until, 110.0), None);
        let ending = watch.ending(&until, 111.0);
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
        assert_eq!(watch.ending(&until, 90.0), None, "it only opened some bonds");
        watch.follow(15.0, 15.0, 91.0);
        assert_eq!(watch.ending(&until, 100.0), None);
        assert_eq!(watch.ending(&until, 111.0), Some(Ending::Arrest(20.0)));
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
        assert_eq!(watch.ending(&until, 111.0), None);
        assert_eq!(watch.farthest_tip(), 15.0, "the tip hangs together with the notch");
        watch.follow(17.0, 17.0, 120.0);
        let ending = watch.ending(&until, 125.0);
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
        assert_eq!(watch.ending(&until, 90.0), None);
        watch.leave_plane(91.0);
        watch.leave_plane(95.0);
        assert_eq!(watch.ending(&until, 140.0), None);
        let ending = watch.ending(&until, 141.0);
        assert_eq!(ending, Some(Ending::LeavesPlane(50.0)));
        let mut resumed = super::tests::watch();
        resumed.restore(
            watch.last_advance(),
            [watch.farthest_tip(), watch.front()],
            [watch.branched(), watch.left_plane()],
        );
        assert_eq!(resumed.ending(&until, 141.0), ending);
    }
}
