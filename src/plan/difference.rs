//! Why a case runs again: what changed in it.

use serde_json::Value;

/// What changed between two spelled cases, a line each: `loading.strain-rate.rate: 4.6e6 /s -> 9.2e6 /s`.
pub fn explain_difference(old: &Value, new: &Value) -> Vec<String> {
    let mut lines = Vec::new();
    compare("", Some(old), Some(new), &mut lines);
    lines
}

fn compare(path: &str, old: Option<&Value>, new: Option<&Value>, lines: &mut Vec<String>) {
    match (old, new) {
        (Some(Value::Object(before)), Some(Value::Object(after))) => {
            let added = after.keys().filter(|key| !before.contains_key(*key));
            for key in before.keys().chain(added) {
                let inner = if path.is_empty() {
                    key.clone()
                } else {
                    format!("{path}.{key}")
                };
                compare(&inner, before.get(key), after.get(key), lines);
            }
        }
        _ if old == new => (),
        _ => lines.push(format!("{path}: {} -> {}", shown(old), shown(new))),
    }
}

fn shown(value: Option<&Value>) -> String {
    match value {
        None => "(not given)".into(),
        Some(Value::String(text)) => text.clone(),
        Some(other) => other.to_string().replace('"', "").replace(':', ": ").replace(',', ", "),
    }
}
