//! When to stop, time step, what to observe, and how the case is carried out.

use super::{At, Check, nanometres, specimen::SpecimenAt};
use crate::study::{
    case::{
        Crack, Edge, Execution, MOST_RANKS, MOST_THREADS, MassMatrix, Probes, Run, SnapshotInterval, Snapshots,
        Summation, TimeStep, Until,
    },
    defaults,
    file::{self, Interval, Observe},
    finding::{Finding, Place},
    quantity::{Fraction, Time},
    reader::Given,
};
use crate::units::{self, Dimension};

/// Stop conditions that speak of the crack, and where they were given.
#[derive(Clone, Copy)]
pub struct CrackStops {
    crack_length: Option<At<f64>>,
    arrest: Option<At<f64>>,
    after_branch: Option<At<f64>>,
    leaves_the_plane: Option<At<f64>>,
}

/// Nominal strain beyond which nothing holds together.
const MOST_STRAIN: f64 = 1.0;

/// No crystal comes to rest under a strain beyond this, in tension or in compression.
const MOST_RELAX: f64 = 0.2;

/// No edge of an element has bonds for so many points; as many points as bonds are the sum over all of them.
const MOST_POINTS: u32 = 100;

/// Checkpoints more often than this leave no time for steps, s, and more rarely than this there are none.
const FASTEST_CHECKPOINTS: f64 = 1e-3;
const RAREST_CHECKPOINTS: f64 = 1e7;

/// A step of a smaller share of the limit gains no accuracy: rounding of the steps takes over.
const LEAST_FRACTION: f64 = 1e-3;

impl CrackStops {
    /// Where they were given.
    pub fn places(self) -> impl Iterator<Item = Place> {
        let stops = [self.crack_length, self.arrest, self.after_branch, self.leaves_the_plane];
        stops.into_iter().flatten().map(|(_, place)| place)
    }
}

