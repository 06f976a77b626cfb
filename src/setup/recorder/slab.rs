//! What of a slab goes into the folder of its run.

use std::borrow::Cow;
use std::path::Path;

use super::Recorded;
use crate::analysis::series::{Series, Setting};
use crate::domain::Of;
use crate::lattice::triangular;
use crate::mesh::Mesh;
use crate::mesh::element::Element;
use crate::record::frames::FieldMesh;
use crate::record::{self, Give, Picture, RecordError};
use crate::solver::{Moment, Reading, Slab, site_volume};

impl Recorded<2> for Slab {
    type Setting = Setting;
    type Vector = [f64; 2];

    fn setting(&self) -> Setting {
        self.setting().clone()
    }

    fn no_rows(&self) -> Series {
        Series {
            profile_x: self.profile_x().to_vec(),
            gauge_places: self.gauge_places(),
            ..Series::default()
        }
    }

    fn add_row(rows: &mut Series, reading: &Reading) {
        rows.probes.push(reading.probe);
        rows.profiles.extend_from_slice(&reading.profile);
        rows.tractions.extend_from_slice(&reading.traction);
        rows.gauges.extend_from_slice(&reading.gauges);
        rows.bonds.extend_from_slice(&reading.bonds);
    }

    fn field_mesh(mesh: &Mesh) -> FieldMesh {
        field_mesh(mesh)
    }

    fn write_frame(folder: &Path, moment: &Moment, site_volume: f64) -> Result<(), RecordError> {
        let picture = Snapshot { moment, site_volume };
        match moment.domain.ranks().is_first() {
            true => record::write_frame(folder, &picture),
            false => {
                record::give_frame(&picture);
                Ok(())
            }
        }
    }

    fn site_volume(&self) -> f64 {
        site_volume(self.setting())
    }
}

/// A moment as a picture shows it.
struct Snapshot<'a> {
    moment: &'a Moment<'a>,
    site_volume: f64,
}

impl Picture for Snapshot<'_> {
    fn moment(&self) -> (u64, f64, f64) {
        (self.moment.step, self.moment.time, self.moment.strain)
    }

    fn counts(&self) -> [usize; 2] {
        let mesh = self.moment.mesh;
        [mesh.node_count(), mesh.elements.len()]
    }

    fn displacement(&self, give: Give<'_, [f64; 2]>) {
        let Moment {
            mesh, state, domain, ..
        } = self.moment;
        let [x, y] = &state.position;
        let of_node = |node: usize| {
            let [from_x, from_y] = mesh.node_position(node);
            [x[node] - from_x, y[node] - from_y]
        };
        domain.gather_in_blocks(Of::Nodes, of_node, |_, rows| give(rows));
    }

    fn velocity(&self, give: Give<'_, [f64; 2]>) {
        let [x, y] = &self.moment.state.velocity;
        let of_node = |node: usize| [x[node], y[node]];
        let domain = self.moment.domain;
        domain.gather_in_blocks(Of::Nodes, of_node, |_, rows| give(rows));
    }

    fn stress(&self, give: Give<'_, [f64; 3]>) {
        let Moment {
            mesh, measure, domain, ..
        } = self.moment;
        let of_element = |number: usize| {
            let volume = mesh.elements[number].site_count() as f64 * self.site_volume;
            measure.virial(number).map(|component| component / volume)
        };
        domain.gather_in_blocks(Of::Elements, of_element, |_, rows| give(rows));
    }

    fn damage(&self) -> Cow<'_, [f64]> {
        Cow::Owned(damage(self.moment.mesh, self.moment.broken))
    }

    fn mesh(&self) -> Option<Cow<'_, FieldMesh>> {
        let changes = self.moment.mesh_changes;
        changes.then(|| Cow::Owned(field_mesh(self.moment.mesh)))
    }
}

/// Cells and reference positions, x from the left edge and y from the crack plane.
fn field_mesh(mesh: &Mesh) -> FieldMesh {
    let [left, middle] = [mesh.sites.left() * mesh.spacing, mesh.middle_height()];
    let mut points = vec![[0.0; 2]; mesh.node_count()];
    let mut connectivity = Vec::with_capacity(points.len());
    let mut offsets = Vec::with_capacity(mesh.elements.len() + 1);
    offsets.push(0);
    for (number, element) in mesh.elements.iter().enumerate() {
        for (node, corner) in mesh.nodes_of(number).zip(element.corners()) {
            let [x, y] = mesh.reference(corner);
            points[node] = [x - left, y - middle];
            connectivity.push(node as u32);
        }
        offsets.push(connectivity.len() as u32);
    }
    FieldMesh {
        points,
        connectivity,
        offsets,
        element_size: mesh.elements.iter().map(|element| element.size as u32).collect(),
    }
}

/// For every element the broken share of the reference bonds of its sites.
fn damage(mesh: &Mesh, broken: &[[i32; 3]]) -> Vec<f64> {
    let mut count = vec![0.0; mesh.elements.len()];
    for &[column, row, direction] in broken {
        let vector = triangular::NEAREST[direction as usize];
        for site in [[column, row], [column + vector[0], row + vector[1]]] {
            if let Some(owner) = mesh.owner_of(site) {
                count[owner] += 1.0;
            }
        }
    }
    let shares = count.iter_mut().zip(&mesh.elements);
    shares.for_each(|(broken, element)| *broken /= bonds_of(element));
    count
}

/// Nearest-neighbour bonds that touch the sites of an element: six a site, those inside counted once.
fn bonds_of(element: &Element) -> f64 {
    let inside = 3 * element.size * (element.size - 1) / 2;
    6.0 * element.site_count() as f64 - f64::from(inside)
}
