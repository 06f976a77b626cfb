//! The first lines of a report of solids: what came out, how near to the finest, whether it worked, and for what effort.

use super::overview::curve_distance;
use super::{Analysed, reference};
use crate::report::numbers::{capital, significant};
use crate::report::units::{GIGAPASCAL, METRE_PER_SECOND, PERCENT};
use crate::units::amounts::{bytes, duration};

/// More cases than this are left to the table.
const MOST_NAMED: usize = 4;

pub fn sentences(cases: &[Analysed]) -> Vec<String> {
    let told: Vec<&Analysed> = cases
        .iter()
        .filter(|case| case.series().is_some())
        .take(MOST_NAMED)
        .collect();
    let answers = told.iter().filter_map(|case| answer(case));
    let mut sentences: Vec<String> = match answers.collect::<Vec<_>>() {
        answers if answers.is_empty() => Vec::new(),
        answers => vec![format!("{}.", capital(&answers.join("; ")))],
    };
    sentences.extend(nearness(cases));
    sentences.extend(warning(cases));
    sentences.push(done(cases));
    sentences.extend(effort(cases));
    sentences
}

/// `atoms: first bond broken at 1.75 % strain, greatest stress 1.2 GPa`
fn answer(case: &Analysed) -> Option<String> {
    let three = |value: f64| significant(value, 3);
    let when = |strain: Option<f64>, time: f64| match strain {
        Some(strain) => format!("{} % strain", three(strain * PERCENT)),
        None => format!("{} ps", three(time)),
    };
    let found = &case.findings;
    let mut parts = Vec::new();
    if let Some((period, _)) = found.period.filter(|_| found.first_break.is_none()) {
        parts.push(format!("period {} ps", significant(period, 4)));
    }
    if let Some((modulus, bar)) = found.modulus_at_rest.zip(case.solid.specimen.bar) {
        parts.push(format!(
            "at rest a Young's modulus of {} GPa, with which a thin bar has a period of {} ps",
            significant(modulus * GIGAPASCAL, 4),
            significant(bar.period(modulus), 4)
        ));
    }
    if let Some((speed, expected)) = found.wave_speed.zip(case.solid.specimen.wave_speed) {
        parts.push(format!(
            "the pulse goes from the first to the last gauge at {} m/s, {} % against long waves in the crystal",
            significant(speed * METRE_PER_SECOND, 4),
            significant(PERCENT * (speed / expected - 1.0), 2)
        ));
    }
    if let Some(start) = found.first_break {
        parts.push(format!("bonds first change at {}", when(start.strain, start.time)));
    }
    if let Some(peak) = found.peak {
        let stress = three(peak.stress * GIGAPASCAL);
        parts.push(format!(
            "greatest stress {stress} GPa at {}",
            when(peak.strain, peak.time)
        ));
    }
    (!parts.is_empty()).then(|| format!("{}: {}", case.name(), parts.join(", ")))
}

/// How far the cheapest is from the finest, and what it saves.
fn nearness(cases: &[Analysed]) -> Option<String> {
    let cost = |case: &Analysed| case.result.core_seconds();
    let measured = cases.iter().filter_map(|case| Some((case, reference(cases, case)?)));
    let others = measured.filter(|(case, finest)| !std::ptr::eq(*case, *finest) && case.series().is_some());
    let (cheapest, finest) = others.min_by(|a, b| {
        let [a, b] = [a, b].map(|(case, _)| cost(case).unwrap_or(f64::INFINITY));
        a.total_cmp(&b)
    })?;
    let far = curve_distance(cheapest, finest)?;
    let gain = cost(finest)? / cost(cheapest)?;
    Some(format!(
        "The stress of {} is on average {} % of its greatest from that of {}, at {} of its core-seconds.",
        cheapest.name(),
        significant(PERCENT * far, 2),
        finest.name(),
        match gain {
            gain if gain >= 1.0 => format!("1/{}", significant(gain, 2)),
            gain => format!("{} times", significant(1.0 / gain, 2)),
        }
    ))
}

/// Energy that is missing beyond this share of the work is told first.
const MUCH_MISSING: f64 = 0.01;

fn warning(cases: &[Analysed]) -> Option<String> {
    // Nothing works on what stands still at rest.
    let moving = cases.iter().filter(|case| case.findings.modulus_at_rest.is_none());
    let missing = moving.filter(|case| {
        case.result
            .manifest
            .energy_error
            .is_some_and(|error| error > MUCH_MISSING)
    });
    let names: Vec<&str> = missing.map(super::Analysed::name).collect();
    (!names.is_empty()).then(|| {
        format!(
            "Beware: in {} more than {} % of the work is missing from the energies: the time step or the summation is too \
             coarse.",
            names.join(", "),
            PERCENT * MUCH_MISSING
        )
    })
}

pub fn done(cases: &[Analysed]) -> String {
    let failed = cases.iter().filter(|case| case.result.failure.is_some()).count();
    let done = cases.iter().filter(|case| case.result.manifest.state == "done").count();
    let all = cases.len();
    let noun = if all == 1 { "case" } else { "cases" };
    match failed {
        0 => format!("{done} of {all} {noun} done."),
        _ => format!("{done} of {all} {noun} done, {failed} failed."),
    }
}

fn effort(cases: &[Analysed]) -> Option<String> {
    let seconds = cases
        .iter()
        .filter_map(|case| case.result.core_seconds())
        .reduce(|a, b| a + b)?;
    let memory = cases.iter().filter_map(|case| case.result.manifest.peak_memory);
    let most = memory.max_by(f64::total_cmp).map(|most| bytes(most as u64));
    let memory = most.map_or(String::new(), |most| format!(", and {most} of memory at most"));
    Some(format!("They took {} of a core in all{memory}.", duration(seconds)))
}
