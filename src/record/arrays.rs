//! Numbers with their unit as HDF5 datasets.

use hdf5::{Group, H5Type};
use ndarray::{ArrayView, IxDyn, s};

use super::packed::{Number, Packed, name_unit};

/// How the numbers lie in the file.
#[derive(Clone, Copy)]
pub(super) enum Packing {
    /// As they are: for files that live until the next checkpoint.
    Plain,
    /// Shuffled and deflated: for files that stay.
    Deflated,
}

/// A group without time stamps, so that equal content gives equal bytes.
pub(super) fn new_group(parent: &Group, name: &str) -> hdf5::Result<Group> {
    parent.create_group_builder().obj_track_times(false).create(name)
}

/// Writes an array; `shape` has the product `data.len()`.
pub(super) fn put<T: Number>(
    group: &Group,
    name: &str,
    unit: &str,
    shape: &[usize],
    data: &[T],
    packing: Packing,
) -> hdf5::Result<()> {
    assert_eq!(
        shape.iter().product::<usize>(),
        data.len(),
        "`{name}` has another shape"
    );
    // HDF5 has no chunks of length 0.
    if matches!(packing, Packing::Deflated) && !data.is_empty() {
        let mut packed = Packed::create(group, name, unit, shape)?;
        packed.append(data)?;
        return packed.finish();
    }
    let view = ArrayView::from_shape(IxDyn(shape), data)?;
    let builder = group.new_dataset_builder().obj_track_times(false);
    let dataset = builder.with_data(view).create(name)?;
    name_unit(&dataset, unit)?;
    dataset.flush()
}

/// What takes some numbers or rows, block after block.
pub type Give<'a, R> = &'a mut dyn FnMut(&[R]);

/// Writes an array of one or two axes as it is, whose rows come in blocks.
pub(super) fn put_blocks(
    group: &Group,
    name: &str,
    unit: &str,
    shape: &[usize],
    all: impl FnOnce(Give<'_, f64>),
) -> hdf5::Result<()> {
    let builder = group.new_dataset::<f64>().obj_track_times(false);
    let dataset = builder.shape(shape).create(name)?;
    name_unit(&dataset, unit)?;
    let width = shape[1..].iter().product::<usize>();
    let (mut written, mut result) = (0, Ok(()));
    all(&mut |numbers| {
        let rows = written..written + numbers.len() / width;
        written = rows.end;
        if result.is_ok() {
            result = match shape {
                [_] => dataset.write_slice(numbers, s![rows]),
                _ => ArrayView::from_shape([rows.len(), width], numbers)
                    .map_err(|cause| cause.to_string().into())
                    .and_then(|block| dataset.write_slice(block, s![rows, ..])),
            };
        }
    });
    result?;
    if written != shape[0] {
        return Err(format!("`{name}` has {written} rows instead of {}", shape[0]).into());
    }
    dataset.flush()
}

/// Writes one number.
pub(super) fn put_scalar<T: Number>(group: &Group, name: &str, unit: &str, value: T) -> hdf5::Result<()> {
    put(group, name, unit, &[], &[value], Packing::Plain)
}

pub(super) fn get<T: H5Type>(group: &Group, name: &str) -> hdf5::Result<Vec<T>> {
    group.dataset(name)?.read_raw()
}

/// Reads a column that must be as long as the others beside it.
pub(super) fn get_column<T: H5Type>(group: &Group, name: &str, length: usize) -> hdf5::Result<Vec<T>> {
    let column = get(group, name)?;
    if column.len() == length {
        return Ok(column);
    }
    Err(format!(
        "`{name}` has {} rows, the columns beside it have {length}",
        column.len()
    )
    .into())
}

/// Reads rows of `WIDTH` numbers each.
pub(super) fn get_rows<T: H5Type + Copy, const WIDTH: usize>(
    group: &Group,
    name: &str,
) -> hdf5::Result<Vec<[T; WIDTH]>> {
    rows(&get(group, name)?).ok_or_else(|| format!("`{name}` has no rows of {WIDTH} numbers").into())
}

/// Splits numbers into rows; `None` if they do not come out even.
pub(super) fn rows<T: Copy, const WIDTH: usize>(numbers: &[T]) -> Option<Vec<[T; WIDTH]>> {
    let (rows, rest) = numbers.as_chunks();
    rest.is_empty().then(|| rows.to_vec())
}

pub(super) fn get_scalar<T: H5Type>(group: &Group, name: &str) -> hdf5::Result<T> {
    group.dataset(name)?.read_scalar()
}
