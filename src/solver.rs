//! The time loop.
pub mod checkpoint;
