//! The pictures of a run that goes on: a small sealed file each, in full precision and internal units.

use std::borrow::Cow;
use std::path::Path;

use hdf5::Group;

use super::RecordError;
use super::arrays::{Packing, get, get_column, get_scalar, new_group, put, put_scalar};
use super::frames::{FieldMesh, Frame, Row, Vector};
use super::pieces::frame_path;
use super::sealed::{self, Seal};

/// What a picture is made of, field by field, so that no more than one of them need be in memory. Where ranks share the first
/// three fields, all ask for each together, in this order.
pub trait Picture<V: Vector = [f64; 2]> {
    /// Step, time (ps) and nominal strain.
    fn moment(&self) -> (u64, f64, f64);
    /// A node: displacement (nm).
    fn displacement(&self) -> Cow<'_, [V]>;
    /// A node: velocity (nm/ps).
    fn velocity(&self) -> Cow<'_, [V]>;
    /// A cell: virial stress, eV/nm^3.
    fn stress(&self) -> Cow<'_, [V::Stress]>;
    /// A cell: share of what could break that is broken, 0 to 1.
    fn damage(&self) -> Cow<'_, [f64]>;
    /// Its own cells where the mesh of the run changes.
    fn mesh(&self) -> Option<Cow<'_, FieldMesh<V>>>;
}

impl<V: Vector> Picture<V> for Frame<V> {
    fn moment(&self) -> (u64, f64, f64) {
        (self.step, self.time, self.strain)
    }

    fn displacement(&self) -> Cow<'_, [V]> {
        Cow::Borrowed(&self.displacement)
    }

    fn velocity(&self) -> Cow<'_, [V]> {
        Cow::Borrowed(&self.velocity)
    }

    fn stress(&self) -> Cow<'_, [V::Stress]> {
        Cow::Borrowed(&self.stress)
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
    picture.displacement();
    picture.velocity();
    picture.stress();
}

/// The cells of a picture that has its own.
pub(super) fn read_cells<V: Vector>(path: &Path) -> Result<Option<FieldMesh<V>>, RecordError> {
    let file = sealed::open(path, FRAME)?;
    get_cells(&file).map_err(|cause| RecordError::damaged(path, cause))
}

pub(super) fn read_frame<V: Vector>(path: &Path) -> Result<Frame<V>, RecordError> {
    let file = sealed::open(path, FRAME)?;
    get_frame(&file).map_err(|cause| RecordError::damaged(path, cause))
}

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
    put_rows(group, "displacement", "nm", &picture.displacement())?;
    put_rows(group, "velocity", "nm/ps", &picture.velocity())?;
    put_rows(group, "stress", "eV/nm^3", &picture.stress())?;
    let damage = picture.damage();
    put(group, "damage", "1", &[damage.len()], &damage, Packing::Plain)?;
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

fn get_frame<V: Vector>(group: &Group) -> hdf5::Result<Frame<V>> {
    let stress: Vec<V::Stress> = get_rows(group, "stress")?;
    Ok(Frame {
        step: get_scalar(group, "step")?,
        time: get_scalar(group, "time")?,
        strain: get_scalar(group, "strain")?,
        displacement: get_rows(group, "displacement")?,
        velocity: get_rows(group, "velocity")?,
        damage: get_column(group, "damage", stress.len())?,
        mesh: get_cells(group)?,
        stress,
    })
}
