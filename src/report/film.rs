//! The pictures that a run took.

use std::fmt;
use std::sync::Arc;

use crate::record::frames::{FieldMesh, Frame, Vector};
use crate::record::{FrameReader, RecordError};

/// A mesh and frames on it in order of time, of which a large run's are read one by one.
#[derive(Clone)]
pub struct Film<V: Vector = [f64; 2]> {
    /// The cells of the run. Frames may have their own: see [`Self::cells`].
    pub mesh: FieldMesh<V>,
    frames: Frames<V>,
}

#[derive(Clone)]
enum Frames<V: Vector> {
    Held(Vec<Frame<V>>),
    Stored(Arc<FrameReader<V>>),
}

impl<V: Vector> Film<V> {
    pub fn held(mesh: FieldMesh<V>, frames: Vec<Frame<V>>) -> Self {
        let frames = Frames::Held(frames);
        Self { mesh, frames }
    }

    pub fn stored(mesh: FieldMesh<V>, reader: FrameReader<V>) -> Self {
        let frames = Frames::Stored(Arc::new(reader));
        Self { mesh, frames }
    }

    /// Time (ps) and nominal strain of every frame.
    pub fn moments(&self) -> Vec<(f64, f64)> {
        match &self.frames {
            Frames::Held(frames) => frames.iter().map(|frame| (frame.time, frame.strain)).collect(),
            Frames::Stored(reader) => reader
                .times()
                .iter()
                .copied()
                .zip(reader.strains().iter().copied())
                .collect(),
        }
    }

    pub fn frame(&self, index: usize) -> Result<Frame<V>, RecordError> {
        match &self.frames {
            Frames::Held(frames) => Ok(frames[index].clone()),
            Frames::Stored(reader) => reader.frame(index),
        }
    }

    /// The cells of a frame: its own, or those of the run.
    pub fn cells<'a>(&'a self, frame: &'a Frame<V>) -> &'a FieldMesh<V> {
        frame.mesh.as_ref().unwrap_or(&self.mesh)
    }

    /// The frame in which something comes nearest to a value; `None` without frames.
    pub fn nearest(&self, value: f64, of: impl Fn((f64, f64)) -> f64) -> Option<usize> {
        let moments = self.moments();
        let off = |index: &usize| (of(moments[*index]) - value).abs();
        (0..moments.len()).min_by(|a, b| off(a).total_cmp(&off(b)))
    }
}

impl<V: Vector> fmt::Debug for Film<V> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Film of {} frames", self.moments().len())
    }
}
