//! Compressed datasets whose chunks are shuffled and deflated here, several side by side.
//!
//! What arises is what HDF5's own filters make and undo, so that any program reads it. HDF5 itself deflates one chunk after
//! the other, and several times slower.

use std::io::Write;

use bytemuck::NoUninit;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use hdf5::sync::sync;
use hdf5::types::VarLenUnicode;
use hdf5::{Dataset, Group, H5Type};
use hdf5_metno_sys::h5d::H5Dwrite_chunk;
use hdf5_metno_sys::h5p::H5P_DEFAULT;
use rayon::prelude::*;

/// Numbers in a chunk: 64 to 128 kB, so that a short file is one chunk and a chunk always fits the 1 MB cache that HDF5 keeps
/// a dataset.
const CHUNK_NUMBERS: usize = 16 * 1024;

/// Deflate level.
const LEVEL: u32 = 2;

/// What a dataset may be made of.
pub trait Number: H5Type + NoUninit + Default + Sync {}

impl<T: H5Type + NoUninit + Default + Sync> Number for T {}

/// A dataset that is filled from its first row to its last.
pub struct Packed<T> {
    dataset: Dataset,
    /// Lengths of a chunk along every axis.
    chunk: Vec<usize>,
    /// Chunks that are in the file.
    written: usize,
    /// What does not yet make a chunk.
    rest: Vec<T>,
}

impl<T: Number> Packed<T> {
    /// An empty dataset of this shape, without time stamps. HDF5 has no chunks of length 0: no entry of `shape` is 0.
    pub fn create(group: &Group, name: &str, unit: &str, shape: &[usize]) -> hdf5::Result<Self> {
        assert!(!shape.contains(&0), "`{name}` is empty");
        let chunk = chunk(shape);
        let builder = group.new_dataset::<T>().obj_track_times(false);
        let filters = builder.chunk(chunk.clone()).shuffle().deflate(LEVEL as u8);
        let dataset = filters.shape(shape).create(name)?;
        name_unit(&dataset, unit)?;
        Ok(Self {
            dataset,
            chunk,
            written: 0,
            rest: Vec::new(),
        })
    }

    /// Adds whole rows.
    pub fn append(&mut self, numbers: &[T]) -> hdf5::Result<()> {
        let size: usize = self.chunk.iter().product();
        let missing = (size - self.rest.len()) % size;
        let (first, others) = numbers.split_at(missing.min(numbers.len()));
        self.rest.extend_from_slice(first);
        if self.rest.len() == size {
            let full = std::mem::take(&mut self.rest);
            self.write(&[pack(&full)])?;
        }
        if self.rest.is_empty() {
            let chunks = others.chunks_exact(size);
            self.rest.extend_from_slice(chunks.remainder());
            let chunks: Vec<&[T]> = chunks.collect();
            self.write(&chunks.into_par_iter().map(pack).collect::<Vec<_>>())?;
        }
        Ok(())
    }

    /// Writes what is left. HDF5 must tell a full disk now, not when it is closed.
    pub fn finish(mut self) -> hdf5::Result<()> {
        if !self.rest.is_empty() {
            let mut last = std::mem::take(&mut self.rest);
            last.resize(self.chunk.iter().product(), T::default());
            self.write(&[pack(&last)])?;
        }
        self.dataset.flush()
    }

    fn write(&mut self, chunks: &[Vec<u8>]) -> hdf5::Result<()> {
        for bytes in chunks {
            let mut start = vec![0; self.chunk.len()];
            start[0] = (self.written * self.chunk[0]) as u64;
            write_chunk(&self.dataset, &start, bytes)?;
            self.written += 1;
        }
        Ok(())
    }
}

/// Says on the dataset itself what its numbers are counted in.
pub(super) fn name_unit(dataset: &Dataset, unit: &str) -> hdf5::Result<()> {
    let unit: VarLenUnicode = unit.parse().map_err(|_| "a unit contains a zero byte")?;
    dataset.new_attr::<VarLenUnicode>().create("units")?.write_scalar(&unit)
}

