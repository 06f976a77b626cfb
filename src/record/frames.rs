//! The pictures of a run: a mesh that does not change and fields on it at chosen steps.

/// Cells and reference positions, as ParaView wants them. Written once a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FieldMesh {
    /// Reference positions of the nodes, nm.
    pub points: Vec<[f64; 2]>,
    /// Nodes of every cell, one after the other; one node is an atom, three a triangle.
    pub connectivity: Vec<u32>,
    /// Where each cell's nodes start in `connectivity`, and its length at the end.
    pub offsets: Vec<u32>,
    /// Atoms an edge of each cell (1: atom).
    pub element_size: Vec<u32>,
}

/// Fields at one step, in internal units (nm, ps; stress in eV/nm^3 here, written in GPa).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    pub step: u64,
    /// ps
    pub time: f64,
    /// Nominal strain.
    pub strain: f64,
    /// A node: displacement (nm) and velocity (nm/ps).
    pub displacement: Vec<[f64; 2]>,
    pub velocity: Vec<[f64; 2]>,
    /// A cell: virial stress xx, yy, xy, eV/nm^3.
    pub stress: Vec<[f64; 3]>,
    /// A cell: share of the reference bonds of its sites that are broken, 0 to 1.
    pub damage: Vec<f64>,
}
