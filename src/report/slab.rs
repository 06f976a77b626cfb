//! A deformed slab as pixels: elements as triangles, atoms as discs, coloured by stress.

use crate::record::frames::{FieldMesh, Frame};

/// Samples a pixel in each direction, so that a million cells blend instead of flickering.
const SAMPLES: usize = 2;

/// Radius of an atom in spacings: three discs just cover the plaquette between them.
const ATOM: f64 = 0.58;

/// A rectangle of the plane, nm.
#[derive(Clone, Copy, Debug)]
pub struct View {
    pub x: [f64; 2],
    pub y: [f64; 2],
}

/// Deformed node positions, x from the left edge and y from mid-height of the undeformed specimen.
pub fn positions(mesh: &FieldMesh, frame: &Frame) -> Vec<[f64; 2]> {
    let low = |axis: usize| {
        mesh.points
            .iter()
            .map(|point| point[axis])
            .fold(f64::INFINITY, f64::min)
    };
    let high = |axis: usize| {
        mesh.points
            .iter()
            .map(|point| point[axis])
            .fold(f64::NEG_INFINITY, f64::max)
    };
    let origin = [low(0), 0.5 * (low(1) + high(1))];
    let moved = mesh.points.iter().zip(&frame.displacement);
    moved
        .map(|(at, by)| [at[0] + by[0] - origin[0], at[1] + by[1] - origin[1]])
        .collect()
}

/// The smallest view that holds all positions, with a margin.
pub fn view(positions: &[[f64; 2]], margin: f64) -> Option<View> {
    let span = |axis: usize| {
        let values = || {
            positions
                .iter()
                .map(|point| point[axis])
                .filter(|value| value.is_finite())
        };
        [
            values().fold(f64::INFINITY, f64::min) - margin,
            values().fold(f64::NEG_INFINITY, f64::max) + margin,
        ]
    };
    let view = View { x: span(0), y: span(1) };
    (view.x[0] < view.x[1] && view.y[0] < view.y[1]).then_some(view)
}

/// Paints the slab as RGB rows from the top, each cell in its colour, over what empty space has.
pub fn paint(
    mesh: &FieldMesh,
    frame: &Frame,
    spacing: f64,
    view: View,
    colours: &[[u8; 3]],
    empty: [u8; 3],
    [width, height]: [usize; 2],
) -> Vec<u8> {
    let mut canvas = Canvas::new(width * SAMPLES, height * SAMPLES, empty);
    let scale = [
        canvas.width as f64 / (view.x[1] - view.x[0]),
        canvas.height as f64 / (view.y[1] - view.y[0]),
    ];
    let nodes: Vec<[f64; 2]> = positions(mesh, frame)
        .into_iter()
        .map(|at| [(at[0] - view.x[0]) * scale[0], (view.y[1] - at[1]) * scale[1]])
        .collect();
    let radius = (ATOM * spacing * scale[0]).max(0.75);
    for (cell, ends) in mesh.offsets.windows(2).enumerate() {
        let (Some(&colour), Some(corners)) = (
            colours.get(cell),
            mesh.connectivity.get(ends[0] as usize..ends[1] as usize),
        ) else {
            continue;
        };
        match *corners {
            [atom] => canvas.disc(nodes[atom as usize], radius, colour),
            [a, b, c] => {
                let corners = [a, b, c].map(|node| nodes[node as usize]);
                canvas.triangle(out_to_the_neighbours(corners, mesh.element_size[cell]), colour);
            }
            _ => {}
        }
    }
    canvas.shrunk()
}

/// The nodes are sites; moves the sides out by half a row, to where those of an intact neighbour begin.
fn out_to_the_neighbours(corners: [[f64; 2]; 3], size: u32) -> [[f64; 2]; 3] {
    let edge = f64::from(size.max(2) - 1);
    let stretch = (edge + 1.5) / edge;
    let middle = [0, 1].map(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>() / 3.0);
    corners.map(|corner| [0, 1].map(|axis| middle[axis] + stretch * (corner[axis] - middle[axis])))
}

