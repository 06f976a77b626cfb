//! Lattice, shape and size of a solid.

use super::case::{Axis, Lattice, Shape, Specimen};
use crate::study::{
    defaults, file,
    finding::{Finding, Place},
    reader::Given,
    resolve::{At, Check, about},
};

/// A specimen, and what may be known of it although the whole is not.
pub struct Laid {
    pub specimen: Option<Specimen>,
    /// Whether it is a box; `None` where that is not told.
    pub is_box: Option<bool>,
    pub block: Option<u32>,
    /// The number of blocks, and where it was given.
    pub blocks: Option<At<[u32; 3]>>,
    /// Edges of the specimen as vectors, nm.
    pub edges: Option<[[f64; 3]; 3]>,
}

/// Primitive vectors in units of the spacing, a1 along x, a2 in the xy plane.
const PRIMITIVE: [[f64; 3]; 3] = [
    [1.0, 0.0, 0.0],
    [0.5, 0.866_025_403_784_438_6, 0.0],
    [0.5, 0.288_675_134_594_812_9, 0.816_496_580_927_726],
];

/// Cells along an axis beyond these have no numbers, and directions of such indices no meaning.
const MOST_CELLS: u64 = 100_000_000;
const MOST_INDEX: i32 = 50;

/// Smallest block of cells with a tetrahedron and an octahedron of more than their nodes.
pub const SMALLEST_BLOCK: u32 = 3;

impl Laid {
    fn unknown() -> Self {
        Self {
            specimen: None,
            is_box: None,
            block: None,
            blocks: None,
            edges: None,
        }
    }

    /// What its axes are called.
    pub fn names(&self) -> [&'static str; 3] {
        match self.is_box {
            Some(true) => ["x", "y", "z"],
            _ => ["a1", "a2", "a3"],
        }
    }

    /// Distance between the two faces of an axis, nm.
    pub fn thickness(&self, axis: Axis) -> Option<f64> {
        let edges = self.edges?;
        let [first, second] = [1, 2].map(|next| edges[(axis.index() + next) % 3]);
        let normal = [0, 1, 2].map(|i: usize| {
            let [j, k] = [(i + 1) % 3, (i + 2) % 3];
            first[j] * second[k] - first[k] * second[j]
        });
        let length = normal.iter().map(|part| part * part).sum::<f64>().sqrt();
        let along = edges[axis.index()].iter().zip(normal).map(|(edge, part)| edge * part);
        Some(along.sum::<f64>().abs() / length)
    }

    /// The box along x, y and z that holds it all: its lower and its upper corner, nm.
    pub fn bounds(&self) -> Option<[[f64; 3]; 2]> {
        let edges = self.edges?;
        let sum =
            |pick: fn(f64, f64) -> f64| [0, 1, 2].map(|i: usize| edges.iter().map(|edge| pick(edge[i], 0.0)).sum());
        Some([sum(f64::min), sum(f64::max)])
    }
}

