//! Warnings of cases: what several have in common is told once.

use crate::executor::{launch, mpi};

/// More names than this are counted.
const MOST_NAMED: usize = 4;

/// `warning: A, B: …` of what is to be known of cases, by name.
pub fn once<'a>(found: impl IntoIterator<Item = (&'a str, String)>) -> Vec<String> {
    let mut told: Vec<(String, Vec<&str>)> = Vec::new();
    for (name, text) in found {
        match told.iter_mut().find(|(known, _)| *known == text) {
            Some((_, names)) => names.push(name),
            None => told.push((text, vec![name])),
        }
    }
    let sentence = |(text, names): &(String, Vec<&str>)| format!("warning: {}: {text}", listed(names));
    told.iter().map(sentence).collect()
}

/// Why so many ranks could not be started on this machine; nothing where the solver is not there yet.
pub fn of_ranks(ranks: u32) -> Option<String> {
    let solver = launch::find_solver().ok()?;
    mpi::check(&solver, ranks)
        .err()
        .map(|error| format!("warning: {error}"))
}

/// The same of ranks that start on another machine, with modules of its own.
pub fn of_ranks_elsewhere(ranks: u32) -> Option<String> {
    let solver = launch::find_solver().ok()?;
    mpi::check_elsewhere(&solver, ranks)
        .err()
        .map(|error| format!("warning: {error}"))
}

/// Cases by name, of many only the first.
pub fn listed(names: &[&str]) -> String {
    let (named, others) = names.split_at(names.len().min(MOST_NAMED));
    match others.len() {
        0 => named.join(", "),
        more => format!("{} and {} more", named.join(", "), more),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_cases_are_told_with_the_names_of_a_few() {
        assert_eq!(listed(&["a", "b"]), "a, b");
        assert_eq!(listed(&["a", "b", "c", "d", "e", "f"]), "a, b, c, d and 2 more");
    }
}
