//! Identity of a case: the hash of the resolved case, never of the text.

use crate::study::case::Case;
use serde_json::Value;
use std::fmt;

/// Hash of all that the result of a case depends on, shown as 16 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CaseId(pub u64);

/// Names a run: the case, and what computes it where cases of a study are compared by that.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RunId {
    pub case: CaseId,
    /// `None` where any number will do: results do not depend on it.
    pub ranks: Option<u32>,
    /// Of each rank.
    pub threads: Option<u32>,
}

/// Raised when the same description comes to mean something else; every case then runs again.
const CASE_FORMAT: u32 = 2;

impl CaseId {
    /// How a case is carried out (ranks, threads) is no part of it: results do not depend on it.
    pub fn of(case: &Case) -> Self {
        // A case is plain data with string keys and finite numbers, which JSON always takes.
        let case = serde_json::to_value(case).unwrap_or_default();
        let whole = serde_json::json!({ "case-format": CASE_FORMAT, "case": case });
        let hash = blake3::hash(canonical(&whole).as_bytes());
        let [a, b, c, d, e, f, g, h, ..] = *hash.as_bytes();
        Self(u64::from_be_bytes([a, b, c, d, e, f, g, h]))
    }
}

impl RunId {
    /// The run of a case, whatever computes it.
    pub fn of(case: &Case) -> Self {
        Self {
            case: CaseId::of(case),
            ranks: None,
            threads: None,
        }
    }
}

/// `9b1f00c2a4d75e38`; `9b1f00c2a4d75e38-r2-t1` with ranks and threads.
impl fmt::Display for RunId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.case)?;
        let crew = [("r", self.ranks), ("t", self.threads)];
        let known = crew.into_iter().filter_map(|(sign, number)| Some((sign, number?)));
        known
            .into_iter()
            .try_for_each(|(sign, number)| write!(f, "-{sign}{number}"))
    }
}

impl fmt::Display for CaseId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

/// JSON with sorted keys and shortest decimals, so that equal values give equal text.
fn canonical(value: &Value) -> String {
    match value {
        Value::Object(map) => {
            let mut entries: Vec<_> = map.iter().collect();
            entries.sort_by_key(|(key, _)| key.as_str());
            let entries: Vec<String> = entries
                .iter()
                .map(|(key, value)| format!("{}:{}", Value::from(key.as_str()), canonical(value)))
                .collect();
            format!("{{{}}}", entries.join(","))
        }
        Value::Array(items) => format!("[{}]", items.iter().map(canonical).collect::<Vec<_>>().join(",")),
        // -0 and 0 are the same coordinate.
        Value::Number(number) if number.as_f64() == Some(0.0) && number.is_f64() => "0.0".into(),
        other => other.to_string(),
    }
}
