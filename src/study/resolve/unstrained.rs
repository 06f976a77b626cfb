//! What speaks of a strain under a loading that makes none.

use super::Check;
use crate::study::{
    file::{CaseFile, Interval, Observe},
    finding::Finding,
    reader::Given,
};

impl Check<'_> {
    /// Refuses ends and pictures by strain. `help` tells what to do.
    pub fn refuse_strains(&self, case: &CaseFile, help: &str) {
        let until = case.run.right().and_then(|run| run.until.right());
        if let Some(place) = until.and_then(|until| until.strain.place()) {
            let message = "this loading makes no strain of its own, at which the run could end";
            self.add(Finding::at(place, message).help(help));
        }
        for item in case.observe.right().into_iter().flatten() {
            if let Given::Right(Observe::Snapshots(snapshots), _) = item
                && let Given::Right(Interval::Strain(_), place) = snapshots.every
            {
                let message = "this loading makes no strain of its own, by which pictures could be taken";
                self.add(Finding::at(place, message).help(help));
            }
        }
    }
}
