//! Faces of cells and atoms as pixels: what is nearer hides what is farther, faces that look away are darker.

use std::ops::Range;

use super::view::View;
use crate::record::frames::FieldMesh;

/// Faces of cells by the places of their corners.
const TETRAHEDRON: [&[usize]; 4] = [&[0, 1, 2], &[0, 1, 3], &[0, 2, 3], &[1, 2, 3]];
const PYRAMID: [&[usize]; 6] = [&[0, 1, 2], &[0, 2, 3], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]];

/// How bright a face is that is seen from its edge.
pub const DARKEST: f64 = 0.55;

pub struct Raster<'a> {
    view: &'a View,
    size: [usize; 2],
    colours: Vec<[u8; 3]>,
    depth: Vec<f64>,
}

impl<'a> Raster<'a> {
    pub fn new(view: &'a View, size: [usize; 2]) -> Self {
        let pixels = size[0] * size[1];
        Self {
            view,
            size,
            colours: vec![[255; 3]; pixels],
            depth: vec![f64::NEG_INFINITY; pixels],
        }
    }

    /// The cells of a mesh that have a colour, with its nodes at these places; atoms are discs of a radius, nm.
    pub fn paint(&mut self, mesh: &FieldMesh<[f64; 3]>, places: &[[f64; 3]], colours: &[Option<[u8; 3]>], radius: f64) {
        let cells = mesh.offsets.windows(2).zip(&mesh.element_size).zip(colours);
        for ((ends, &size), &colour) in cells {
            let Some(colour) = colour else { continue };
            let nodes = &mesh.connectivity[ends[0] as usize..ends[1] as usize];
            let mut corners: Vec<[f64; 3]> = nodes.iter().map(|&node| places[node as usize]).collect();
            fill_its_share(&mut corners, f64::from(size));
            corners.iter_mut().for_each(|corner| *corner = self.seen(*corner));
            let faces: &[&[usize]] = match corners.len() {
                1 => {
                    self.disc(corners[0], radius, colour);
                    continue;
                }
                4 => &TETRAHEDRON,
                _ => &PYRAMID,
            };
            for face in faces {
                self.triangle([corners[face[0]], corners[face[1]], corners[face[2]]], colour);
            }
        }
    }

    /// Three bytes a pixel, from the upper left one on.
    pub fn pixels(self) -> Vec<u8> {
        self.colours.into_flattened()
    }

    /// Pixels to the right and down, and nm towards who looks.
    fn seen(&self, place: [f64; 3]) -> [f64; 3] {
        let [right, above, near] = self.view.seen(place);
        let [across, up] = &self.view.ranges;
        let x = (right - across.start) / (across.end - across.start) * self.size[0] as f64;
        let y = (up.end - above) / (up.end - up.start) * self.size[1] as f64;
        [x, y, near]
    }

    fn set(&mut self, x: usize, y: usize, depth: f64, colour: [u8; 3]) {
        let pixel = y * self.size[0] + x;
        if depth > self.depth[pixel] {
            self.depth[pixel] = depth;
            self.colours[pixel] = colour;
        }
    }

    /// Whole pixels between two places, within the picture.
    fn span(&self, from: f64, to: f64, axis: usize) -> Range<usize> {
        let end = self.size[axis] as f64;
        if !(from.is_finite() && to.is_finite()) {
            return 0..0;
        }
        from.floor().clamp(0.0, end) as usize..to.ceil().clamp(0.0, end) as usize
    }

    fn disc(&mut self, [x, y, near]: [f64; 3], radius: f64, colour: [u8; 3]) {
        let [across, _] = &self.view.ranges;
        let scale = self.size[0] as f64 / (across.end - across.start);
        let reach = (radius * scale).max(0.5);
        for row in self.span(y - reach, y + reach, 1) {
            for column in self.span(x - reach, x + reach, 0) {
                let [right, down] = [column as f64 + 0.5 - x, row as f64 + 0.5 - y];
                let squared = (right * right + down * down) / (reach * reach);
                if squared <= 1.0 {
                    let height = (1.0 - squared).sqrt();
                    self.set(column, row, near + radius * height, shaded(colour, height));
                }
            }
        }
    }

