//! What the store holds, as the report wants it.

mod pulse;
mod solid;

use std::path::{Path, PathBuf};

use crate::analysis::series::{Series, Setting};
use crate::cli::choices;
use crate::cli::specimen::slab::end;
use crate::cli::survey::{Entry, Survey};
use crate::domain::MessageCost;
use crate::durable;
use crate::plan::{self, SCALING};
use crate::record::{self, CHECKPOINT_FILE, FIELDS_FILE, RecordError, SERIES_FILE};
use crate::report::{CaseResult, Failure, Film, Manifest, OtherStudy, Phase, Scaling, Specimen, Study};
use crate::setup::{self, Estimator};
use crate::store::{self, Attempt, State};
use crate::study::case::{Body, Case, Loading, Slab};

/// A study with the results of all its cases, also of those that failed or are missing, and what others have of them.
pub fn gather(survey: &Survey, others: Vec<OtherStudy>) -> Study {
    let scaling = scaling(survey);
    let mut estimator = Estimator::default();
    let mut comparisons = survey.plan.comparisons.clone();
    if scaling.is_some() {
        comparisons.retain(|comparison| comparison.table != SCALING);
    }
    Study {
        name: survey.plan.study.clone(),
        title: survey.plan.title.clone(),
        question: survey.plan.question.clone(),
        text: survey.plan.source().to_owned(),
        figure_width: survey.plan.figure_width,
        stages: survey.plan.stages.clone(),
        scaling,
        comparisons,
        others,
        side_by_side: survey.plan.side_by_side.clone(),
        cases: survey
            .entries
            .iter()
            .map(|entry| {
                let mut result = case_result(survey, entry, true);
                // Where this machine cannot hold the mesh its specimen is not told.
                let case = &entry.planned.case;
                match (estimator.specimen(case), &case.body) {
                    (Ok(setup::Specimen::Slab(laid)), Body::Slab(slab)) if is_pulse(slab) => {
                        pulse::tell(&mut result, slab, &laid);
                    }
                    (Ok(setup::Specimen::Slab(laid)), _) => result.specimen = Some(specimen(&laid)),
                    (Ok(setup::Specimen::Solid(laid)), Body::Solid(solid)) => solid::tell(&mut result, solid, &laid),
                    _ => (),
                }
                result
            })
            .collect(),
    }
}

/// Whether the report shows a slab as it shows solids: no crack is followed in it.
fn is_pulse(slab: &Slab) -> bool {
    matches!(slab.loading, Loading::Pulse { .. })
}

fn specimen(laid: &setup::slab::estimate::Specimen) -> Specimen {
    let geometry = &laid.geometry;
    let both = |size: setup::Size| [size.asked, size.actual];
    Specimen {
        length: both(geometry.length),
        width: both(geometry.width),
        height_between_grips: both(geometry.height),
        crack: geometry.notch.map(|notch| both(notch.length)),
        notch_end: geometry.notch.map(|notch| end(notch.end)),
        leftover_share: laid.leftovers.map(|leftovers| leftovers.share()),
        leftover_where: laid.leftovers.map(|leftovers| leftovers.places()).unwrap_or_default(),
        grip_thickness: geometry.grip_thickness,
        grip_speed: geometry.grip_speed,
        computation: laid.computation,
    }
}

/// The most ranks for which a report predicts.
const MOST_RANKS: u32 = 512;

/// How the specimen would be cut between up to [`MOST_RANKS`] ranks, which double.
fn scaling(survey: &Survey) -> Option<Scaling> {
    let growth = survey.plan.scaling?;
    let case = &survey.plan.cases.first()?.case;
    let counts: Vec<u32> = (0..=MOST_RANKS.ilog2()).map(|power| 1 << power).collect();
    let burdens = setup::burdens(case, case.execution.ranks?, growth, &counts);
    // Where this machine cannot hold the mesh there is nothing to predict from.
    let burdens = burdens.unwrap_or_default();
    let compared = survey.plan.comparisons.iter().cloned();
    Some(Scaling {
        growth,
        burdens,
        compared: compared.filter(|comparison| comparison.table == SCALING).collect(),
    })
}

