//! Coarse-grained atomistic dynamics of fracture: declarative studies from a YAML file to a report.

pub mod analysis;
pub mod cli;
pub mod executor;
pub mod plan;
pub mod record;
pub mod report;
pub mod solver;
pub mod store;
pub mod study;
pub mod units;
