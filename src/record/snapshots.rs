//! The pictures of a run that goes on: a small sealed file each, in full precision and internal units.

use std::borrow::Cow;
use std::path::Path;

use hdf5::Group;

use super::RecordError;
use super::arrays::{Give, Packing, get, get_scalar, new_group, put, put_blocks, put_scalar};
use super::frames::{FieldMesh, Frame, Row, Vector};
use super::pieces::frame_path;
use super::sealed::{self, Seal};

/// What a picture is made of, field by field and these block by block, so that no field need be in memory. Where ranks share the
/// first three fields, all ask for each together, in this order, and the first is given the blocks.
pub trait Picture<V: Vector = [f64; 2]> {
    /// Step, time (ps) and nominal strain.
    fn moment(&self) -> (u64, f64, f64);
    /// How many nodes and cells it has.
    fn counts(&self) -> [usize; 2];
    /// A node: displacement (nm).
    fn displacement(&self, give: Give<'_, V>);
    /// A node: velocity (nm/ps).
    fn velocity(&self, give: Give<'_, V>);
    /// A cell: virial stress, eV/nm^3.
    fn stress(&self, give: Give<'_, V::Stress>);
    /// A cell: share of what could break that is broken, 0 to 1.
    fn damage(&self) -> Cow<'_, [f64]>;
    /// Its own cells where the mesh of the run changes.
    fn mesh(&self) -> Option<Cow<'_, FieldMesh<V>>>;
}

impl<V: Vector> Picture<V> for Frame<V> {
    fn moment(&self) -> (u64, f64, f64) {
        (self.step, self.time, self.strain)
    }

    fn counts(&self) -> [usize; 2] {
        [self.displacement.len(), self.stress.len()]
    }

    fn displacement(&self, give: Give<'_, V>) {
        give(&self.displacement);
    }

    fn velocity(&self, give: Give<'_, V>) {
        give(&self.velocity);
    }

    fn stress(&self, give: Give<'_, V::Stress>) {
        give(&self.stress);
    }

    fn damage(&self) -> Cow<'_, [f64]> {
        Cow::Borrowed(&self.damage)
    }

    fn mesh(&self) -> Option<Cow<'_, FieldMesh<V>>> {
        self.mesh.as_ref().map(Cow::Borrowed)
    }
}

/// Writes one picture of the run.
pub fn write_frame<V: Vector>(dir: &Path, picture: &impl Picture<V>) -> Result<(), RecordError> {
    let (step, ..) = picture.moment();
    sealed::write(&frame_path(dir, step), FRAME, |group| put_picture(group, picture))
}

/// What a rank that writes nothing takes part in while the first writes a picture.
pub fn give_frame<V: Vector>(picture: &impl Picture<V>) {
    picture.displacement(&mut |_| ());
    picture.velocity(&mut |_| ());
    picture.stress(&mut |_| ());
}

/// A picture of the run that is read field by field.
pub(super) struct OpenFrame<'a> {
    path: &'a Path,
    file: hdf5::File,
}

impl<'a> OpenFrame<'a> {
    pub(super) fn open(path: &'a Path) -> Result<Self, RecordError> {
        let file = sealed::open(path, FRAME)?;
        Ok(Self { path, file })
    }

    /// Step, time (ps) and nominal strain.
    pub(super) fn moment(&self) -> Result<(u64, f64, f64), RecordError> {
        let time = self.read(|group| get_scalar(group, "time"))?;
        let strain = self.read(|group| get_scalar(group, "strain"))?;
        Ok((self.read(|group| get_scalar(group, "step"))?, time, strain))
    }

    /// A field in internal units, row by row, which is to have so many numbers.
    pub(super) fn numbers(&self, name: &str, count: usize) -> Result<Vec<f64>, RecordError> {
        let numbers: Vec<f64> = self.read(|group| get(group, name))?;
        match numbers.len() == count {
            true => Ok(numbers),
            false => Err(RecordError::gap(
                self.path,
                "the frame has other nodes or cells than the mesh",
            )),
        }
    }

    /// The cells of a picture that has its own.
    pub(super) fn cells<V: Vector>(&self) -> Result<Option<FieldMesh<V>>, RecordError> {
        self.read(get_cells)
    }

    fn read<T>(&self, get: impl FnOnce(&Group) -> hdf5::Result<T>) -> Result<T, RecordError> {
        get(&self.file).map_err(|cause| RecordError::damaged(self.path, cause))
    }
}

/// The fields of a picture.
pub(super) const DISPLACEMENT: &str = "displacement";
pub(super) const VELOCITY: &str = "velocity";
pub(super) const STRESS: &str = "stress";
pub(super) const DAMAGE: &str = "damage";

const FRAME: Seal = Seal {
    kind: "frame",
    format: 1,
    case_id: "",
};

fn put_picture<V: Vector>(group: &Group, picture: &impl Picture<V>) -> hdf5::Result<()> {
    let (step, time, strain) = picture.moment();
    put_scalar(group, "step", "1", step)?;
    put_scalar(group, "time", "ps", time)?;
    put_scalar(group, "strain", "1", strain)?;
    let [nodes, cells] = picture.counts();
    put_field(group, DISPLACEMENT, "nm", nodes, |give| picture.displacement(give))?;
    put_field(group, VELOCITY, "nm/ps", nodes, |give| picture.velocity(give))?;
    put_field(group, STRESS, "eV/nm^3", cells, |give| picture.stress(give))?;
    let damage = picture.damage();
    put(group, DAMAGE, "1", &[damage.len()], &damage, Packing::Plain)?;
    match picture.mesh() {
        Some(mesh) => put_cells(&new_group(group, MESH)?, &mesh),
        None => Ok(()),
    }
}

/// Group of the cells of a picture that has its own.
const MESH: &str = "mesh";

fn put_cells<V: Vector>(group: &Group, mesh: &FieldMesh<V>) -> hdf5::Result<()> {
    put_rows(group, "points", "nm", &mesh.points)?;
    for (name, numbers) in [
        ("connectivity", &mesh.connectivity),
        ("offsets", &mesh.offsets),
        ("element_size", &mesh.element_size),
    ] {
        put(group, name, "1", &[numbers.len()], numbers, Packing::Plain)?;
    }
    Ok(())
}

fn get_cells<V: Vector>(parent: &Group) -> hdf5::Result<Option<FieldMesh<V>>> {
    if !parent.link_exists(MESH) {
        return Ok(None);
    }
    let group = parent.group(MESH)?;
    Ok(Some(FieldMesh {
        points: get_rows(&group, "points")?,
        connectivity: get(&group, "connectivity")?,
        offsets: get(&group, "offsets")?,
        element_size: get(&group, "element_size")?,
    }))
}

/// So many rows that come in blocks.
fn put_field<R: Row>(
    group: &Group,
    name: &str,
    unit: &str,
    count: usize,
    all: impl FnOnce(Give<'_, R>),
) -> hdf5::Result<()> {
    put_blocks(group, name, unit, &[count, R::WIDTH], |give| {
        all(&mut |rows| give(R::flat(rows)));
    })
}

fn put_rows<R: Row>(group: &Group, name: &str, unit: &str, rows: &[R]) -> hdf5::Result<()> {
    put(
        group,
        name,
        unit,
        &[rows.len(), R::WIDTH],
        R::flat(rows),
        Packing::Plain,
    )
}

fn get_rows<R: Row>(group: &Group, name: &str) -> hdf5::Result<Vec<R>> {
    R::split(&get(group, name)?).ok_or_else(|| format!("`{name}` has no rows of {} numbers", R::WIDTH).into())
}