/// What became of a case, with its pictures if they are wanted.
pub fn case_result(survey: &Survey, entry: &Entry, with_film: bool) -> CaseResult {
    let mut result = CaseResult {
        name: entry.planned.name.clone(),
        id: entry.id.clone(),
        resolved: plan::write_case(&entry.planned),
        choices: choices::of_case(&plan::spelled(&entry.planned.case)),
        origin: entry.planned.origin.clone(),
        swept: entry.planned.swept.clone(),
        repeat_of: entry.planned.repeat_of.clone(),
        manifest: Manifest {
            state: entry.state.word().to_owned(),
            ..Manifest::default()
        },
        ..CaseResult::default()
    };
    match &entry.state {
        State::Done(done) => {
            result.manifest = manifest(done);
            let folder = survey.store.run_folder(&entry.id);
            result.digest = survey.plan.scaling.and_then(|_| digest(&folder));
            if let Err(error) = read(&mut result, &entry.planned.case, &folder, with_film) {
                result.failure = Some(failure(error.to_string(), ""));
            }
        }
        State::Failed(failed) => {
            set_kept(
                &mut result,
                &entry.planned.case,
                &survey.store.partial_folder(&entry.id),
            );
            result.manifest.version = failed.program.version.clone();
            result.manifest.commit = failed.program.commit.clone();
            result.manifest.ended = Some(moment(failed.ended));
            result.failure = Some(failure(failed.meaning.clone(), &failed.log_tail.join("\n")));
        }
        State::Partial(attempt) | State::Running(attempt) => set_reached(&mut result.manifest, attempt.as_ref()),
        State::Corrupt { why } => result.failure = Some(failure(format!("the run is damaged: {why}"), "")),
        State::Missing => {}
    }
    result
}

/// What a failed run has kept; that nothing can be read is no second failure.
fn set_kept(result: &mut CaseResult, case: &Case, folder: &Path) {
    if read(result, case, folder, true).is_err() && case.slab().is_some() {
        // A killed solver leaves segments, which tell nothing of the specimen.
        result.series = record::read_segments(folder).unwrap_or_default();
    }
}

/// Reads what a run has left: its setting, its series and, if it took any and they are wanted, its pictures.
fn read(result: &mut CaseResult, case: &Case, folder: &Path, with_film: bool) -> Result<(), RecordError> {
    match &case.body {
        Body::Slab(slab) if is_pulse(slab) => pulse::read(result, folder),
        Body::Slab(_) => {
            let (setting, series, film) = read_run(folder, with_film)?;
            result.setting = Some(setting);
            result.series = series;
            result.film = film;
            Ok(())
        }
        Body::Solid(body) => solid::read(result, body, folder, with_film),
    }
}

/// Hash of all that a run has computed, so that runs of one case can be compared; `None` where it cannot be read.
fn digest(folder: &Path) -> Option<String> {
    let mut hash = blake3::Hasher::new();
    for name in [SERIES_FILE, FIELDS_FILE, CHECKPOINT_FILE] {
        hash.update(&durable::read(&folder.join(name)).ok()?);
    }
    Some(hash.finalize().to_hex().to_string())
}

/// What a run has left: setting, series and, if it took any and they are wanted, pictures.
type Run = (Setting, Series, Option<Film>);

fn read_run(folder: &Path, with_film: bool) -> Result<Run, RecordError> {
    let (setting, series) = record::read_series(&folder.join(SERIES_FILE))?;
    let fields: PathBuf = folder.join(FIELDS_FILE);
    if !with_film || !fields.exists() {
        return Ok((setting, series, None));
    }
    let (mesh, frames) = record::read_fields(&fields)?;
    Ok((setting, series, Some(Film::stored(mesh, frames))))
}

fn manifest(done: &store::Manifest) -> Manifest {
    let outcome = &done.outcome;
    let phase = |phase: &store::Phase| Phase {
        name: phase.name.clone(),
        calls: phase.calls,
        seconds: phase.seconds,
    };
    Manifest {
        state: "done".to_owned(),
        version: done.program.version.clone(),
        commit: done.program.commit.clone(),
        host: done.host.clone(),
        ranks: Some(done.ranks),
        threads: Some(done.threads),
        started: Some(moment(done.started)),
        ended: Some(moment(done.ended)),
        wall_seconds: Some(done.wall_seconds),
        core_seconds: outcome.core_seconds,
        end_reason: Some(outcome.end_reason.clone()),
        time_step: Some(outcome.time_step_ps),
        stability_limit: Some(outcome.stability_limit_ps),
        steps: Some(outcome.steps),
        energy_error: outcome.energy_error_relative,
        closest_approach: outcome.closest_approach_spacings,
        peak_memory: outcome.peak_memory_bytes.map(|bytes| bytes as f64),
        cost: outcome.cost.iter().map(phase).collect(),
        messages: outcome.messages.map(|messages| MessageCost {
            latency: messages.latency_s,
            a_byte: messages.seconds_a_byte,
            reduction: messages.reduction_s,
        }),
    }
}

fn set_reached(manifest: &mut Manifest, attempt: Option<&Attempt>) {
    let Some(attempt) = attempt else { return };
    manifest.version = attempt.program.version.clone();
    manifest.commit = attempt.program.commit.clone();
    manifest.started = Some(moment(attempt.started));
    manifest.wall_seconds = Some(attempt.wall_seconds);
    manifest.steps = attempt.reached.map(|reached| reached.step);
}

fn failure(reason: String, log_tail: &str) -> Failure {
    Failure {
        reason,
        log_tail: log_tail.to_owned(),
    }
}

fn moment(time: jiff::Timestamp) -> String {
    time.strftime("%F %T UTC").to_string()
}
