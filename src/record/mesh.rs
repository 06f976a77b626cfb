//! The mesh of the published pictures, in VTK's terms.

use hdf5::Group;
use hdf5::types::FixedAscii;

use super::arrays::{Packing, get, get_rows, new_group, put};
use super::field::padded;
use super::frames::{FieldMesh, Vector};

/// Writes the mesh into the empty group of a grid.
pub(super) fn put_mesh<V: Vector>(grid: &Group, mesh: &FieldMesh<V>) -> hdf5::Result<()> {
    grid.new_attr_builder().with_data(&[2_i64, 0]).create("Version")?;
    let kind = FixedAscii::<16>::from_ascii("UnstructuredGrid").map_err(|cause| cause.to_string())?;
    grid.new_attr::<FixedAscii<16>>().create("Type")?.write_scalar(&kind)?;

    let types = mesh
        .offsets
        .windows(2)
        .map(|ends| cell_type(ends[1] - ends[0]))
        .collect::<Result<Vec<u8>, _>>()?;
    let points: Vec<f64> = mesh.points.iter().flat_map(|&point| padded(point)).collect();
    let connectivity: Vec<i64> = mesh.connectivity.iter().map(|node| i64::from(*node)).collect();
    let offsets: Vec<i64> = mesh.offsets.iter().map(|offset| i64::from(*offset)).collect();
    for (name, count) in [
        ("NumberOfPoints", mesh.points.len()),
        ("NumberOfCells", types.len()),
        ("NumberOfConnectivityIds", connectivity.len()),
    ] {
        put(grid, name, "1", &[1], &[count as i64], Packing::Plain)?;
    }
    put(
        grid,
        "Points",
        "nm",
        &[mesh.points.len(), 3],
        &points,
        Packing::Deflated,
    )?;
    put(
        grid,
        "Connectivity",
        "1",
        &[connectivity.len()],
        &connectivity,
        Packing::Deflated,
    )?;
    put(grid, "Offsets", "1", &[offsets.len()], &offsets, Packing::Deflated)?;
    put(grid, "Types", "1", &[types.len()], &types, Packing::Deflated)?;

    let cells = new_group(grid, "CellData")?;
    put(
        &cells,
        "element_size",
        "1",
        &[types.len()],
        &mesh.element_size,
        Packing::Deflated,
    )
}

/// Reads what [`put_mesh`] wrote.
pub(super) fn get_mesh<V: Vector>(grid: &Group) -> hdf5::Result<FieldMesh<V>> {
    let points: Vec<[f64; 3]> = get_rows(grid, "Points")?;
    let mesh = FieldMesh {
        points: points.iter().map(|point| V::of(point)).collect(),
        connectivity: get(grid, "Connectivity")?,
        offsets: get(grid, "Offsets")?,
        element_size: get(grid, "CellData/element_size")?,
    };
    check_mesh(&mesh)?;
    Ok(mesh)
}

/// What is wrong with a mesh, if anything: every cell has its nodes, and they exist.
pub(super) fn check_mesh<V>(mesh: &FieldMesh<V>) -> Result<(), String> {
    let FieldMesh {
        points,
        connectivity,
        offsets,
        element_size,
    } = mesh;
    if offsets.len() != element_size.len() + 1 || offsets.last().map(|end| *end as usize) != Some(connectivity.len()) {
        return Err("the offsets of the mesh do not fit its cells".to_owned());
    }
    if connectivity.iter().any(|node| *node as usize >= points.len()) {
        return Err("a cell of the mesh has a node that does not exist".to_owned());
    }
    offsets
        .windows(2)
        .try_for_each(|ends| cell_type(ends[1].wrapping_sub(ends[0])).map(|_| ()))
}

/// VTK's number for a cell of so many nodes.
fn cell_type(nodes: u32) -> Result<u8, String> {
    const VTK_VERTEX: u8 = 1;
    const VTK_TRIANGLE: u8 = 5;
    const VTK_TETRA: u8 = 10;
    const VTK_PYRAMID: u8 = 14;
    match nodes {
        1 => Ok(VTK_VERTEX),
        3 => Ok(VTK_TRIANGLE),
        4 => Ok(VTK_TETRA),
        5 => Ok(VTK_PYRAMID),
        _ => Err(format!(
            "a cell of the mesh has {nodes} nodes, neither an atom's 1, a triangle's 3, a tetrahedron's 4 nor a pyramid's 5"
        )),
    }
}
