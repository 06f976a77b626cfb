//! What a sweep has set in a case: a number with its unit where it is one, so that tables and figures can use it.

use super::label;
use crate::study::{Node, Value};
use crate::units;

/// Numbers that differ by less than this share are one.
const SAME: f64 = 1e-9;

/// A swept key and its value in one case.
#[derive(Clone, Debug, PartialEq)]
pub struct Swept {
    /// `crack.length`
    pub path: String,
    /// Position of its line in the sweep; the paths of a zip group go in step and share it.
    pub axis: usize,
    pub value: SweptValue,
}

#[derive(Clone, Debug, PartialEq)]
pub enum SweptValue {
    /// In the unit in which quantities of its dimension are written out; empty for a plain number.
    Number {
        value: f64,
        unit: &'static str,
    },
    Word(String),
}

impl Swept {
    /// A key and its value as typed.
    pub fn read(path: &str, text: &str) -> Swept {
        Swept {
            path: path.to_owned(),
            axis: 0,
            value: match units::measured(text) {
                Some((value, unit)) => SweptValue::Number { value, unit },
                None => SweptValue::Word(text.to_owned()),
            },
        }
    }

    /// `crack_length_nm`: the name of its column in every table.
    pub fn column(&self) -> String {
        let name = self.path.replace(['.', '-'], "_");
        match self.unit() {
            "" => name,
            unit => format!("{name}_{}", in_a_name(unit)),
        }
    }

    /// `crack.length (nm)`: what stands at an axis or over a column of the page.
    pub fn heading(&self) -> String {
        match self.unit() {
            "" => self.path.clone(),
            unit => format!("{} ({unit})", self.path),
        }
    }

    pub fn number(&self) -> Option<f64> {
        match self.value {
            SweptValue::Number { value, .. } => Some(value),
            SweptValue::Word(_) => None,
        }
    }

    /// Empty where there is none.
    pub fn unit(&self) -> &'static str {
        match self.value {
            SweptValue::Number { unit, .. } => unit,
            SweptValue::Word(_) => "",
        }
    }

    /// Whether a text says this value, a number to nine digits.
    pub fn is(&self, text: &str) -> bool {
        match &self.value {
            SweptValue::Number { value, .. } => text
                .parse::<f64>()
                .is_ok_and(|other| (other - value).abs() <= SAME * value.abs()),
            SweptValue::Word(word) => word == text,
        }
    }

    /// The value as JSON.
    pub fn json(&self) -> serde_json::Value {
        match &self.value {
            SweptValue::Number { value, .. } => (*value).into(),
            SweptValue::Word(word) => word.as_str().into(),
        }
    }
}

/// `/s` is `per_s`, `eV/nm^2` is `ev_per_nm2`, `%` is `percent`.
fn in_a_name(unit: &str) -> String {
    let words = unit.replace('%', "percent").replace('^', "").replace('/', "_per_");
    words.trim_matches('_').to_lowercase()
}

/// The values of one swept key: numbers if all of them are numbers of one unit, else words.
pub fn values(nodes: &[Node]) -> Vec<SweptValue> {
    let measured = |node: &Node| match &node.value {
        Value::Word(text) => units::measured(text),
        _ => None,
    };
    let numbers: Option<Vec<(f64, &'static str)>> = nodes.iter().map(measured).collect();
    match numbers {
        Some(numbers) if numbers.iter().all(|number| number.1 == numbers[0].1) => numbers
            .into_iter()
            .map(|(value, unit)| SweptValue::Number { value, unit })
            .collect(),
        _ => label::all(nodes).into_iter().map(SweptValue::Word).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::Place;

    fn swept(path: &str, texts: &[&str]) -> Vec<Swept> {
        let word = |text: &&str| Node::word(*text, Place::default());
        let nodes: Vec<Node> = texts.iter().map(word).collect();
        let swept = |value| Swept {
            path: path.to_owned(),
            axis: 0,
            value,
        };
        values(&nodes).into_iter().map(swept).collect()
    }

    #[test]
    fn columns_tell_the_unit_and_numbers_do_not_depend_on_how_they_were_typed() {
        for (path, texts, column, numbers) in [
            ("crack.length", ["10 nm", "0.02 um"], "crack_length_nm", [10.0, 20.0]),
            (
                "loading.strain-rate.rate",
                ["4.6e7 /s", "9.2e7 /s"],
                "loading_strain_rate_rate_per_s",
                [4.6e7, 9.2e7],
            ),
            (
                "run.relax.strain",
                ["0.1 %", "0.4 %"],
                "run_relax_strain_percent",
                [0.1, 0.4],
            ),
            ("resolution.element", ["5", "10"], "resolution_element", [5.0, 10.0]),
            ("run.time-step", ["2 fs", "3 ps"], "run_time_step_ps", [0.002, 3.0]),
        ] {
            let swept = swept(path, &texts);
            assert_eq!(swept[0].column(), column);
            assert_eq!([0, 1].map(|index| swept[index].number()), numbers.map(Some), "{path}");
        }
    }

    #[test]
    fn values_that_are_no_numbers_of_one_unit_are_words() {
        let swept = swept("run.summation", &["exact", "nodal"]);
        assert_eq!(swept[1].value, SweptValue::Word("nodal".to_owned()));
        assert_eq!(swept[1].column(), "run_summation");
        assert_eq!(
            super::tests::swept("run.time-step", &["auto", "2 fs"])[1].number(),
            None
        );
    }
}
