//! A planned case as a study file of its own, which `cgaft-solve` and anyone who wants to repeat it can read.

use super::{
    PlannedCase,
    spelling::{spelled, spelled_execution},
};
use serde_json::{Value, json};
use std::fmt::Write;

/// Widest line into which a map or list is gathered.
const WIDTH: usize = 110;

/// The case as YAML a person can read, every default explicit; `read_case` reads it back to the bit.
pub fn write_case(planned: &PlannedCase) -> String {
    let mut base = spelled(&planned.case);
    if let Value::Object(run) = &mut base["run"] {
        run.extend(spelled_execution(&planned.case.execution));
    }
    let mut observe: Vec<Value> = planned.tables.iter().map(|table| json!(table)).collect();
    for key in ["gauges", "snapshots"] {
        if let Some(values) = base.as_object_mut().and_then(|base| base.shift_remove(key)) {
            observe.push(json!({ key: values }));
        }
    }
    base["observe"] = observe.into();
    let whole = json!({ "cgaft": 1, "study": planned.name, "base": base, "cases": { &planned.name: {} } });
    let mut text = format!(
        "# Case {} ({}), every choice made: a study of its own.\n",
        planned.name, planned.id
    );
    block(&whole, 0, &mut text);
    text
}

/// A map over several lines; what is short enough stands on one.
fn block(value: &Value, indent: usize, text: &mut String) {
    let Value::Object(map) = value else { return };
    for (key, value) in map {
        let line = flow(value);
        let short = indent + key.len() + 2 + line.len() <= WIDTH;
        // Writing into a String does not fail.
        let _ = match value {
            Value::Object(inner) if indent == 0 && !inner.is_empty() || !short => {
                let _ = writeln!(text, "{:indent$}{}:", "", word(key));
                block(value, indent + 2, text);
                continue;
            }
            _ => writeln!(text, "{:indent$}{}: {line}", "", word(key)),
        };
    }
}

fn flow(value: &Value) -> String {
    match value {
        Value::Object(map) => {
            let entries: Vec<String> = map
                .iter()
                .map(|(key, value)| format!("{}: {}", word(key), flow(value)))
                .collect();
            format!("{{{}}}", entries.join(", "))
        }
        Value::Array(items) => format!("[{}]", items.iter().map(flow).collect::<Vec<_>>().join(", ")),
        Value::String(text) => word(text),
        other => other.to_string(),
    }
}

/// A word as it stands where that is safe in YAML, else in quotes.
fn word(text: &str) -> String {
    let safe = |c: char| c.is_ascii_alphanumeric() || matches!(c, ' ' | '.' | '-' | '+' | '_' | '/' | '%' | '^');
    let begins = text.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '-' && text.len() > 1);
    if begins
        && text.chars().all(safe)
        && !matches!(
            text.to_lowercase().as_str(),
            "null" | "true" | "false" | "yes" | "no" | "on" | "off"
        )
    {
        text.into()
    } else {
        Value::from(text).to_string()
    }
}
