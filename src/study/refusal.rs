//! What only material and mesh reveal of a case, told at its place in the study file.

use super::{
    file::{AtCutoff, CaseFile, Loading, Observe, Potential, StrainRate},
    finding::{Finding, Place},
    reader::Given,
};
use std::fmt;

/// A case that is sound as a text but not as physics: what is wrong, where to look, and what to do next.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    pub subject: Subject,
    pub message: String,
    pub help: String,
    /// What else takes part, with what is to be seen there.
    pub related: Option<(Subject, &'static str)>,
}

/// The part of a case that a refusal is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    Cutoff,
    Length,
    Width,
    Element,
    Rate,
    Crack,
    /// The strain or the time that ends the run.
    Until,
    /// The crack length that ends it.
    UntilCrackLength,
    /// The rest of the crack that ends it.
    UntilArrest,
    TimeStep,
    Probes,
    Snapshots,
    Sponge,
    Damping,
    /// The faces of a solid that are held or move.
    Face,
    /// What is cut in a solid.
    Notch,
    Summation,
    Mass,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}; {}", self.message, self.help)
    }
}

impl Refusal {
    pub fn new(subject: Subject, message: impl Into<String>, help: impl Into<String>) -> Self {
        Self {
            subject,
            message: message.into(),
            help: help.into(),
            related: None,
        }
    }

    pub fn with(mut self, subject: Subject, what: &'static str) -> Self {
        self.related = Some((subject, what));
        self
    }

    /// The refusal at its place in the case as typed.
    pub(crate) fn finding(&self, typed: &Given<CaseFile>) -> Finding {
        let mut finding = Finding::whole(&self.message).help(&self.help);
        finding.place = self.subject.place(typed);
        if finding.place.is_none() {
            // It is a default: what else takes part was typed.
            finding.place = self.related.and_then(|(subject, _)| subject.place(typed));
            return finding;
        }
        match self
            .related
            .and_then(|(subject, what)| Some((subject.place(typed)?, what)))
        {
            Some((place, what)) => finding.with(place, what),
            None => finding,
        }
    }
}

impl Subject {
    /// Where a case says it, or else the section that it was left out of.
    fn place(self, typed: &Given<CaseFile>) -> Option<Place> {
        let case = typed.right()?;
        match self {
            Self::Cutoff => cutoff(&case.material.right()?.potential),
            Self::Length => case.specimen.right()?.length.place().or(case.specimen.place()),
            Self::Width => case.specimen.right()?.width.place().or(case.specimen.place()),
            Self::Element => case.resolution.right()?.element.place().or(case.resolution.place()),
            Self::Rate => strain_rate(case)?.rate.place().or(case.loading.place()),
            Self::Until => {
                let until = &case.run.right()?.until;
                let values = until.right()?;
                values.strain.place().or(values.time.place()).or(until.place())
            }
            Self::Crack => case.crack.right()?.length.place().or(case.crack.place()),
            Self::UntilCrackLength => {
                let until = &case.run.right()?.until;
                until.right()?.crack_length.place().or(until.place())
            }
            Self::UntilArrest => {
                let until = &case.run.right()?.until;
                until.right()?.arrest.place().or(until.place())
            }
            Self::Snapshots => {
                let every = case
                    .observe
                    .right()?
                    .iter()
                    .find_map(|observed| match observed.right()? {
                        Observe::Snapshots(values) => values.every.place().or(observed.place()),
                        _ => None,
                    });
                every.or(case.observe.place())
            }
            Self::Sponge => strain_rate(case)?.sponge.place().or(case.loading.place()),
            Self::Damping => strain_rate(case)?.damping.place().or(case.loading.place()),
            Self::Face => case.held.place().or(case.loading.place()),
            Self::Notch => case.notch.place(),
            Self::Summation => case.run.right()?.summation.place().or(case.run.place()),
            Self::Mass => case.run.right()?.mass.place().or(case.run.place()),
            Self::TimeStep => case.run.right()?.time_step.place().or(case.run.place()),
            Self::Probes => case.probes.right()?.every.place().or(case.probes.place()),
        }
    }
}

fn strain_rate(case: &CaseFile) -> Option<&StrainRate> {
    match case.loading.right()? {
        Loading::StrainRate(values) => Some(values),
        _ => None,
    }
}

/// The cutoff, or the end of a smooth one.
fn cutoff(potential: &Given<Potential>) -> Option<Place> {
    let (cutoff, at_cutoff) = match potential.right()? {
        Potential::LennardJones(values) => (&values.cutoff, &values.at_cutoff),
        Potential::Morse(values) => (&values.cutoff, &values.at_cutoff),
        Potential::HarmonicBond(values) => (&values.cutoff, &values.at_cutoff),
    };
    let end = match at_cutoff.right() {
        Some(AtCutoff::Smooth(smooth)) => smooth.to.place(),
        _ => None,
    };
    cutoff.place().or(end).or(potential.place())
}
