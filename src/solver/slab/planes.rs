//! Gauges where a study wants them: lines across a slab, whose mean velocity and stress every probe records.

use super::probe::site_volume;
use crate::analysis::series::Setting;
use crate::forces::Measure;
use crate::lattice::triangular;
use crate::mesh::Mesh;
use crate::state::State;

/// Lines across the slab, parallel to its left edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Planes {
    /// nm from the left edge and from mid-height.
    places: Vec<[f64; 2]>,
    lines: Vec<Line>,
}

/// What of a slab is on a line: two sites of every lattice row that reaches it, with weights that give a linear field its
/// value on the line.
#[derive(Clone, Debug, Default, PartialEq)]
struct Line {
    /// Nodes, and the weights of the sites that they carry.
    nodes: Vec<(u32, f64)>,
    /// Elements, and the weight of their sites over how many they have.
    elements: Vec<(u32, f64)>,
    /// Of all sites.
    weight: f64,
}

impl Planes {
    /// Lines at so many nm from the left edge.
    pub fn new(mesh: &Mesh, setting: &Setting, at: &[f64]) -> Self {
        Self {
            places: at.iter().map(|&x| [x, 0.0]).collect(),
            lines: at.iter().map(|&x| Line::new(mesh, setting, x)).collect(),
        }
    }

    /// nm from the left edge and from mid-height.
    pub fn places(&self) -> &[[f64; 2]] {
        &self.places
    }

    /// Elements with sites beside the lines.
    pub fn elements(&self) -> impl Iterator<Item = u32> {
        self.lines
            .iter()
            .flat_map(|line| line.elements.iter().map(|&(element, _)| element))
    }

    /// Mean velocity x, y (nm/ps) and virial stress xx, yy, xy (eV/nm^3) of every line; not numbers where no row reaches it.
    pub fn read(&self, state: &State, measure: &Measure, setting: &Setting) -> Vec<[f64; 5]> {
        let volume = site_volume(setting);
        let read = |line: &Line| {
            let mut sum = [0.0; 5];
            for &(node, weight) in &line.nodes {
                (0..2).for_each(|axis| sum[axis] += weight * state.velocity[axis][node as usize]);
            }
            for &(element, weight) in &line.elements {
                let virial = measure.virial(element as usize);
                (0..3).for_each(|part| sum[2 + part] += weight * virial[part] / volume);
            }
            sum.map(|total| total / line.weight)
        };
        self.lines.iter().map(read).collect()
    }
}

impl Line {
    fn new(mesh: &Mesh, setting: &Setting, x: f64) -> Self {
        let mut line = Self::default();
        for row in 0..mesh.sites.rows() {
            let first = mesh.sites.columns(row).start;
            let from = setting.left_x + x - triangular::position([first, row])[0] * mesh.spacing;
            let behind = (from / mesh.spacing).floor();
            let ahead = from / mesh.spacing - behind;
            let column = first + behind as i32;
            let both = [(column, 1.0 - ahead), (column + 1, ahead)];
            let carried = both.map(|(column, weight)| Some((mesh.carriers([column, row])?, weight)));
            // The teeth of the ends do not reach every line.
            let [Some(one), Some(other)] = carried else { continue };
            for ((element, carriers), weight) in [one, other] {
                let sites = mesh.elements[element].site_count() as f64;
                line.elements.push((element as u32, weight / sites));
                let nodes = carriers.into_iter();
                line.nodes
                    .extend(nodes.map(|(node, share)| (node as u32, weight * share)));
            }
            line.weight += 1.0;
        }
        line
    }
}
