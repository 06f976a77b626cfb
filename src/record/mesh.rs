//! The mesh of the published pictures, in VTK's terms.

use hdf5::Group;
use hdf5::types::FixedAscii;

use ndarray::s;

use super::arrays::{Packing, get, get_column, new_group, put};
use super::field::padded;
use super::frames::{FieldMesh, Vector};
use super::packed::Packed;

/// Rows that are made ready for the file at once: many chunks, which are packed side by side.
pub(super) const BLOCK_ROWS: usize = 1 << 19;

/// How many points, cells and places of connectivity a mesh has.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sizes {
    pub points: usize,
    pub cells: usize,
    pub connectivity: usize,
}

impl Sizes {
    pub(super) fn of<V>(mesh: &FieldMesh<V>) -> Self {
        Self {
            points: mesh.points.len(),
            cells: mesh.element_size.len(),
            connectivity: mesh.connectivity.len(),
        }
    }

    /// Those of several meshes one after the other.
    pub(super) fn sum(of: &[Self]) -> Self {
        of.iter().fold(Self::default(), |sum, sizes| Self {
            points: sum.points + sizes.points,
            cells: sum.cells + sizes.cells,
            connectivity: sum.connectivity + sizes.connectivity,
        })
    }
}

/// The meshes of a grid on the way into its file, one after the other; VTK calls each a part.
pub(super) struct Parts {
    points: Packed<f64>,
    connectivity: Packed<i64>,
    offsets: Packed<i64>,
    types: Packed<u8>,
    element_size: Packed<u32>,
}

impl Parts {
    /// Begins meshes of these sizes in the empty group of a grid.
    pub(super) fn create(grid: &Group, sizes: &[Sizes]) -> hdf5::Result<Self> {
        grid.new_attr_builder().with_data(&[2_i64, 0]).create("Version")?;
        let kind = FixedAscii::<16>::from_ascii("UnstructuredGrid").map_err(|cause| cause.to_string())?;
        grid.new_attr::<FixedAscii<16>>().create("Type")?.write_scalar(&kind)?;
        let count = |name: &str, of: fn(&Sizes) -> usize| {
            let counts: Vec<i64> = sizes.iter().map(|sizes| of(sizes) as i64).collect();
            put(grid, name, "1", &[counts.len()], &counts, Packing::Plain)
        };
        count("NumberOfPoints", |sizes| sizes.points)?;
        count("NumberOfCells", |sizes| sizes.cells)?;
        count("NumberOfConnectivityIds", |sizes| sizes.connectivity)?;
        let all = Sizes::sum(sizes);
        Ok(Self {
            points: Packed::create(grid, "Points", "nm", &[all.points, 3])?,
            connectivity: Packed::create(grid, "Connectivity", "1", &[all.connectivity])?,
            offsets: Packed::create(grid, "Offsets", "1", &[all.cells + sizes.len()])?,
            types: Packed::create(grid, "Types", "1", &[all.cells])?,
            element_size: Packed::create(&new_group(grid, "CellData")?, "element_size", "1", &[all.cells])?,
        })
    }

    pub(super) fn append<V: Vector>(&mut self, mesh: &FieldMesh<V>) -> hdf5::Result<()> {
        let types = mesh.offsets.windows(2).map(|ends| cell_type(ends[1] - ends[0]));
        for block in mesh.points.chunks(BLOCK_ROWS) {
            let points: Vec<f64> = block.iter().flat_map(|&point| padded(point)).collect();
            self.points.append(&points)?;
        }
        let long = |numbers: &[u32]| -> Vec<i64> { numbers.iter().map(|&number| i64::from(number)).collect() };
        for (packed, numbers) in [
            (&mut self.connectivity, &mesh.connectivity),
            (&mut self.offsets, &mesh.offsets),
        ] {
            let mut blocks = numbers.chunks(BLOCK_ROWS);
            blocks.try_for_each(|block| packed.append(&long(block)))?;
        }
        self.types.append(&types.collect::<Result<Vec<u8>, _>>()?)?;
        self.element_size.append(&mesh.element_size)
    }

    pub(super) fn finish(self) -> hdf5::Result<()> {
        self.points.finish()?;
        self.connectivity.finish()?;
        self.offsets.finish()?;
        self.types.finish()?;
        self.element_size.finish()
    }
}

/// The sizes of the meshes of a grid.
pub(super) fn get_sizes(grid: &Group) -> hdf5::Result<Vec<Sizes>> {
    let points: Vec<i64> = get(grid, "NumberOfPoints")?;
    let cells: Vec<i64> = get_column(grid, "NumberOfCells", points.len())?;
    let connectivity: Vec<i64> = get_column(grid, "NumberOfConnectivityIds", points.len())?;
    let sizes = points.into_iter().zip(cells).zip(connectivity);
    let sizes = sizes.map(|((points, cells), connectivity)| Sizes {
        points: points as usize,
        cells: cells as usize,
        connectivity: connectivity as usize,
    });
    Ok(sizes.collect())
}

/// Reads one of the meshes of these sizes, by its number.
pub(super) fn get_mesh<V: Vector>(grid: &Group, sizes: &[Sizes], part: usize) -> hdf5::Result<FieldMesh<V>> {
    let before = sizes.get(..part).map(Sizes::sum).unwrap_or_default();
    let own = *sizes.get(part).ok_or("a step has a mesh that is not there")?;
    let points = grid.dataset("Points")?;
    let points = points.read_slice_2d::<f64, _>(s![before.points..before.points + own.points, ..])?;
    let numbers = |name: &str, from: usize, count: usize| -> hdf5::Result<Vec<u32>> {
        let numbers = grid.dataset(name)?.read_slice_1d::<u32, _>(from..from + count)?;
        Ok(numbers.to_vec())
    };
    let mesh = FieldMesh {
        points: points.rows().into_iter().map(|row| V::of(&row.to_vec())).collect(),
        connectivity: numbers("Connectivity", before.connectivity, own.connectivity)?,
        offsets: numbers("Offsets", before.cells + part, own.cells + 1)?,
        element_size: numbers("CellData/element_size", before.cells, own.cells)?,
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
