//! What comes out of cases that stand alone, each a specimen of its own: ranges over them, and what is back at the tips.

use crate::analysis::waves::{Arrival, Wave};
use crate::report::Analysed;
use crate::report::headline::{self, Headline};
use crate::report::numbers::significant;
use crate::report::tables::first_branch::{self, at_running_tip};
use crate::report::tables::wave_arrival::path_name;

/// More values than this are told by their ends.
const MOST_LISTED: usize = 3;

/// When the cracks turn aside and branch and which waves are back by then, where waves are watched; when they start, and
/// at which K.
pub fn sentences(cases: &[&Analysed]) -> Vec<String> {
    let cracked = cases.iter().copied().filter(|case| case.has_crack());
    let (cases, still): (Vec<&Analysed>, Vec<&Analysed>) = cracked.partition(|case| case.findings.initiation.is_some());
    let watched = !cases.is_empty() && cases.iter().all(|case| !case.findings.arrivals.is_empty());
    let events = [
        (
            "leaves its plane",
            "stays in it",
            first_branch::leaves_after_start as When,
        ),
        ("branches first", "does not branch", first_branch::after_start as When),
    ];
    let mut sentences: Vec<String> = events
        .iter()
        .filter(|_| watched)
        .filter_map(|event| happens(&cases, *event))
        .collect();
    sentences.extend(start(&cases));
    sentences.extend((!still.is_empty()).then(|| {
        let names = listed(still.iter().map(|case| case.name().to_owned()));
        format!("In {names} the crack does not start.")
    }));
    sentences
}

/// Time after the start of a crack, ps.
type When = fn(&Analysed) -> Option<f64>;

/// `The crack leaves its plane 9.0 (B) to 11 ps (A) after its start (± 1.0 ps, one probe), before any wave is back at its
/// tip.`
fn happens(cases: &[&Analysed], (verb, never, when): (&str, &str, When)) -> Option<String> {
    let (happened, still): (Vec<&Analysed>, Vec<&Analysed>) = cases.iter().partition(|case| when(case).is_some());
    let times: Vec<(f64, &str)> = happened
        .iter()
        .filter_map(|case| Some((when(case)?, case.name())))
        .collect();
    let probe = happened.iter().filter_map(|case| probe(case)).reduce(f64::max);
    let probe = probe.map_or(String::new(), |probe| {
        format!(" (± {} ps, one probe)", significant(probe, 2))
    });
    let told = spread(&times, "ps", cases.len() > 1)?;
    let waves = waves_back(&happened, when);
    let still = match still.as_slice() {
        [] => String::new(),
        still => format!(
            "; in {} it {never}",
            listed(still.iter().map(|case| case.name().to_owned()))
        ),
    };
    Some(format!(
        "The crack {verb} {told} after its start{probe}, {waves}{still}."
    ))
}

/// Between the start and the look before it, ps.
fn probe(case: &Analysed) -> Option<f64> {
    let start = case.findings.initiation?;
    let before = case.result.series.probes.get(start.probe.checked_sub(1)?)?;
    Some(start.time - before.time)
}

/// Which waves from the faces are back at the tips when something happens to the cracks.
fn waves_back(cases: &[&Analysed], when: When) -> String {
    let back = |case: &&Analysed| {
        let by = when(case).unwrap_or(f64::NEG_INFINITY);
        let mut arrivals: Vec<_> = at_running_tip(case).filter(|(_, time)| *time <= by).collect();
        arrivals.sort_by(|a, b| a.1.total_cmp(&b.1));
        arrivals
            .iter()
            .map(|(arrival, _)| name(arrival))
            .collect::<Vec<String>>()
    };
    let each: Vec<Vec<String>> = cases.iter().map(back).collect();
    let in_all: Vec<String> = each.first().into_iter().flatten().cloned().collect();
    let in_all: Vec<String> = in_all
        .into_iter()
        .filter(|wave| each.iter().all(|waves| waves.contains(wave)))
        .collect();
    let others = each.iter().any(|waves| waves.len() > in_all.len());
    match (in_all.len(), others) {
        (0, false) => "before any wave is back at its tip".to_owned(),
        (0, true) => "when no wave is back at its tip in every case".to_owned(),
        (1, false) => format!("when {} alone is back at its tip", in_all[0]),
        (_, false) => format!(
            "when several waves are back at its tip, of which these runs single out none: {}",
            listed(in_all.into_iter())
        ),
        (_, true) => format!(
            "when {} {} back at its tip in every case and others in some, of which these runs single out none",
            listed(in_all.iter().cloned()),
            if in_all.len() == 1 { "is" } else { "are" }
        ),
    }
}

