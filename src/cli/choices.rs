//! The choices of a resolved case as a person reads them, one key a line.

use serde_json::Value;

/// Every leaf of a case: `crack.length` and `56 nm`.
pub fn of_case(case: &Value) -> Vec<(String, String)> {
    let mut pairs = Vec::new();
    flatten(case, "", &mut pairs);
    pairs
}

fn flatten(value: &Value, path: &str, pairs: &mut Vec<(String, String)>) {
    match value {
        Value::Object(map) => {
            for (key, inner) in map {
                let path = if path.is_empty() {
                    key.clone()
                } else {
                    format!("{path}.{key}")
                };
                flatten(inner, &path, pairs);
            }
        }
        leaf => pairs.push((path.to_owned(), spelled_leaf(leaf))),
    }
}

/// A value in words: "none", "band half-width 8.8 nm element 1".
fn spelled_leaf(value: &Value) -> String {
    match value {
        Value::Array(values) if values.is_empty() => "none".to_owned(),
        Value::Array(values) => values.iter().map(spelled_leaf).collect::<Vec<_>>().join("; "),
        Value::Object(map) => {
            let pairs = map.iter().map(|(key, inner)| format!("{key} {}", spelled_leaf(inner)));
            pairs.collect::<Vec<_>>().join(" ")
        }
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn choices_are_named_as_in_the_study_file() {
        let case = serde_json::json!({"crack": {"edge": "left", "length": "56 nm"}, "resolution": {"element": 10}});
        let pairs = of_case(&case);
        let pairs: Vec<_> = pairs
            .iter()
            .map(|(key, value)| (key.as_str(), value.as_str()))
            .collect();
        assert_eq!(
            pairs,
            [
                ("crack.edge", "left"),
                ("crack.length", "56 nm"),
                ("resolution.element", "10")
            ]
        );
    }
}
