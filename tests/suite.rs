//! One test binary: a module a part, so that the heavy crates are linked once.

#[path = "suite/analysis.rs"]
mod analysis;
#[path = "suite/report.rs"]
mod report;
#[path = "suite/synthetic.rs"]
mod synthetic;
