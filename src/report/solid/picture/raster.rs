//! Faces of cells and atoms as pixels: what is nearer hides what is farther, faces that look away are darker.

use std::ops::Range;

use crate::record::frames::FieldMesh;

/// How a solid is seen.
pub struct View {
    /// Axes to the right, upwards, and towards who looks.
    axes: [usize; 3],
    /// To the right and upwards, nm.
    pub ranges: [Range<f64>; 2],
}

impl View {
    /// Along the shortest side of the reference places, so that all places are seen with a margin around them.
    pub fn of(reference: &[[f64; 3]], places: &[[f64; 3]], margin: f64) -> Self {
        let range = |points: &[[f64; 3]], axis: usize| {
            let along = || points.iter().map(|point| point[axis]).filter(|place| place.is_finite());
            along().fold(f64::INFINITY, f64::min)..along().fold(f64::NEG_INFINITY, f64::max)
        };
        let length = |axis: &usize| {
            let range = range(reference, *axis);
            range.end - range.start
        };
        let shortest = (0..3).min_by(|a, b| length(a).total_cmp(&length(b))).unwrap_or(2);
        // Right-handed: z towards who looks shows x and y.
        let mut axes = [(shortest + 1) % 3, (shortest + 2) % 3, shortest];
        if length(&axes[1]) > length(&axes[0]) && shortest != 2 {
            axes.swap(0, 1);
        }
        let ranges = [axes[0], axes[1]].map(|axis| {
            let range = range(places, axis);
            range.start - margin..range.end + margin
        });
        Self { axes, ranges }
    }

    pub fn names(&self) -> [&'static str; 2] {
        [self.axes[0], self.axes[1]].map(|axis| ["x (nm)", "y (nm)", "z (nm)"][axis])
    }
}

/// Faces of cells by the places of their corners.
const TETRAHEDRON: [&[usize]; 4] = [&[0, 1, 2], &[0, 1, 3], &[0, 2, 3], &[1, 2, 3]];
const PYRAMID: [&[usize]; 6] = [&[0, 1, 2], &[0, 2, 3], &[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]];

/// How bright a face is that is seen from its edge.
const DARKEST: f64 = 0.55;

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

    /// All cells of a mesh, with its nodes at these places and each cell in its colour; atoms are discs of a radius, nm.
    pub fn paint(&mut self, mesh: &FieldMesh<[f64; 3]>, places: &[[f64; 3]], colours: &[[u8; 3]], radius: f64) {
        for (ends, &colour) in mesh.offsets.windows(2).zip(colours) {
            let nodes = &mesh.connectivity[ends[0] as usize..ends[1] as usize];
            let corners: Vec<[f64; 3]> = nodes.iter().map(|&node| self.seen(places[node as usize])).collect();
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
        let [right, up, near] = self.view.axes;
        let [across, above] = &self.view.ranges;
        let x = (place[right] - across.start) / (across.end - across.start) * self.size[0] as f64;
        let y = (above.end - place[up]) / (above.end - above.start) * self.size[1] as f64;
        [x, y, place[near]]
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
            element_size: vec![6, 1],
        };
        let view = View::of(&mesh.points, &mesh.points, 1.0);
        assert_eq!(view.names(), ["x (nm)", "y (nm)"]);
        let mut raster = Raster::new(&view, [60, 60]);
        raster.paint(&mesh, &mesh.points, &[RED, BLUE], 0.5);
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