struct Canvas {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 3]>,
}

impl Canvas {
    fn new(width: usize, height: usize, empty: [u8; 3]) -> Canvas {
        Canvas {
            width,
            height,
            pixels: vec![empty; width * height],
        }
    }

    /// Colours the samples of one row whose centres lie between two x.
    fn run(&mut self, row: usize, from: f64, to: f64, colour: [u8; 3]) {
        let bound = |x: f64| (x - 0.5).ceil().clamp(0.0, self.width as f64) as usize;
        let (start, end) = (bound(from), bound(to));
        if start < end {
            self.pixels[row * self.width..][start..end].fill(colour);
        }
    }

    /// The rows whose centres lie between two y.
    fn rows(&self, from: f64, to: f64) -> std::ops::Range<usize> {
        let bound = |y: f64| (y - 0.5).ceil().clamp(0.0, self.height as f64) as usize;
        bound(from)..bound(to)
    }

    fn disc(&mut self, at: [f64; 2], radius: f64, colour: [u8; 3]) {
        for row in self.rows(at[1] - radius, at[1] + radius) {
            let off = row as f64 + 0.5 - at[1];
            let half = (radius * radius - off * off).max(0.0).sqrt();
            self.run(row, at[0] - half, at[0] + half, colour);
        }
    }

    fn triangle(&mut self, corners: [[f64; 2]; 3], colour: [u8; 3]) {
        let low = corners.iter().map(|corner| corner[1]).fold(f64::INFINITY, f64::min);
        let high = corners.iter().map(|corner| corner[1]).fold(f64::NEG_INFINITY, f64::max);
        for row in self.rows(low, high) {
            let y = row as f64 + 0.5;
            let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
            for side in 0..3 {
                let [a, b] = [corners[side], corners[(side + 1) % 3]];
                if (a[1] <= y) != (b[1] <= y) {
                    let x = a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]);
                    (left, right) = (left.min(x), right.max(x));
                }
            }
            self.run(row, left, right, colour);
        }
    }

    /// The mean over the samples of each pixel.
    fn shrunk(&self) -> Vec<u8> {
        let (width, height) = (self.width / SAMPLES, self.height / SAMPLES);
        let tone = |row: usize, column: usize, tone: usize| {
            let samples = (0..SAMPLES).flat_map(|down| (0..SAMPLES).map(move |right| (down, right)));
            let at = |(down, right): (usize, usize)| {
                self.pixels[(row * SAMPLES + down) * self.width + column * SAMPLES + right][tone]
            };
            (samples.map(|place| u32::from(at(place))).sum::<u32>() / (SAMPLES * SAMPLES) as u32) as u8
        };
        let places = (0..height).flat_map(|row| (0..width).map(move |column| (row, column)));
        places
            .flat_map(|(row, column)| [0, 1, 2].map(|part| tone(row, column, part)))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intact_elements_leave_no_gap() {
        // An upright and an inverted element of three atoms per edge, spacing 1, seen where they meet.
        let site = |i: f64, j: f64| [i + 0.5 * j, j * 0.75_f64.sqrt()];
        let corners = [
            [site(0.0, 0.0), site(2.0, 0.0), site(0.0, 2.0)],
            [site(3.0, 0.0), site(3.0, 2.0), site(1.0, 2.0)],
        ];
        let points: Vec<[f64; 2]> = corners.into_iter().flatten().collect();
        let mesh = FieldMesh {
            connectivity: (0..6).collect(),
            offsets: vec![0, 3, 6],
            element_size: vec![3, 3],
            points,
        };
        let frame = Frame {
            displacement: vec![[0.0; 2]; 6],
            ..Frame::default()
        };
        let view = View {
            x: [1.6, 2.4],
            y: [-0.5, 0.5],
        };
        let colour = [10, 20, 30];
        let pixels = paint(&mesh, &frame, 1.0, view, &[colour; 2], [255; 3], [40, 20]);
        assert!(
            pixels.chunks(3).all(|pixel| pixel == colour),
            "a pixel between the elements is not painted"
        );
    }
}
