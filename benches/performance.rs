//! What this program costs on this machine, beside what is asked of it: `make bench`.
//!
//! Every part leaves its numbers as `reports/performance/*.csv`; `docs/performance.md` shows those files. Names of parts
//! as arguments measure only these: `cargo bench --bench performance -- steps growth`.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a program for a terminal: the table on standard output, how far it is on standard error"
)]

mod performance {
    pub mod clock;
    pub mod commands;
    pub mod demand;
    pub mod growth;
    pub mod model_a;
    pub mod page;
    pub mod peer;
    pub mod ranks;
    pub mod roofline;
    pub mod share;
    pub mod solids;
    pub mod specimens;
    pub mod steps;
}

use performance::{clock, commands, demand, growth, model_a, page, peer, ranks, roofline, share, solids, steps};

/// A part, and how it is measured.
type Part = (&'static str, fn());

const PARTS: [Part; 11] = [
    ("steps", steps::measure),
    ("ranks", ranks::measure),
    ("peer", peer::measure),
    ("set-up", steps::measure_set_up),
    ("growth", growth::measure),
    ("commands", commands::measure),
    ("model-a", model_a::measure),
    ("memory", model_a::measure_memory_of_atoms),
    ("share", share::measure),
    ("solids", solids::measure),
    ("roofline", roofline::measure),
];

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let parts: Vec<&Part> = PARTS
        .iter()
        .filter(|(name, _)| wanted.is_empty() || wanted.iter().any(|word| word == name))
        .collect();
    assert!(
        !parts.is_empty(),
        "no such part; there are {:?}",
        PARTS.map(|part| part.0)
    );
    page::write_machine();
    for (name, measure) in parts {
        eprintln!("{name}: {:.1} programs want to run", clock::load());
        measure();
    }
    page::refresh();
    println!("{}", demand::table());
}
