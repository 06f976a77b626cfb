//! Studies with a slip in them, two thousand of them: each is a plan that can be computed or a mistake with a place.

use std::panic::{AssertUnwindSafe, catch_unwind};

use cgaft::setup::{self, Estimator};
use cgaft::study;

use super::{check_text, right_studies};
use crate::suite::specimens::Noise;

const MUTATIONS: usize = 2000;

/// Larger specimens are not laid out for each mutation, nm².
const LARGEST: f64 = 1e4;

const EXTREMES: [&str; 14] = [
    "0",
    "-1",
    "1e-30",
    "1e30",
    "4000000000",
    "nan",
    "inf",
    "''",
    "~",
    "[1, 2]",
    "{a: 1}",
    "0x10",
    "1,5",
    "1e999",
];

const UNITS: [&str; 12] = ["nm", "ps", "fs", "GPa", "eV", "u", "kg", "/s", "%", "km", "Å", "K"];

struct Mutator(Noise);

impl Mutator {
    fn below(&mut self, end: usize) -> usize {
        ((0.5 * (self.0.next() + 1.0) * end as f64) as usize).min(end.saturating_sub(1))
    }

    fn one<'a>(&mut self, words: &[&'a str]) -> &'a str {
        words[self.below(words.len())]
    }

    /// The place of a letter.
    fn letter(&mut self, text: &str) -> usize {
        let places: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
        places[self.below(places.len())]
    }

    fn mutated(&mut self, text: &str) -> String {
        let at = self.letter(text);
        let (before, after) = text.split_at(at);
        let rest = &after[after.chars().next().map_or(0, char::len_utf8)..];
        match self.below(7) {
            0 => format!("{before}{rest}"),
            1 => format!(
                "{before}{}{rest}",
                self.one(&[
                    "{", "}", "[", "]", ":", "-", "#", "&a", "*a", "\t", "\n", "'", "\0", "é"
                ])
            ),
            2 => self.line(text, |line| format!("{line}\n{line}")),
            3 => self.line(text, |_| String::new()),
            4 => {
                let extreme = self.one(&EXTREMES);
                self.number(text, |_| extreme.to_owned())
            }
            5 => {
                let unit = self.one(&UNITS);
                self.number(text, |number| format!("{number} {unit}"))
            }
            _ => {
                let factor = self.one(&["0", "00000", "e9", "e-9", ".5", "-"]);
                self.number(text, |number| format!("{number}{factor}"))
            }
        }
    }

    fn line(&mut self, text: &str, change: impl Fn(&str) -> String) -> String {
        let lines: Vec<&str> = text.lines().collect();
        let chosen = self.below(lines.len());
        let changed = lines.iter().enumerate().map(|(number, line)| match number == chosen {
            true => change(line),
            false => (*line).to_owned(),
        });
        changed.collect::<Vec<_>>().join("\n")
    }

    /// Changes one of the numbers outside comments.
    fn number(&mut self, text: &str, change: impl Fn(&str) -> String) -> String {
        let is_part = |letter: char| letter.is_ascii_digit() || letter == '.';
        let mut numbers = Vec::new();
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let code = line.split('#').next().unwrap_or_default();
            let mut at = 0;
            while let Some(found) = code[at..].find(|letter: char| letter.is_ascii_digit()) {
                let begin = at + found;
                let end = code[begin..]
                    .find(|letter| !is_part(letter))
                    .map_or(code.len(), |end| begin + end);
                numbers.push((start + begin, start + end));
                at = end;
            }
            start += line.len();
        }
        let (begin, end) = numbers[self.below(numbers.len())];
        format!("{}{}{}", &text[..begin], change(&text[begin..end]), &text[end..])
    }
}

/// What is wrong with the answer to a study.
fn complaint(text: &str) -> Option<String> {
    let plan = match check_text(text) {
        Ok(plan) => plan,
        Err(error) => {
            let lines = text.lines().count() + 1;
            let mistakes = error.mistakes();
            let beyond = mistakes
                .iter()
                .find(|mistake| mistake.line.is_some_and(|line| line > lines));
            return match (mistakes.is_empty(), beyond) {
                (true, _) => Some("refused without a mistake".to_owned()),
                (_, Some(mistake)) => Some(format!("a mistake beyond the end: {mistake:?}")),
                _ => None,
            };
        }
    };
    let mut estimator = Estimator::default();
    plan.cases.iter().find_map(|planned| {
        let case = &planned.case;
        let slab = case.slab();
        let is_large = slab.is_some_and(|slab| slab.specimen.length * slab.specimen.width > LARGEST);
        let refused = |why: setup::SetupError| {
            let mistakes = plan.refuse([(planned.name.as_str(), why.refusal())]).mistakes();
            let is_placed = mistakes
                .iter()
                .all(|mistake| mistake.line.is_some() && mistake.help.is_some());
            (!is_placed).then(|| format!("refused without place or advice: {mistakes:?}"))
        };
        if is_large {
            let slab = slab.expect("only slabs are large");
            let laid = setup::slab::material(slab)
                .and_then(|material| setup::slab::mesh_plan(slab, &case.run.until, &material));
            return laid.err().and_then(refused);
        }
        let estimate = match estimator.estimate(case) {
            Ok(estimate) => estimate,
            Err(why) => return refused(why),
        };
        let numbers = [estimate.time_step, estimate.stability_limit, estimate.seconds];
        let is_sound =
            numbers.iter().all(|number| number.is_finite() && *number > 0.0) && estimate.disk_bytes < u64::MAX / 2;
        (!is_sound).then(|| format!("accepted with {estimate:?}"))
    })
}

#[test]
fn two_thousand_slips_are_plans_or_mistakes_with_a_place() {
    let shipped = study::SHIPPED.iter().map(|shipped| shipped.text.to_owned());
    let others = right_studies()
        .into_iter()
        .map(|path| std::fs::read_to_string(path).unwrap());
    let texts: Vec<String> = shipped.chain(others).collect();
    let mut mutator = Mutator(Noise(20));
    let mut complaints = Vec::new();
    for number in 0..MUTATIONS {
        let text = mutator.mutated(&texts[number % texts.len()]);
        let found =
            catch_unwind(AssertUnwindSafe(|| complaint(&text))).unwrap_or_else(|_| Some("it panicked".to_owned()));
        complaints.extend(found.map(|found| format!("mutation {number}: {found}\n{text}")));
    }
    assert!(
        complaints.is_empty(),
        "{} complaints; the first: {}",
        complaints.len(),
        complaints[0]
    );
}
