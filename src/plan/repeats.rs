//! `repeats`: every case several times over, each with noise of its own.

use super::draft::Draft;
use crate::study::{self, CaseFile, Finding, Findings, Given, Noise, Overlay, Place, Repeats, Run};

/// More repeats of one case than this are a slip.
const MOST_REPEATS: u32 = 1000;

/// Each case as often as it is to be repeated; the drafts themselves where nothing is.
pub fn repeated(drafts: Vec<Draft>, given: &Given<Repeats>, findings: &Findings) -> Vec<Draft> {
    let Given::Right(repeats, place) = given else {
        return drafts;
    };
    let count = match repeats.count {
        Given::Right(count, _) if (2..=MOST_REPEATS).contains(&count) => count,
        Given::Right(count, at) => {
            let message = format!("a case is repeated from 2 to {MOST_REPEATS} times, and {count} is not among these");
            findings.add(Finding::at(at, message).help("write `count: 20`, or leave `repeats` out"));
            return drafts;
        }
        Given::Absent => {
            findings.add(Finding::at(*place, "`repeats.count` is missing").help("write `count: 20`"));
            return drafts;
        }
        Given::Wrong(_) => return drafts,
    };
    let first = repeats.seed.right().copied().unwrap_or(study::SEED);
    let seeds = move || (0..count).map(move |number| (number + 1, first.wrapping_add(number)));
    let repeat = |draft: &Draft, (number, seed): (u32, u32)| {
        let mut values = draft.values.clone();
        values.overlay(&noise(repeats, seed, *place));
        Draft {
            name: format!("{}-repeat-{number}", draft.name),
            values,
            repeat_of: Some(draft.name.clone()),
            ..draft.clone()
        }
    };
    drafts
        .iter()
        .flat_map(|draft| seeds().map(move |seed| repeat(draft, seed)))
        .collect()
}

/// What a repeat changes in its case. Where nobody gives an amplitude, that is told with the case.
fn noise(repeats: &Repeats, seed: u32, place: Place) -> Given<CaseFile> {
    let noise = Noise {
        amplitude: repeats.amplitude,
        seed: Given::Right(seed, place),
    };
    let run = Run {
        noise: Given::Right(noise, place),
        ..Run::default()
    };
    let case = CaseFile {
        run: Given::Right(run, place),
        ..CaseFile::default()
    };
    Given::Right(case, place)
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use crate::plan::{Plan, plan};
    use crate::study::{StudyError, read_text};

    const BASE: &str = "study: test\nbase:\n  \
        material: {potential: {lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm}}, mass: 802 u, \
        thickness: 0.2087 nm}\n  specimen: {length: 1127 nm, width: 354 nm}\n  crack: {length: 56 nm}\n  \
        loading: {strain-rate: {rate: 4.6e6 /s}}\n  run: {until: {strain: 1.2 %}}\n\
        cases: {A: {resolution: {element: 10}}, B: {resolution: {element: 20}}}\n";

    fn planned(rest: &str) -> Result<Plan, StudyError> {
        plan(&read_text("test.yaml", &(BASE.to_owned() + rest))?)
    }

    #[test]
    fn every_case_is_repeated_with_seeds_that_count_on_and_ids_of_their_own() {
        let cases = planned("repeats: {count: 3, amplitude: 1e-3, seed: 7}\n")
            .unwrap()
            .cases;
        let seeds = |case: &crate::plan::PlannedCase| case.case.run.noise.unwrap().seed;
        assert_eq!(cases.iter().map(seeds).collect::<Vec<_>>(), [7, 8, 9, 7, 8, 9]);
        assert_eq!([&cases[2].name, &cases[3].name], ["A-repeat-3", "B-repeat-1"]);
        assert_eq!(cases[4].repeat_of.as_deref(), Some("B"));
        let ids: HashSet<String> = cases.iter().map(|case| case.id.to_string()).collect();
        assert_eq!(ids.len(), 6);
        let other = planned("repeats: {count: 3, amplitude: 1e-4, seed: 7}\n")
            .unwrap()
            .cases;
        assert!(other.iter().all(|case| !ids.contains(&case.id.to_string())));
    }

    #[test]
    fn the_amplitude_may_be_swept_and_must_come_from_somewhere() {
        let swept = planned("repeats: {count: 2}\nsweep: {run.noise.amplitude: [1e-10, 1e-3]}\n")
            .unwrap()
            .cases;
        assert_eq!(swept.len(), 8);
        let none = planned("repeats: {count: 2}\n").unwrap_err().render(false);
        assert!(none.contains("`noise.amplitude` is missing"), "{none}");
        let once = planned("repeats: {count: 1, amplitude: 1e-3}\n")
            .unwrap_err()
            .render(false);
        assert!(once.contains("from 2 to 1000 times"), "{once}");
    }
}
