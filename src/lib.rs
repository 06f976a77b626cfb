//! Coarse-grained atomistic dynamics of fracture: declarative studies from a YAML file to a report.

pub mod analysis;
pub mod report;
pub mod record {
    pub mod frames;
}