/// `The crack starts at 0.481 (E) to 0.828 % strain (A) (± 0.0005 % at most, one probe), at a K of …`
fn start(cases: &[&Analysed]) -> Option<String> {
    let of = |headline: &Headline| {
        let value = |case: &&Analysed| Some(((headline.of)(case)?, case.name().to_owned()));
        cases.iter().filter_map(value).collect::<Vec<_>>()
    };
    let told = |values: &[((f64, Option<f64>), String)], unit: &str| {
        let values: Vec<(f64, &str)> = values
            .iter()
            .map(|((value, _), name)| (*value, name.as_str()))
            .collect();
        spread(&values, unit, cases.len() > 1)
    };
    let starts = of(&headline::START);
    let gap = starts.iter().filter_map(|((_, gap), _)| *gap).reduce(f64::max);
    let gap = gap.map_or(String::new(), |gap| {
        let at_most = if starts.len() > 1 { " at most" } else { "" };
        format!(" (± {} %{at_most}, one probe)", significant(gap, 1))
    });
    let k = told(&of(&headline::K), headline::K.unit);
    let k = k.map_or(String::new(), |k| format!(", at a K of {k} by the J-integral"));
    Some(format!("The crack starts at {}{gap}{k}.", told(&starts, "% strain")?))
}

/// `374 (B), 393 (D) and 841 ps (E)`; of many the least and the largest.
fn spread(values: &[(f64, &str)], unit: &str, with_names: bool) -> Option<String> {
    let mut values = values.to_vec();
    let number = |value: f64| significant(value, 3);
    if values.len() > MOST_LISTED {
        values.sort_by(|a, b| a.0.total_cmp(&b.0));
    }
    let (first, last) = (values.first()?, values.last()?);
    let are_alike = values.len() > 1 && values.iter().all(|value| number(value.0) == number(first.0));
    if !with_names || are_alike {
        return Some(format!("{} {unit}", number(first.0)));
    }
    let named = |(value, name): &(f64, &str)| format!("{} ({name})", number(*value));
    let end = format!("{} {unit} ({})", number(last.0), last.1);
    Some(match values.len() {
        1 => end,
        2..=MOST_LISTED => {
            let before = values[..values.len() - 1].iter().map(named);
            format!("{} and {end}", before.collect::<Vec<_>>().join(", "))
        }
        _ => format!("{} to {end}", named(first)),
    })
}

/// `the longitudinal wave from the left face`
fn name(arrival: &Arrival) -> String {
    let wave = match arrival.wave {
        Wave::Longitudinal => "longitudinal",
        Wave::Transverse => "transverse",
        Wave::Rayleigh => "Rayleigh",
    };
    format!("the {wave} wave from the {}", path_name(arrival))
}

/// `A, B and C`
fn listed(names: impl Iterator<Item = String>) -> String {
    let names: Vec<String> = names.collect();
    match names.split_last() {
        Some((last, before)) if !before.is_empty() => format!("{} and {last}", before.join(", ")),
        _ => names.join(""),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_values_are_listed_and_many_told_by_their_ends() {
        let values = [(374.0, "B"), (841.0, "E"), (393.0, "D"), (120.0, "A")];
        let told = |count: usize, with_names| spread(&values[..count], "ps", with_names).unwrap();
        assert_eq!(told(1, false), "374 ps");
        assert_eq!(told(1, true), "374 ps (B)");
        assert_eq!(told(2, true), "374 (B) and 841 ps (E)");
        assert_eq!(told(4, true), "120 (A) to 841 ps (E)");
        assert_eq!(spread(&[(9.03, "B"), (9.031, "D")], "ps", true).unwrap(), "9.03 ps");
        assert_eq!(spread(&[], "ps", true), None);
    }
}
