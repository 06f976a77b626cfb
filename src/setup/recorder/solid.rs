//! What of a solid goes into the folder of its run.

use std::borrow::Cow;
use std::ops::Range;
use std::path::Path;

use super::Recorded;
use crate::analysis::columns::{Columns, SolidSetting};
use crate::domain::Of;
use crate::mesh::solid::Solid as Mesh;
use crate::mesh::solid::element::Shape;
use crate::record::frames::FieldMesh;
use crate::record::{self, Give, Picture, RecordError};
use crate::solver::solid::Row;
use crate::solver::{Moment, Solid};

impl Recorded<3> for Solid {
    type Setting = SolidSetting;
    type Vector = [f64; 3];

    fn setting(&self) -> SolidSetting {
        self.setting().clone()
    }

    fn no_rows(&self) -> Columns {
        self.columns()
    }

    fn add_row(rows: &mut Columns, reading: &Row) {
        rows.push(reading.step, &reading.numbers);
    }

    fn field_mesh(mesh: &Mesh) -> FieldMesh<[f64; 3]> {
        field_mesh(mesh)
    }

    fn write_frame(folder: &Path, moment: &Moment<Self, 3>, site_volume: f64) -> Result<(), RecordError> {
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
        self.setting().volume / self.setting().represented_atoms as f64
    }
}

/// A moment as a picture shows it.
struct Snapshot<'a> {
    moment: &'a Moment<'a, Solid, 3>,
    site_volume: f64,
}

impl Snapshot<'_> {
    /// The elements of the cells of some elements.
    fn of_cells(&self, elements: Range<usize>) -> impl Iterator<Item = usize> {
        let shapes = elements.map(|number| (number, self.moment.mesh.elements[number].shape));
        shapes.flat_map(|(number, shape)| std::iter::repeat_n(number, cells(shape).len()))
    }

    fn of_all_cells(&self) -> impl Iterator<Item = usize> {
        self.of_cells(0..self.moment.mesh.elements.len())
    }
}

impl Picture<[f64; 3]> for Snapshot<'_> {
    fn moment(&self) -> (u64, f64, f64) {
        (self.moment.step, self.moment.time, self.moment.strain)
    }

    fn counts(&self) -> [usize; 2] {
        [self.moment.mesh.node_count(), self.of_all_cells().count()]
    }

    fn displacement(&self, give: Give<'_, [f64; 3]>) {
        let Moment {
            mesh, state, domain, ..
        } = self.moment;
        let of_node = |node: usize| {
            let then = mesh.node_position(node);
            [0, 1, 2].map(|axis| state.position[axis][node] - then[axis])
        };
        domain.gather_in_blocks(Of::Nodes, of_node, |_, rows| give(rows));
    }

    fn velocity(&self, give: Give<'_, [f64; 3]>) {
        let Moment { state, domain, .. } = self.moment;
        let of_node = |node: usize| state.velocity.each_ref().map(|plane| plane[node]);
        domain.gather_in_blocks(Of::Nodes, of_node, |_, rows| give(rows));
    }

    fn stress(&self, give: Give<'_, [f64; 6]>) {
        let Moment {
            mesh, measure, domain, ..
        } = self.moment;
        let of_element = |number: usize| {
            let volume = mesh.elements[number].site_count() as f64 * self.site_volume;
            measure.virial(number).map(|component| component / volume)
        };
        domain.gather_in_blocks(Of::Elements, of_element, |from, rows| {
            let of_cells = self.of_cells(from..from + rows.len());
            let rows: Vec<[f64; 6]> = of_cells.map(|number| rows[number - from]).collect();
            give(&rows);
        });
    }

    fn damage(&self) -> Cow<'_, [f64]> {
        let broken = self.moment.broken;
        Cow::Owned(self.of_all_cells().map(|number| broken[number]).collect())
    }

    fn mesh(&self) -> Option<Cow<'_, FieldMesh<[f64; 3]>>> {
        None
    }
}

/// The cells of a shape by its corners: an octahedron is two pyramids on one square, its corners +U, -U, +V, -V, +W, -W.
fn cells(shape: Shape) -> &'static [&'static [usize]] {
    match shape {
        Shape::Atom => &[&[0]],
        Shape::Low => &[&[0, 1, 2, 3]],
        Shape::High => &[&[0, 2, 1, 3]],
        Shape::Octahedron => &[&[2, 4, 3, 5, 0], &[2, 5, 3, 4, 1]],
    }
}

/// Cells and reference positions.
fn field_mesh(mesh: &Mesh) -> FieldMesh<[f64; 3]> {
    let mut points = vec![[0.0; 3]; mesh.node_count()];
    for (number, element) in mesh.elements.iter().enumerate() {
        for (node, corner) in mesh.nodes_of(number).zip(element.corners()) {
            points[node] = mesh.sites.frame.place(element.site(corner));
        }
    }
    let mut fields = FieldMesh {
        points,
        offsets: vec![0],
        ..FieldMesh::default()
    };
    for (number, element) in mesh.elements.iter().enumerate() {
        for cell in cells(element.shape) {
            let nodes = cell.iter().map(|&corner| mesh.node(number, corner) as u32);
            fields.connectivity.extend(nodes);
            fields.offsets.push(fields.connectivity.len() as u32);
            fields.element_size.push(element.size as u32);
        }
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::solid::Plan;
    use crate::mesh::solid::sites::{Frame, Outline, Sites};

    #[test]
    fn cells_are_the_right_way_round_and_fill_as_much_as_their_elements() {
        let mesh = Mesh::new(&Plan {
            sites: Sites {
                outline: Outline::Rhombohedron([6, 6, 6]),
                frame: Frame::of_blocks(1.0),
                removed: vec![],
                cut: None,
            },
            element: 6,
            regions: vec![],
            spacing: 1.0,
        });
        let fields = field_mesh(&mesh);
        let volumes = fields.offsets.windows(2).map(|ends| {
            let nodes = &fields.connectivity[ends[0] as usize..ends[1] as usize];
            let place = |node: u32| nalgebra::Vector3::from(fields.points[node as usize]);
            let tetrahedron = |[a, b, c, d]: [u32; 4]| {
                let [b, c, d] = [b, c, d].map(|node| place(node) - place(a));
                b.cross(&c).dot(&d) / 6.0
            };
            match *nodes {
                [a, b, c, d] => vec![tetrahedron([a, b, c, d])],
                [a, b, c, d, tip] => vec![tetrahedron([a, b, c, tip]), tetrahedron([a, c, d, tip])],
                _ => panic!("a cell of {} nodes", nodes.len()),
            }
        });
        let volumes: Vec<f64> = volumes.flatten().collect();
        assert_eq!(volumes.len(), 6);
        assert!(volumes.iter().all(|&volume| volume > 0.0), "{volumes:?}");
        // Tetrahedra with 4 spacings an edge, an octahedron with 5: of a block of edge e they are e^3/(6 sqrt 2) and four of it.
        let whole: f64 = volumes.iter().sum();
        let expected = (2.0 * 64.0 + 4.0 * 125.0) / (6.0 * 2_f64.sqrt());
        assert!((whole / expected - 1.0).abs() < 1e-12, "{whole} {expected}");
    }
}
