//! Repeats of one case with noise of their own: what they scatter by, and how long they stay together.

use super::numbers::{count, significant};
use super::quantity::Quantity;
use super::{Analysed, CaseResult};
use crate::analysis::scatter::{Parting, Scatter, parting};

/// What is told of repeats, in the order in which it is shown.
pub const TOLD: [Quantity; 7] = [
    Quantity::InitiationStrain,
    Quantity::InitiationTime,
    Quantity::PeakSpeed,
    Quantity::BranchTime,
    Quantity::BranchStrain,
    Quantity::BranchAngle,
    Quantity::ArrestTime,
];

/// Two runs whose starts differ by less, in spacings, differ by next to nothing: how soon they part is chaos alone.
const NEXT_TO_NOTHING: f64 = 1e-8;

/// All repeats of one case.
pub struct Repeats<'a> {
    /// The name of what they repeat.
    pub name: &'a str,
    pub cases: Vec<&'a Analysed<'a>>,
}

/// The repeats of a study, in its order.
pub fn all<'a>(cases: &'a [Analysed<'a>]) -> Vec<Repeats<'a>> {
    let mut all: Vec<Repeats> = Vec::new();
    for case in cases {
        let Some(name) = case.result.repeat_of.as_deref() else {
            continue;
        };
        match all.iter_mut().find(|repeats| repeats.name == name) {
            Some(repeats) => repeats.cases.push(case),
            None => all.push(Repeats {
                name,
                cases: vec![case],
            }),
        }
    }
    all
}

impl Repeats<'_> {
    /// `None` where no two repeats have the quantity.
    pub fn scatter(&self, quantity: Quantity) -> Option<Scatter> {
        Scatter::of(self.cases.iter().filter_map(|case| quantity.value(case)))
    }

    /// Of the noise of their starts, in spacings.
    pub fn amplitude(&self) -> Option<f64> {
        amplitude(self.cases.first()?.result)
    }

    /// How long each repeat that is done stays with the first; `None` in it: to the end.
    pub fn partings(&self) -> Vec<Option<Parting>> {
        let mut done = self.cases.iter().filter(|case| !case.result.series.probes.is_empty());
        let Some(first) = done.next() else {
            return Vec::new();
        };
        done.map(|case| parting(&first.result.series, &case.result.series))
            .collect()
    }
}

fn amplitude(case: &CaseResult) -> Option<f64> {
    let (_, value) = case.choices.iter().find(|(key, _)| key == "run.noise.amplitude")?;
    value.parse().ok()
}

/// What the repeats of a study say, a sentence or two for each case; empty without repeats.
pub fn sentences(cases: &[Analysed]) -> Vec<String> {
    let mut sentences = Vec::new();
    for repeats in all(cases) {
        let scatters = TOLD.into_iter().filter_map(|quantity| {
            let scatter = repeats.scatter(quantity)?;
            Some((quantity, scatter))
        });
        let parts: Vec<String> = scatters.map(|(quantity, scatter)| told(quantity, &scatter)).collect();
        let computed = repeats
            .cases
            .iter()
            .filter(|case| case.result.setting.is_some())
            .count();
        if !parts.is_empty() {
            sentences.push(format!(
                "{}, {computed} repeats, median and quartiles: {}.",
                repeats.name,
                parts.join("; ")
            ));
        }
        sentences.extend(together(&repeats));
    }
    sentences
}

/// `crack starts after (ps): 176 (175 to 178)`
fn told(quantity: Quantity, scatter: &Scatter) -> String {
    let shown = |value: f64| quantity.shown(value, None);
    match scatter.has_parted() {
        true => format!(
            "{} {} ({} to {})",
            quantity.label(),
            shown(scatter.median),
            shown(scatter.lower),
            shown(scatter.upper)
        ),
        false => format!("{} {}, not sampled", quantity.label(), shown(scatter.median)),
    }
}

/// Until when a single run is evidence of which bonds break.
fn together(repeats: &Repeats) -> Option<String> {
    let amplitude = repeats.amplitude().filter(|&amplitude| amplitude < NEXT_TO_NOTHING)?;
    let partings = repeats.partings();
    let all = partings.len();
    let parted: Vec<Parting> = partings.into_iter().flatten().collect();
    let first = parted.iter().min_by(|a, b| a.time.total_cmp(&b.time));
    let Some(first) = first else {
        return (all > 0).then(|| {
            format!(
                "{}: runs that differ by {amplitude:e} spacings at the start break the same bonds to their end.",
                repeats.name
            )
        });
    };
    let latest = parted.iter().map(|parting| parting.time).fold(first.time, f64::max);
    Some(format!(
        "{}: of {all} runs that differ from the first by {amplitude:e} spacings at the start {} part from it, {} to {} ps \
         after the start of the run; until then, {} steps, a single run tells which bonds break.",
        repeats.name,
        parted.len(),
        significant(first.time, 4),
        significant(latest, 4),
        count(first.step)
    ))
}
