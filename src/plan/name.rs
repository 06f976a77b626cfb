//! Names of studies and cases, which become names of folders.

use crate::study::{Finding, Findings, Place};
use crate::units;

/// A case from a long sweep may be longer than what is typed; file systems end at 255 bytes.
const LONGEST_TYPED: usize = 60;

/// Refuse a name that would not be a good folder.
pub fn check(name: &str, place: Place, what: &str, findings: &Findings) {
    let good = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
    if name.starts_with(|c: char| c.is_ascii_alphanumeric()) && name.chars().all(good) && name.len() <= LONGEST_TYPED {
        return;
    }
    let message = format!(
        "`{}` cannot be the name of a {what}: it becomes the name of a folder",
        shortened(name)
    );
    let replaced: String = name
        .chars()
        .map(|c| if good(c) { c } else { '-' })
        .take(LONGEST_TYPED)
        .collect();
    let better = replaced.trim_matches(['-', '.', '_']);
    let example = if better.is_empty() { "A" } else { better };
    findings
        .add(Finding::at(place, message).help(format!("use letters, digits, `-`, `_` and `.`, such as `{example}`")));
}

fn shortened(name: &str) -> String {
    if name.chars().count() <= 40 {
        name.into()
    } else {
        name.chars().take(37).chain("...".chars()).collect()
    }
}

/// A value as part of a name, however it is spelled: `4.6e6 /s` is `4.6e6-per-s`, `0.5 %` is `0.5percent`, `354 nm` and
/// `3540 Å` are `354nm`.
pub fn part(value: &str) -> String {
    let value = units::canonical(value).unwrap_or_else(|| value.to_owned());
    let mut name = String::new();
    for c in value.chars() {
        match c {
            c if c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_') => name.push(c),
            ' ' | '+' => (),
            '%' => name += "percent",
            '/' => name += "-per-",
            'Å' | '\u{212b}' => name.push('A'),
            'µ' | 'μ' => name.push('u'),
            _ => name.push('-'),
        }
    }
    name.trim_matches(['-', '.', '_']).into()
}
