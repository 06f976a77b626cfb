//! Values of a sweep in the names of its cases.

use super::name;
use crate::study::{Node, Value};

/// Longer ones are told by their number.
const LONGEST: usize = 30;

/// A word for each value: itself, a choice with its value such as `blend-0.5`, the kind of a choice that has several values
/// such as `morse`, or else its number from 1. Kinds that several values share are told with what they hold.
pub fn all(values: &[Node]) -> Vec<String> {
    let kinds: Vec<Option<String>> = values.iter().map(|value| fitting(kind(value))).collect();
    let is_shared = |index: usize| kinds.iter().filter(|other| **other == kinds[index]).count() > 1;
    let label = |(index, value): (usize, &Node)| {
        let own = match value.value {
            Value::Map(_) if is_shared(index) => fitting(whole(value)),
            _ => kinds[index].clone(),
        };
        own.unwrap_or_else(|| (index + 1).to_string())
    };
    values.iter().enumerate().map(label).collect()
}

fn fitting(label: Option<String>) -> Option<String> {
    label.filter(|label| !label.is_empty() && label.len() <= LONGEST)
}

fn kind(value: &Node) -> Option<String> {
    match &value.value {
        Value::Word(text) => Some(name::part(text)),
        Value::Map(entries) => match entries.as_slice() {
            [(key, inner)] => Some(match &inner.value {
                Value::Word(text) => format!("{}-{}", name::part(key.text()), name::part(text)),
                _ => name::part(key.text()),
            }),
            _ => None,
        },
        _ => None,
    }
}

/// All that a value holds.
fn whole(value: &Node) -> Option<String> {
    let joined = |parts: Option<Vec<String>>| parts.map(|parts| parts.join("-"));
    match &value.value {
        Value::Word(text) => Some(name::part(text)),
        Value::Map(entries) => {
            let entry = |(key, inner): &(Node, Node)| Some(format!("{}-{}", name::part(key.text()), whole(inner)?));
            joined(entries.iter().map(entry).collect())
        }
        Value::List(items) => joined(items.iter().map(whole).collect()),
        Value::Null => None,
    }
}