    fn triangle(&mut self, corners: [[f64; 3]; 3], colour: [u8; 3]) {
        let [a, b, c] = corners;
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
        if twice.abs() < 1e-12 {
            return;
        }
        let least = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
        let most = |axis: usize| {
            corners
                .iter()
                .map(|corner| corner[axis])
                .fold(f64::NEG_INFINITY, f64::max)
        };
        let [across, _] = &self.view.ranges;
        let scale = self.size[0] as f64 / (across.end - across.start);
        let [first, second] = [b, c].map(|corner| [corner[0] - a[0], corner[1] - a[1], (corner[2] - a[2]) * scale]);
        let normal = [0, 1, 2].map(|i: usize| {
            let [j, k] = [(i + 1) % 3, (i + 2) % 3];
            first[j] * second[k] - first[k] * second[j]
        });
        let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
        let colour = shaded(colour, (normal[2] / length).abs());
        for row in self.span(least(1), most(1), 1) {
            for column in self.span(least(0), most(0), 0) {
                let [x, y] = [column as f64 + 0.5, row as f64 + 0.5];
                let of_b = ((x - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (y - a[1])) / twice;
                let of_c = ((b[0] - a[0]) * (y - a[1]) - (x - a[0]) * (b[1] - a[1])) / twice;
                let of_a = 1.0 - of_b - of_c;
                if of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0 {
                    let near = of_a * a[2] + of_b * b[2] + of_c * c[2];
                    self.set(column, row, near, colour);
                }
            }
        }
    }
}

/// The nodes of parts are sites: a tetrahedron of a block of n is n - 2 spacings long, an octahedron, of which a pyramid is a
/// half, n - 1. Their shares of the crystal are n long, so that nothing is between them but what has opened.
fn fill_its_share(corners: &mut [[f64; 3]], size: f64) {
    let (of_middle, edge) = match corners.len() {
        4 => (4, size - 2.0),
        5 => (4, size - 1.0),
        _ => return,
    };
    let middle =
        [0, 1, 2].map(|axis| corners[..of_middle].iter().map(|corner| corner[axis]).sum::<f64>() / of_middle as f64);
    for corner in corners {
        (0..3).for_each(|axis| corner[axis] = middle[axis] + (corner[axis] - middle[axis]) * size / edge);
    }
}

/// A colour as bright as a face is that looks this much towards who looks, 0 to 1.
fn shaded(colour: [u8; 3], towards: f64) -> [u8; 3] {
    let bright = DARKEST + (1.0 - DARKEST) * towards;
    colour.map(|tone| (f64::from(tone) * bright).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: [u8; 3] = [200, 0, 0];
    const BLUE: [u8; 3] = [0, 0, 200];

    #[test]
    fn cells_side_by_side_leave_no_gap_and_those_that_are_hidden_show_what_is_behind() {
        // A square pyramid of a block of five, four spacings long, and the same below it, hidden.
        let base = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let pyramid = |low: f64| {
            base.map(|[x, y]| [x, y, low])
                .into_iter()
                .chain([[2.0, 2.0, low - 0.5]])
        };
        let mesh = FieldMesh {
            points: pyramid(0.0).chain(pyramid(1.0)).collect(),
            connectivity: (0..10).collect(),
            offsets: vec![0, 5, 10],
            element_size: vec![5, 5],
        };
        let view = View::from_above(&mesh.points, &mesh.points, 1.0);
        let mut raster = Raster::new(&view, [60, 60]);
        raster.paint(&mesh, &mesh.points, &[Some(RED), None], 0.5);
        let pixels = raster.pixels();
        let at = |place: f64| pixels[3 * (60 * 30 + ((place + 1.0) * 10.0) as usize)..][..3].to_vec();
        // Five spacings, half of one beyond the nodes on either side.
        assert_eq!([at(-0.4), at(4.4)], [RED; 2]);
        assert_eq!([at(-0.6), at(4.6)], [[255; 3]; 2]);
    }

    #[test]
    fn what_is_nearer_hides_what_is_farther() {
        // A tetrahedron with a face of two by two below an atom.
        let mesh = FieldMesh {
            points: vec![
                [0.0, 0.0, 0.0],
                [4.0, 0.0, 0.0],
                [0.0, 4.0, 0.0],
                [0.0, 0.0, -1.0],
                [1.0, 1.0, 0.9],
            ],
            connectivity: vec![0, 1, 2, 3, 4],
            offsets: vec![0, 4, 5],
            element_size: vec![600, 1],
        };
        let view = View::from_above(&mesh.points, &mesh.points, 1.0);
        assert_eq!(view.names, ["x (nm)", "y (nm)"]);
        let mut raster = Raster::new(&view, [60, 60]);
        raster.paint(&mesh, &mesh.points, &[Some(RED), Some(BLUE)], 0.5);
        let pixels = raster.pixels();
        let at = |x: f64, y: f64| {
            let [column, row] = [(x + 1.0) * 10.0, (5.0 - y) * 10.0].map(|place| place as usize);
            let from = 3 * (60 * row + column);
            [pixels[from], pixels[from + 1], pixels[from + 2]]
        };
        assert_eq!(at(2.0, 0.3), RED);
        assert!(at(1.0, 1.0)[2] > 190 && at(1.0, 1.0)[0] == 0);
        assert_eq!(at(3.5, 3.5), [255; 3]);
    }
}
