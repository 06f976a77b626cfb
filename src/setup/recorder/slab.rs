//! What of a slab goes into the folder of its run.

use std::borrow::Cow;
use std::path::Path;

use super::{Recorded, collected};
use crate::analysis::series::{Series, Setting};
use crate::lattice::triangular;
use crate::mesh::Mesh;
use crate::mesh::element::Element;
use crate::record::frames::FieldMesh;
use crate::record::{self, Picture, RecordError};
use crate::solver::{Instruments, Moment, Reading, Slab, site_volume};

impl Recorded<2> for Slab {
    type Setting = Setting;
    type Vector = [f64; 2];

    fn setting(&self) -> Setting {
        self.setting().clone()
    }

    fn no_rows(&self) -> Series {
        Series {
            profile_x: self.profile_x().to_vec(),
            gauge_places: self.gauge_places().to_vec(),
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

    fn field_mesh(&self) -> FieldMesh {
        field_mesh(self.mesh())
    }

    fn write_frame(folder: &Path, moment: &Moment, site_volume: f64) -> Result<(), RecordError> {
        record::write_frame(folder, &Snapshot { moment, site_volume })
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

    fn displacement(&self) -> Cow<'_, [[f64; 2]]> {
        let Moment { mesh, state, .. } = self.moment;
        let [x, y] = &state.position;
        let [from_x, from_y] = mesh.node_positions();
        let moved = x.iter().zip(from_x).zip(y.iter().zip(from_y));
        let displacement = moved.map(|((x, from_x), (y, from_y))| [x - from_x, y - from_y]);
        Cow::Owned(collected(state.nodes(), displacement))
    }

    fn velocity(&self) -> Cow<'_, [[f64; 2]]> {
        let [x, y] = &self.moment.state.velocity;
        Cow::Owned(x.iter().zip(y).map(|(&x, &y)| [x, y]).collect())
    }

    fn stress(&self) -> Cow<'_, [[f64; 3]]> {
        let Moment { mesh, measure, .. } = self.moment;
        let stress = mesh.elements.iter().enumerate().map(|(number, element)| {
            let volume = element.site_count() as f64 * self.site_volume;
            measure.virial(number).map(|component| component / volume)
        });
        Cow::Owned(stress.collect())
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
    let [x, y] = mesh.node_positions();
    let mut offsets = vec![0];
    for element in &mesh.elements {
        offsets.push(offsets[offsets.len() - 1] + element.node_count() as u32);
    }
    FieldMesh {
        points: x.iter().zip(&y).map(|(x, y)| [x - left, y - middle]).collect(),
        connectivity: (0..mesh.elements.len())
            .flat_map(|element| mesh.nodes_of(element))
            .map(|node| node as u32)
            .collect(),
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
