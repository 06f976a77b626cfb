//! Coarse-grained atomistic dynamics of fracture: declarative studies from a YAML file to a report.

pub mod plan;
pub mod study;
