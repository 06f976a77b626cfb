//! The first lines of a report: what came out, what to beware of, whether it worked, and for what effort.

mod alone;

use super::headline::{self, Headline};
use super::numbers::{capital, round_significant, significant};
use super::overview::{ROUNDING, between_probes};
use super::sweep::{self, Series};
use super::tables::specimen::are_one_computation;
use super::units::{MEGAPASCAL_ROOT_METRE, PERCENT};
use super::{Analysed, beware, repeats};
use crate::plan::Swept;
use crate::units::amounts::{bytes, duration};

/// More cases than this are left to the table.
const MOST_NAMED: usize = 4;

/// Factors below this are not worth a number.
const ALIKE: f64 = 1.05;

/// `3 of 3 cases done.`
pub fn done(cases: &[Analysed]) -> String {
    let failed = cases.iter().filter(|case| case.result.failure.is_some()).count();
    let done = cases.iter().filter(|case| case.result.manifest.state == "done").count();
    let (all, cases) = (cases.len(), plural(cases.len()));
    match failed {
        0 => format!("{done} of {all} {cases} done."),
        _ => format!("{done} of {all} {cases} done, {failed} failed."),
    }
}

/// `They took 24 min of a core in all, and 281 MB of memory at most.`
fn effort(cases: &[Analysed]) -> Option<String> {
    let seconds = cases.iter().filter_map(Analysed::core_seconds).reduce(|a, b| a + b);
    let memory = cases.iter().filter_map(|case| case.result.manifest.peak_memory);
    let most = memory.max_by(f64::total_cmp).map(|most| bytes(most as u64));
    let memory = most.map_or(String::new(), |most| format!(", and {most} of memory at most"));
    Some(format!("They took {} of a core in all{memory}.", duration(seconds?)))
}

/// Some sentences that answer: what came out, and how sure is it? Then: did it work, and for what effort?
pub fn verdict(cases: &[Analysed]) -> Vec<String> {
    let of_repeats = repeats::sentences(cases);
    let mut sentences = match sweep::series(cases) {
        _ if !of_repeats.is_empty() => of_repeats,
        Some((key, series)) => over_the_sweep(cases, key, &series),
        None => case_by_case(cases),
    };
    sentences.extend(beware::sentences(cases));
    sentences.push(done(cases));
    sentences.extend(effort(cases));
    sentences
}

/// The range of each quantity over the sweep, where its ends are, and which way it goes.
fn over_the_sweep(cases: &[Analysed], key: &Swept, series: &[Series]) -> Vec<String> {
    let wanted: &[&Headline] = match cases.iter().any(Analysed::has_crack) {
        true => &[&headline::START, &headline::K, &headline::SPEED],
        false => &[&headline::STRESS],
    };
    let mut sentences: Vec<String> = wanted
        .iter()
        .filter_map(|headline| range(headline, key, series))
        .collect();
    let still = cases
        .iter()
        .filter(|case| case.has_crack() && case.findings.initiation.is_none());
    let still: Vec<&str> = still
        .filter(|case| !case.result.series.probes.is_empty())
        .map(Analysed::name)
        .collect();
    match still.len() {
        0 => {}
        1..=MOST_NAMED => sentences.push(format!("No crack starts in {}.", still.join(", "))),
        number => sentences.push(format!("No crack starts in {number} of {} cases.", cases.len())),
    }
    sentences
}

/// A value of a case in a sentence: where in the sweep it is, and what it is not known to.
struct Told {
    at: String,
    value: f64,
    error: Option<f64>,
}

impl Told {
    fn noise(&self) -> f64 {
        self.error.unwrap_or(0.0)
    }

    fn number(&self) -> String {
        with_error(self.value, self.error)
    }
}

/// `Strain at the start of the crack falls with crack.length: from 1.42 ± 0.02 % at 10 nm to 0.61 ± 0.02 % at 30 nm.`
fn range(headline: &Headline, key: &Swept, series: &[Series]) -> Option<String> {
    let lines: Vec<Vec<Told>> = series.iter().map(|series| told(headline, key, series)).collect();
    let points = || lines.iter().flatten();
    let least = points().min_by(|a, b| a.value.total_cmp(&b.value))?;
    let most = points().max_by(|a, b| a.value.total_cmp(&b.value))?;
    let (name, path, unit) = (capital(headline.name), &key.path, headline.unit);
    let error = match points().any(|point| point.error.is_some()) {
        true => format!(" (±: {})", headline.error),
        false => String::new(),
    };
    if most.value - least.value <= most.noise().max(least.noise()) {
        return Some(format!(
            "{name}: {} {unit}, the same at every {path}{error}.",
            most.number()
        ));
    }
    let goes = |sign: f64| {
        let mut steps = lines.iter().flat_map(|line| line.windows(2));
        steps.all(|pair| sign * (pair[1].value - pair[0].value) > pair[0].noise().max(pair[1].noise()))
    };
    let several = lines.iter().any(|line| line.len() > 1);
    let (from, to, way) = match (several && goes(-1.0), several && goes(1.0)) {
        (true, _) => (most, least, "falls with"),
        (_, true) => (least, most, "grows with"),
        _ => {
            return Some(format!(
                "{name} is from {} {unit} at {} to {} {unit} at {}{error}, and does not go one way with {path}.",
                least.number(),
                least.at,
                most.number(),
                most.at
            ));
        }
    };
    Some(format!(
        "{name} {way} {path}: from {} {unit} at {} to {} {unit} at {}{error}.",
        from.number(),
        from.at,
        to.number(),
        to.at
    ))
}

