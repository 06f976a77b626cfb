//! What a run writes and reads again: checkpoints, time series, pictures for ParaView. The only user of HDF5.
//!
//! While a run goes on, its folder holds one checkpoint and many *pieces*: a series segment for every stretch
//! between two checkpoints, a frame for every snapshot. Each is written aside, made durable and renamed, so a
//! kill leaves whole files only. A resume cuts the pieces back to the checkpoint ([`cut_back`]); a finished
//! run publishes them as one [`SERIES_FILE`] and one [`FIELDS_FILE`] ([`publish_series`], [`publish_fields`]).
//!
//! The order that makes every kill repeatable: segments and frames first, then the checkpoint of the same
//! step; publish after the checkpoint of the last step.

mod arrays;
mod aside;
mod bonds;
pub mod checkpoint;
mod columns;
mod cut_back;
mod error;
mod field;
mod fields;
mod file;
pub mod frames;
mod mesh;
mod packed;
mod pieces;
mod provenance;
mod publish;
mod read_fields;
pub mod rows;
mod sealed;
mod segments;
mod series;
mod setting;
mod snapshots;
mod steps;

pub use arrays::Give;
pub use cut_back::cut_back;
pub use error::RecordError;
pub use publish::{publish_fields, publish_series};
pub use read_fields::{FrameReader, read_fields};
pub use segments::{read_segments, write_segment};
pub use series::read_series;
pub use snapshots::{Picture, give_frame, write_frame};

/// Names of the files in a run's folder.
pub const CHECKPOINT_FILE: &str = "checkpoint.h5";
pub const SERIES_FILE: &str = "series.h5";
pub const FIELDS_FILE: &str = "fields.vtkhdf";