/// Puts a chunk as it is into the file; `start` is where its first number stands, on every axis.
#[allow(unsafe_code, reason = "the crate `hdf5` has no safe name for it")]
fn write_chunk(dataset: &Dataset, start: &[u64], bytes: &[u8]) -> hdf5::Result<()> {
    const ALL_FILTERS_APPLIED: u32 = 0;
    assert_eq!(start.len(), dataset.ndim());
    // SAFETY: the dataset is open as long as it is borrowed, `start` has an entry for each of its axes, HDF5 reads no more
    // bytes than it is told, and `sync` keeps other threads out of it.
    let status = sync(|| unsafe {
        let (dataset, bytes_there) = (dataset.id(), bytes.as_ptr().cast());
        H5Dwrite_chunk(
            dataset,
            H5P_DEFAULT,
            ALL_FILTERS_APPLIED,
            start.as_ptr(),
            bytes.len(),
            bytes_there,
        )
    });
    hdf5::h5check(status).map(drop)
}

/// What HDF5's filters `shuffle` and `deflate` make of a chunk: the first bytes of all numbers, their second bytes and so on,
/// as a stream of zlib.
fn pack<T: NoUninit>(numbers: &[T]) -> Vec<u8> {
    let bytes: &[u8] = bytemuck::cast_slice(numbers);
    let size = size_of::<T>();
    let mut shuffled = Vec::with_capacity(bytes.len());
    for place in 0..size {
        shuffled.extend(bytes.iter().skip(place).step_by(size));
    }
    let mut stream = ZlibEncoder::new(Vec::with_capacity(bytes.len()), Compression::new(LEVEL));
    let packed = stream.write_all(&shuffled).and_then(|()| stream.finish());
    packed.expect("nothing fails in memory")
}

/// Whole rows of about [`CHUNK_NUMBERS`] numbers together, no more than there are.
fn chunk(shape: &[usize]) -> Vec<usize> {
    let row: usize = shape[1..].iter().product();
    let mut chunk = shape.to_vec();
    chunk[0] = (CHUNK_NUMBERS / row).clamp(1, shape[0]);
    chunk
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::file;

    #[test]
    fn hdf5_reads_what_was_appended_in_any_pieces() {
        let dir = tempfile::tempdir().unwrap();
        let rows = 3 * CHUNK_NUMBERS + 7;
        let numbers: Vec<f32> = (0..3 * rows)
            .map(|k| (k as f32).sqrt() * if k % 3 == 2 { 0.0 } else { 1.0 })
            .collect();
        for (which, piece) in [1, 3 * CHUNK_NUMBERS / 3, 100_000, rows].into_iter().enumerate() {
            let path = dir.path().join(format!("{which}.h5"));
            let file = file::create(&path, 0).unwrap();
            let mut packed = Packed::create(&file, "numbers", "nm", &[rows, 3]).unwrap();
            let pieces = numbers.chunks(3 * piece.max(rows / 100));
            pieces.for_each(|piece| packed.append(piece).unwrap());
            packed.finish().unwrap();
            file::finish(file).unwrap();
            let file = hdf5::File::open(&path).unwrap();
            let dataset = file.dataset("numbers").unwrap();
            assert_eq!(dataset.read_raw::<f32>().unwrap(), numbers, "{piece}");
            assert!(dataset.storage_size() < (4 * numbers.len()) as u64, "it is compressed");
        }
    }

    #[test]
    fn numbers_of_every_size_come_back() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("sizes.h5");
        let file = file::create(&path, 0).unwrap();
        fn put<T: Number>(group: &Group, name: &str, numbers: &[T]) {
            let mut packed = Packed::create(group, name, "1", &[numbers.len()]).unwrap();
            packed.append(numbers).unwrap();
            packed.finish().unwrap();
        }
        let [bytes, longs, doubles] = [vec![1_u8, 2, 255], vec![3, 4], vec![5, 6, 7, 8]];
        let longs: Vec<i64> = longs.iter().map(|&long| i64::from(long) << 40).collect();
        let doubles: Vec<f64> = doubles.iter().map(|&double| f64::from(double).sqrt()).collect();
        put(&file, "bytes", &bytes);
        put(&file, "longs", &longs);
        put(&file, "doubles", &doubles);
        assert_eq!(file.dataset("bytes").unwrap().read_raw::<u8>().unwrap(), bytes);
        assert_eq!(file.dataset("longs").unwrap().read_raw::<i64>().unwrap(), longs);
        assert_eq!(file.dataset("doubles").unwrap().read_raw::<f64>().unwrap(), doubles);
    }
}