/// What is known of a quantity along a series.
fn told(headline: &Headline, key: &Swept, series: &Series) -> Vec<Told> {
    let told = |(_, case): &(f64, &Analysed)| {
        let (value, error) = (headline.of)(case)?;
        let own = case.result.swept.iter().find(|swept| swept.path == key.path)?;
        let at = match series.name.as_str() {
            "" => sweep::with_unit(own),
            name => format!("{}, {name}", sweep::with_unit(own)),
        };
        Some(Told { at, value, error })
    };
    series.cases.iter().filter_map(told).collect()
}

/// `1.42 ± 0.02`: the error with one digit, the value with as many decimals.
fn with_error(value: f64, error: Option<f64>) -> String {
    match error.filter(|error| error.is_finite() && *error > 0.0) {
        Some(error) => {
            let error = round_significant(error, 1);
            let decimals = (-error.log10().floor() as i32).clamp(0, 6) as usize;
            format!("{value:.decimals$} ± {error:.decimals$}")
        }
        None => significant(value, 3),
    }
}

/// What cases of different specimens come to; the finest case of each specimen that has several, and the others beside it.
fn case_by_case(cases: &[Analysed]) -> Vec<String> {
    let alone = cases.iter().filter(|case| case.reference.is_none());
    let alone: Vec<&Analysed> = alone.filter(|case| !case.result.series.probes.is_empty()).collect();
    let sentence = |(index, reference): (usize, &Analysed)| {
        // Each specimen has a case of its own that the others are measured against.
        let mut sentence = outcome(reference).filter(|_| reference.reference == Some(index))?;
        let others = cases
            .iter()
            .enumerate()
            .filter(|(other, case)| *other != index && case.reference == Some(index));
        let others: Vec<String> = others.filter_map(|(_, case)| against(case, reference)).collect();
        if others.len() <= MOST_NAMED {
            others.iter().for_each(|other| sentence.push_str(&format!("; {other}")));
        }
        Some(format!("{sentence}."))
    };
    let mut sentences = alone::sentences(&alone);
    let whole = alone.iter().filter(|case| !case.has_crack());
    let whole: Vec<String> = whole.filter_map(|case| Some(outcome(case)? + ".")).collect();
    sentences.extend(whole.into_iter().take(MOST_NAMED));
    sentences.extend(cases.iter().enumerate().filter_map(sentence));
    sentences
}

/// When the crack starts and at which K; without a crack how far the stress comes.
fn outcome(case: &Analysed) -> Option<String> {
    if case.findings.tips.is_empty() {
        let (stress, _) = (headline::STRESS.of)(case)?;
        let end = case.result.series.probes.last()?.strain * PERCENT;
        let [stress, end] = [stress, end].map(|value| significant(value, 3));
        return Some(format!(
            "In {} the mean stress reaches {stress} GPa up to {end} % strain",
            case.name()
        ));
    }
    let mut sentence = start(case)?;
    if let Some((_, Some(gap))) = (headline::START.of)(case) {
        sentence.push_str(&format!(" (± {} %, one probe)", significant(gap, 1)));
    }
    if let Some(j) = case.findings.from_j {
        sentence.push_str(&format!(
            " at a K of {} MPa √m by the J-integral (rings agree to {} %)",
            significant(j.value * MEGAPASCAL_ROOT_METRE, 3),
            significant(j.spread / j.value * PERCENT, 1)
        ));
    }
    Some(sentence)
}

/// `In atoms the crack starts at 1.79 % strain`, or that it does not.
fn start(case: &Analysed) -> Option<String> {
    let percent = |strain: f64| significant(strain * PERCENT, 3);
    Some(match case.findings.initiation {
        Some(start) => format!(
            "In {} the crack starts at {} % strain",
            case.name(),
            percent(start.strain)
        ),
        None => {
            let end = case.result.series.probes.last()?.strain;
            format!(
                "In {} the crack does not start up to {} % strain",
                case.name(),
                percent(end)
            )
        }
    })
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "case" } else { "cases" }
}

/// `in coarse 39.3 % later, with 18 times fewer nodes and 22 times faster`
fn against(case: &Analysed, reference: &Analysed) -> Option<String> {
    let name = case.name();
    if are_one_computation(case.result, reference.result) {
        return Some(format!("{name} is the same computation under another name"));
    }
    let mut text = match case.difference.initiation_strain {
        Some(share) if share.abs() <= ROUNDING * between_probes(case, reference)? => {
            format!("in {name} at the same strain, within a probe")
        }
        Some(share) if share < 0.0 => format!("in {name} {:.1} % earlier", -share * PERCENT),
        Some(share) => format!("in {name} {:.1} % later", share * PERCENT),
        None if case.findings.tips.is_empty() => outcome(case)?.replacen("In", "in", 1),
        None => start(case)?.replacen("In", "in", 1).replacen("the crack", "it", 1),
    };
    let nodes = |case: &Analysed| case.result.setting.as_ref().map(|setting| setting.nodes as f64);
    let times = |of: &dyn Fn(&Analysed) -> Option<f64>| Some(of(reference)? / of(case)?);
    if let Some((nodes, time)) = times(&nodes).zip(times(&|case| case.core_seconds_a_picosecond())) {
        let nodes = match nodes {
            ..ALIKE => "as many nodes".to_owned(),
            fewer => format!("{} times fewer nodes", significant(fewer, 2)),
        };
        let pace = match time {
            ALIKE.. => format!("{} times faster", significant(time, 2)),
            _ if time * ALIKE <= 1.0 => format!("{} times slower", significant(1.0 / time, 2)),
            _ => "as fast".to_owned(),
        };
        text.push_str(&format!(", with {nodes} and {pace}"));
    }
    Some(text)
}
