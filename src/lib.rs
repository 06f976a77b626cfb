//! Coarse-grained atomistic dynamics of fracture: declarative studies from a YAML file to a report.

pub mod analysis;
pub mod cli;
pub mod domain;
pub mod durable;
pub mod executor;
pub mod export;
pub mod forces;
pub mod integrator;
pub mod lanes;
pub mod lattice;
pub mod loading;
pub mod material;
pub mod mesh;
pub mod plan;
pub mod potential;
pub mod record;
pub mod relaxation;
pub mod report;
pub mod setup;
pub mod solver;
pub mod state;
pub mod store;
pub mod study;
pub mod units;
