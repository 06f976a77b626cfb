//! Pure functions of snapshots and series.
pub mod series;