impl Check<'_> {
    /// The run, and its stop conditions, which may be known although the whole is not.
    pub fn run(&self, given: &Given<file::Run>, case: Place) -> (Option<Run>, Option<CrackStops>) {
        let Some((values, place)) = self.section(given, case) else {
            return (None, None);
        };
        let (until, stops) = self.until(&values.until, place).unzip();
        let time_step = self.time_step(&values.time_step);
        let summation = self.summation(&values.summation);
        let mass = self.mass_matrix(&values.mass);
        let start = self.relax(&values.relax, &values.until).zip(self.noise(&values.noise));
        let parts = until.zip(time_step).zip(summation.zip(mass)).zip(start);
        let run = parts.map(|(((until, time_step), (summation, mass)), (relax, noise))| Run {
            until,
            time_step,
            summation,
            mass,
            relax,
            noise,
        });
        (run, stops)
    }

    fn summation(&self, given: &Given<file::Summation>) -> Option<Summation> {
        match given {
            Given::Absent => Some(defaults::SUMMATION),
            Given::Wrong(_) => None,
            Given::Right(file::Summation::Exact, _) => Some(Summation::Exact),
            Given::Right(file::Summation::Nodal, _) => Some(Summation::Nodal),
            Given::Right(file::Summation::Gauss(given), _) => {
                let (points, place, strict) = match given {
                    Given::Absent | Given::Wrong(_) => return None,
                    Given::Right(file::Gauss::Points(points), place) => (*points, *place, false),
                    Given::Right(file::Gauss::Rule(rule), section) => {
                        let points = self.need(&rule.points, *section, "gauss.points", "2");
                        let strict = self.choice(&rule.strict, false);
                        let (points, place) = points?;
                        (points, place, strict?)
                    }
                };
                if points == 0 {
                    let message = "a string without Gauss points would be held at its ends alone";
                    self.add(Finding::at(place, message).help("write `summation: {gauss: 2}`, `exact` or `nodal`"));
                    return None;
                }
                if points > MOST_POINTS {
                    let message = format!("{points} Gauss points are more than any edge has bonds");
                    self.add(Finding::at(place, message).help("write `summation: exact`, which sums every bond"));
                    return None;
                }
                Some(match strict {
                    false => Summation::Gauss { points },
                    true => Summation::StrictGauss { points },
                })
            }
        }
    }

    fn mass_matrix(&self, given: &Given<file::MassMatrix>) -> Option<MassMatrix> {
        match given {
            Given::Absent => Some(defaults::MASS),
            Given::Wrong(_) => None,
            Given::Right(file::MassMatrix::Lumped, _) => Some(MassMatrix::Lumped),
            Given::Right(file::MassMatrix::Consistent, _) => Some(MassMatrix::Blend(1.0)),
            Given::Right(file::MassMatrix::Blend(share), _) => {
                let Given::Right(share, place) = *share else {
                    return None;
                };
                if share == 0.0 {
                    return Some(MassMatrix::Lumped);
                }
                if share > 0.0 && share <= 1.0 {
                    return Some(MassMatrix::Blend(share));
                }
                let message =
                    format!("the share of the consistent mass matrix must be from 0 to 1, and {share} is not");
                self.add(Finding::at(place, message).help("write `mass: {blend: 0.65}`, `lumped` or `consistent`"));
                None
            }
        }
    }

    /// The strain of the start; the outer `None` is a mistake.
    fn relax(&self, given: &Given<file::Relax>, until: &Given<file::Until>) -> Option<Option<f64>> {
        let (values, section) = match given {
            Given::Absent => return Some(None),
            Given::Wrong(_) => return None,
            Given::Right(values, place) => (values, *place),
        };
        let (start, place) = self.need(&values.strain, section, "relax.strain", "0.4 %")?;
        if start.value.abs() > MOST_RELAX {
            let most = MOST_RELAX * 100.0;
            let message =
                format!("no crystal comes to rest under a strain of {start}: it breaks or folds before {most} %");
            self.add(Finding::at(place, message).help("start just below the strain at which the crack starts"));
            return None;
        }
        if start.value < 0.0 {
            let message = format!(
                "a start at a strain of {start} is compression, in which the crystal may fold and the faces of a crack touch"
            );
            self.add(Finding::at(place, message).help("start at 0 % or above, such as 0.4 %: the grips only part"));
            return None;
        }
        let end = until.right().and_then(|until| match until.strain {
            Given::Right(end, place) => Some((end, place)),
            _ => None,
        });
        if let Some((end, given)) = end.filter(|(end, _)| end.value <= start.value) {
            let message = format!("the run would stop at once: it starts from a strain of {start} and stops at {end}");
            self.add(
                Finding::at(place, message)
                    .with(given, "the end")
                    .help("start from a lower strain"),
            );
            return None;
        }
        Some(Some(start.value))
    }

    fn until(&self, given: &Given<file::Until>, run: Place) -> Option<(Until, CrackStops)> {
        let (values, place) = self.need(given, run, "run.until", "{strain: 1.2 %}")?;
        if matches!((&values.strain, &values.time), (Given::Absent, Given::Absent)) {
            let message = "nothing is sure to stop this run: `until` has neither a strain nor a time";
            self.add(Finding::at(place, message).help("write `strain: 1.2 %` or `time: 200 ps` into `until`"));
        }
        let strain = self.size_if_given(&values.strain, "until.strain");
        let time = self.size_if_given(&values.time, "until.time");
        let crack_length = self.size_if_given(&values.crack_length, "until.crack-length");
        let arrest = self.size_if_given(&values.arrest, "until.arrest");
        let after_branch = self.size_if_given(&values.after_branch, "until.after-branch");
        let leaves_the_plane = self.size_if_given(&values.leaves_the_plane, "until.leaves-the-plane");
        let (strain, time, crack_length, arrest) = (strain?, time?, crack_length?, arrest?);
        let (after_branch, leaves_the_plane) = (after_branch?, leaves_the_plane?);
        strain.or(time)?;
        if let Some((strain, place)) = strain
            && strain > MOST_STRAIN
        {
            let message = format!(
                "a strain of {} more than doubles the specimen, and no bond bears that",
                units::format(strain, Dimension::Fraction)
            );
            self.add(Finding::at(place, message).help("write for example 3.5 %"));
        }
        let value = |at: Option<At<f64>>| at.map(|(value, _)| value);
        let until = Until {
            strain: value(strain),
            time: value(time),
            crack_length: value(crack_length),
            arrest: value(arrest),
            after_branch: value(after_branch),
            leaves_the_plane: value(leaves_the_plane),
        };
        let stops = CrackStops {
            crack_length,
            arrest,
            after_branch,
            leaves_the_plane,
        };
        Some((until, stops))
    }

    /// Stop conditions that speak of the crack must be able to come true, and not at once.
    pub fn stops(&self, stops: CrackStops, crack: Option<&At<Crack>>, specimen: &SpecimenAt) {
        let Some((crack, given)) = crack else {
            let waits = [
                stops.crack_length,
                stops.arrest,
                stops.after_branch,
                stops.leaves_the_plane,
            ];
            for (_, place) in waits.iter().flatten() {
                let message = "this waits for a crack, and the case has none";
                self.add(Finding::at(*place, message).help("give a `crack`, or stop at a strain or a time"));
            }
            return;
        };
        let Some((length, place)) = stops.crack_length else {
            return;
        };
        let (notch, behind, from) = match crack.edge {
            Edge::Left | Edge::Right => (crack.length, 0.0, ""),
            Edge::None { center } => (crack.measured(), center, " from the middle of its notch"),
        };
        if length <= notch {
            let [start, end] = [notch, length].map(nanometres);
            let message = format!(
                "the run would stop at once: the crack is {start} long{from} at the start, and it stops at {end}"
            );
            self.add(
                Finding::at(place, message)
                    .with(*given, "the crack")
                    .help("stop at a longer crack"),
            );
        }
        if let Some((whole, given)) = specimen.length
            && length > whole - behind
        {
            let message = format!(
                "no crack can grow to {}{from} in a specimen of {}",
                nanometres(length),
                nanometres(whole)
            );
            self.add(
                Finding::at(place, message)
                    .with(given, "the specimen")
                    .help("stop at a shorter crack"),
            );
        }
    }

    fn time_step(&self, given: &Given<file::TimeStep>) -> Option<TimeStep> {
        match given {
            Given::Absent => Some(defaults::TIME_STEP),
            Given::Wrong(_) => None,
            Given::Right(file::TimeStep::Auto, _) => Some(defaults::TIME_STEP),
            Given::Right(file::TimeStep::Given(step), place) => self
                .positive(*step, *place, "run.time-step")
                .map(|(step, _)| TimeStep::Given(step)),
            Given::Right(file::TimeStep::Fraction(fraction), _) => {
                let Given::Right(fraction, place) = *fraction else {
                    return None;
                };
                if (LEAST_FRACTION..=1.0).contains(&fraction) {
                    return Some(TimeStep::Auto { fraction });
                }
                let message = format!(
                    "the time step must be from {LEAST_FRACTION} to 1 of the stability limit, and {fraction} is not"
                );
                self.add(Finding::at(place, message).help("write `time-step: auto` for a safe fraction"));
                None
            }
        }
    }

    pub fn execution(&self, given: &Given<file::Run>) -> Option<Execution> {
        let (values, _) = self.section(given, Place::default())?;
        let ranks = self.counted(&values.ranks, "run.ranks", MOST_RANKS);
        let threads = self.counted(&values.threads, "run.threads", MOST_THREADS);
        let every = self.size_if_given(&values.checkpoint_every, "run.checkpoint-every")?;
        let usual = FASTEST_CHECKPOINTS..RAREST_CHECKPOINTS;
        if let Some((every, place)) = every.filter(|(every, _)| !usual.contains(every)) {
            let message = match every < FASTEST_CHECKPOINTS {
                true => "checkpoints more often than a thousand times a second leave no time for steps",
                false => "a checkpoint in four months or more is none",
            };
            self.add(Finding::at(place, message).help("write for example `checkpoint-every: 10 min`"));
            return None;
        }
        Some(Execution {
            ranks: ranks?,
            threads: threads?,
            checkpoint_every: every.map_or(defaults::CHECKPOINT_EVERY, |(every, _)| every),
        })
    }

    pub fn probes(&self, given: &Given<file::Probes>) -> Option<Probes> {
        let (values, _) = self.section(given, Place::default())?;
        let every = self.size_if_given(&values.every, "probes.every")?;
        let every = every.map_or(defaults::PROBES_EVERY, |(every, _)| every);
        Some(Probes { every })
    }

    /// What tells of a crack alone must not be asked of a case without one.
    pub fn observes_no_crack(&self, given: &Given<Vec<Given<Observe>>>) {
        for item in given.right().into_iter().flatten() {
            let (what, place) = match item {
                Given::Right(Observe::Crack, place) => ("crack", place),
                Given::Right(Observe::WaveArrival, place) => ("wave-arrival", place),
                _ => continue,
            };
            let message = format!("`{what}` tells of a crack, and the case has none");
            self.add(Finding::at(*place, message).help("leave it out, or give a `crack`"));
        }
    }

    pub fn snapshots(&self, given: &Given<Vec<Given<Observe>>>) -> Option<Snapshots> {
        let items = match given {
            Given::Absent => return Some(Snapshots { every: None }),
            Given::Wrong(_) => return None,
            Given::Right(items, _) => items,
        };
        let mut asked = items.iter().filter_map(|item| match item {
            Given::Right(Observe::Snapshots(snapshots), place) => Some((snapshots, *place)),
            _ => None,
        });
        let Some((snapshots, first)) = asked.next() else {
            return Some(Snapshots { every: None });
        };
        if let Some((_, second)) = asked.next() {
            self.add(
                Finding::at(second, "snapshots are asked for twice")
                    .with(first, "here first")
                    .help("keep one of the two"),
            );
            return None;
        }
        let (every, place) = self.need(&snapshots.every, first, "snapshots.every", "0.05 % strain")?;
        let every = match every {
            Interval::Strain(strain) => {
                SnapshotInterval::Strain(self.positive(Fraction::new(strain), place, "snapshots.every")?.0)
            }
            Interval::Time(time) => SnapshotInterval::Time(self.positive(Time::new(time), place, "snapshots.every")?.0),
        };
        Some(Snapshots { every: Some(every) })
    }
}
