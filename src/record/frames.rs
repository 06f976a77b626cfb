//! The pictures of a run: a mesh and fields on it at chosen steps, each on a mesh of its own where that changes.

/// A row of numbers in a table.
pub trait Row: Copy + Default + PartialEq {
    const WIDTH: usize;
    fn flat(rows: &[Self]) -> &[f64];
    /// Splits numbers into rows; `None` if they do not come out even.
    fn split(numbers: &[f64]) -> Option<Vec<Self>>;
    /// A row with these numbers, of which there are enough.
    fn of(numbers: &[f64]) -> Self;
}

/// A vector of the space that a specimen lives in.
pub trait Vector: Row {
    /// A symmetric tensor of that space.
    type Stress: Tensor;
}

/// A symmetric tensor.
pub trait Tensor: Row {
    /// Which of its components VTK's xx, yy, zz, xy, yz, xz are; those of a plane have none out of it.
    const IN_VTK: [Option<usize>; 6];
    /// What its components are called, in their order.
    const COMPONENTS: &'static [&'static str];
}

impl<const WIDTH: usize> Row for [f64; WIDTH]
where
    Self: Default + PartialEq,
{
    const WIDTH: usize = WIDTH;

    fn flat(rows: &[Self]) -> &[f64] {
        rows.as_flattened()
    }

    fn split(numbers: &[f64]) -> Option<Vec<Self>> {
        super::arrays::rows(numbers)
    }

    fn of(numbers: &[f64]) -> Self {
        std::array::from_fn(|component| numbers[component])
    }
}

impl Vector for [f64; 2] {
    /// xx, yy, xy
    type Stress = [f64; 3];
}

impl Vector for [f64; 3] {
    /// xx, yy, zz, yz, xz, xy
    type Stress = [f64; 6];
}

impl Tensor for [f64; 3] {
    const IN_VTK: [Option<usize>; 6] = [Some(0), Some(1), None, Some(2), None, None];
    const COMPONENTS: &'static [&'static str] = &["xx", "yy", "xy"];
}

impl Tensor for [f64; 6] {
    const IN_VTK: [Option<usize>; 6] = [Some(0), Some(1), Some(2), Some(5), Some(3), Some(4)];
    const COMPONENTS: &'static [&'static str] = &["xx", "yy", "zz", "yz", "xz", "xy"];
}

/// Cells and reference positions, as ParaView wants them. Written once a run, or with each picture of a mesh that changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FieldMesh<V = [f64; 2]> {
    /// Reference positions of the nodes, nm.
    pub points: Vec<V>,
    /// Nodes of every cell, one after the other; one node is an atom, three a triangle, four a tetrahedron, five a pyramid with
    /// its tip last.
    pub connectivity: Vec<u32>,
    /// Where each cell's nodes start in `connectivity`, and its length at the end.
    pub offsets: Vec<u32>,
    /// Atoms an edge of each cell (1: atom).
    pub element_size: Vec<u32>,
}

/// Fields at one step, in internal units (nm, ps; stress in eV/nm^3 here, written in GPa).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame<V: Vector = [f64; 2]> {
    pub step: u64,
    /// ps
    pub time: f64,
    /// Nominal strain.
    pub strain: f64,
    /// A node: displacement (nm) and velocity (nm/ps).
    pub displacement: Vec<V>,
    pub velocity: Vec<V>,
    /// A cell: virial stress xx, yy, xy, or xx, yy, zz, yz, xz, xy, eV/nm^3.
    pub stress: Vec<V::Stress>,
    /// A cell: share of what could break that is broken, 0 to 1: of the reference bonds of its sites, or of its faces.
    pub damage: Vec<f64>,
    /// Its own cells where the mesh of the run changes; `None`: those of the run.
    pub mesh: Option<FieldMesh<V>>,
}