impl Check<'_> {
    /// `spacing` is the distance at which two atoms rest, nm; `element` the size of the elements outside the regions.
    pub fn solid_specimen(
        &self,
        given: &Given<file::Specimen>,
        case: Place,
        spacing: Option<f64>,
        element: Option<u32>,
    ) -> Laid {
        let Some((values, place)) = self.section(given, case) else {
            return Laid::unknown();
        };
        let block = self.cells_of_a_block(&values.block, element);
        let is_box = match (values.blocks.place(), values.size.place()) {
            (Some(_), None) => Some(false),
            (None, Some(_)) => Some(true),
            (Some(blocks), Some(size)) => {
                let finding =
                    Finding::at(size, "a solid is made of blocks or is a box, not both").with(blocks, "blocks");
                self.add(finding.help("keep `blocks` or `size`"));
                None
            }
            (None, None) => {
                let help = "write `blocks: [4, 4, 40]`, or `size: [10 nm, 20 nm, 2 nm]` and an `orientation`";
                self.add(Finding::at(place, "the size of the solid is missing").help(help));
                None
            }
        };
        let mut laid = Laid {
            is_box,
            block,
            ..Laid::unknown()
        };
        match is_box {
            Some(false) => self.of_blocks(&values, place, spacing, &mut laid),
            Some(true) => self.boxed(&values, place, &mut laid),
            None => (),
        }
        laid
    }

    fn of_blocks(&self, values: &file::Specimen, place: Place, spacing: Option<f64>, laid: &mut Laid) {
        if let Some(place) = values.orientation.place() {
            let message = "blocks lie along their own vectors, and have no other orientation";
            let help = "leave `orientation` out, or write a box: `size: [10 nm, 20 nm, 2 nm]`";
            self.add(Finding::at(place, message).help(help));
        }
        let Some((given, at)) = self.need(&values.blocks, place, "specimen.blocks", "[4, 4, 40]") else {
            return;
        };
        let numbers = given.map(|number| number.right().copied());
        let [Some(a), Some(b), Some(c)] = numbers else { return };
        let blocks = [a, b, c];
        let cells = |number: u32| u64::from(number) * u64::from(laid.block.unwrap_or(1));
        if blocks.contains(&0) {
            let message = "a solid has at least one block along each axis";
            self.add(Finding::at(at, message).help("write for example `blocks: [4, 4, 40]`"));
            return;
        }
        if blocks.iter().any(|&number| cells(number) > MOST_CELLS) {
            let message = format!("at most {MOST_CELLS} cells along an axis can be numbered");
            self.add(Finding::at(at, message).help("take fewer blocks"));
            return;
        }
        laid.blocks = Some((blocks, at));
        if let (Some(block), Some(spacing)) = (laid.block, spacing) {
            let edge =
                |axis: usize| PRIMITIVE[axis].map(|part| part * spacing * f64::from(block) * f64::from(blocks[axis]));
            laid.edges = Some([0, 1, 2].map(edge));
        }
        laid.specimen = laid.block.map(|block| Specimen {
            lattice: Lattice::Fcc,
            shape: Shape::Blocks(blocks),
            block,
        });
    }

    fn boxed(&self, values: &file::Specimen, place: Place, laid: &mut Laid) {
        let orientation = self.orientation(&values.orientation);
        let Some((given, _)) = self.need(&values.size, place, "specimen.size", "[10 nm, 20 nm, 2 nm]") else {
            return;
        };
        let mut size = [0.0; 3];
        for (size, given) in size.iter_mut().zip(&given) {
            let Given::Right(length, place) = given else { return };
            let Some((length, _)) = self.positive(*length, *place, "specimen.size") else {
                return;
            };
            *size = length;
        }
        laid.edges = Some([[size[0], 0.0, 0.0], [0.0, size[1], 0.0], [0.0, 0.0, size[2]]]);
        laid.specimen = laid.block.zip(orientation).map(|(block, [x, z])| Specimen {
            lattice: Lattice::Fcc,
            shape: Shape::Box { size, x, z },
            block,
        });
    }

    /// Directions along x and z; those of the cube's edges where nothing is said.
    fn orientation(&self, given: &Given<file::Orientation>) -> Option<[[i32; 3]; 2]> {
        let (values, place) = match given {
            Given::Absent => return Some([[1, 0, 0], [0, 0, 1]]),
            Given::Wrong(_) => return None,
            Given::Right(values, place) => (values, *place),
        };
        let x = self.direction(&values.x, place, "orientation.x", "[1, 1, -2]");
        let z = self.direction(&values.z, place, "orientation.z", "[1, 1, 1]");
        let ((x, at_x), (z, at_z)) = (x?, z?);
        let product: i32 = x.iter().zip(z).map(|(a, b)| a * b).sum();
        if product == 0 {
            return Some([x, z]);
        }
        let cosine = f64::from(product) / (norm(x) * norm(z));
        let message = format!(
            "{x:?} and {z:?} are at {:.1}° to each other, and a box has right angles",
            cosine.acos().to_degrees()
        );
        let help = "write directions at right angles, such as `{x: [1, 1, -2], z: [1, 1, 1]}`";
        self.add(Finding::at(at_z, message).with(at_x, "along x").help(help));
        None
    }

    fn direction(
        &self,
        given: &Given<[Given<i32>; 3]>,
        section: Place,
        path: &str,
        example: &str,
    ) -> Option<At<[i32; 3]>> {
        let (indices, place) = self.need(given, section, path, example)?;
        let [h, k, l] = indices.map(|index| index.right().copied());
        let indices = [h?, k?, l?];
        if indices == [0; 3] || indices.iter().any(|index| !(-MOST_INDEX..=MOST_INDEX).contains(index)) {
            let message = format!("{indices:?} is no direction of a crystal");
            self.add(
                Finding::at(place, message).help(format!("write small whole numbers, not all zero, such as {example}")),
            );
            return None;
        }
        Some((indices, place))
    }

    /// As large as the elements where nothing is said, so that they leave nothing over.
    fn cells_of_a_block(&self, given: &Given<u32>, element: Option<u32>) -> Option<u32> {
        if let Given::Right(block, place) = given
            && *block < SMALLEST_BLOCK
        {
            let message =
                format!("`specimen.block` must be at least {SMALLEST_BLOCK} cells per edge, and {block} is not");
            self.add(Finding::at(*place, message).help("leave it out for that of the elements"));
            return None;
        }
        let fitting = element.filter(|&element| element >= SMALLEST_BLOCK);
        self.choice(given, fitting.unwrap_or(defaults::BLOCK))
    }
}

fn norm(vector: [i32; 3]) -> f64 {
    f64::from(vector.iter().map(|part| part * part).sum::<i32>()).sqrt()
}

/// `[0 nm, 0 nm, 0 nm]`, for a message.
pub fn told(point: [f64; 3]) -> String {
    let [x, y, z] = point.map(about);
    format!("[{x}, {y}, {z}]")
}
