//! Coarse-grained atomistic dynamics of fracture: declarative studies from a YAML file to a report.

pub mod cli;
pub mod executor;
pub mod plan;
pub mod store;
pub mod study;
pub mod units;
