//! Which lattice sites a solid has, where they stand, and where they are severed from each other.

use super::cut::Cut;
use crate::lattice::fcc;

/// Axes of the laboratory in the cube of the crystal, and the spacing: how lattice vectors become places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The primitive vectors a1, a2, a3 in the laboratory, nm.
    pub vectors: [[f64; 3]; 3],
}

impl Frame {
    /// The laboratory along three orthogonal directions of the cube, given by their Miller indices.
    pub fn along(axes: [[i32; 3]; 3], spacing: f64) -> Self {
        let units = axes.map(|axis| {
            let length = axis.iter().map(|&index| f64::from(index * index)).sum::<f64>().sqrt();
            axis.map(|index| f64::from(index) / length)
        });
        Self::of(units, spacing)
    }

    /// x along a1, a2 in the plane of x and y: z is the normal of a {111} plane. The frame of rhombohedral specimens.
    pub fn of_blocks(spacing: f64) -> Self {
        let [half, height] = [0.5, 0.75f64.sqrt()];
        let lifted = [half, 0.5 * half / height, (2f64 / 3.0).sqrt()];
        let vectors = [[1.0, 0.0, 0.0], [half, height, 0.0], lifted];
        Self {
            vectors: vectors.map(|vector| vector.map(|component| component * spacing)),
        }
    }

    fn of(axes: [[f64; 3]; 3], spacing: f64) -> Self {
        let vector = |lattice: [i32; 3]| {
            let in_cube = fcc::in_the_cube(lattice);
            axes.map(|axis| {
                spacing
                    * axis
                        .iter()
                        .zip(in_cube)
                        .map(|(axis, component)| axis * component)
                        .sum::<f64>()
            })
        };
        Self {
            vectors: [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(vector),
        }
    }

    /// The place of a site, nm.
    #[inline(always)]
    pub fn place(&self, site: [i32; 3]) -> [f64; 3] {
        self.place_between(site.map(f64::from))
    }

    /// The place at lattice coordinates that need not be whole, nm.
    #[inline(always)]
    pub fn place_between(&self, [i, j, k]: [f64; 3]) -> [f64; 3] {
        let [a, b, c] = self.vectors;
        std::array::from_fn(|axis| i * a[axis] + j * b[axis] + k * c[axis])
    }

    /// Lattice coordinates of a place, not whole.
    pub fn lattice(&self, place: [f64; 3]) -> [f64; 3] {
        let vectors = self.vectors.map(nalgebra::Vector3::from);
        let matrix = nalgebra::Matrix3::from_columns(&vectors);
        let inverse = matrix.try_inverse().expect("primitive vectors span space");
        (inverse * nalgebra::Vector3::from(place)).into()
    }
}

/// A box of lattice sites: from the first up to but not with the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Range3 {
    pub from: [i32; 3],
    pub to: [i32; 3],
}

impl Range3 {
    pub fn contains(&self, site: [i32; 3]) -> bool {
        (0..3).all(|axis| (self.from[axis]..self.to[axis]).contains(&site[axis]))
    }

    /// How much of a cube of sites it holds.
    fn share(&self, anchor: [i32; 3], size: i32) -> Share {
        let whole = (0..3).all(|axis| self.from[axis] <= anchor[axis] && anchor[axis] + size <= self.to[axis]);
        let none = (0..3).any(|axis| anchor[axis] + size <= self.from[axis] || self.to[axis] <= anchor[axis]);
        match (whole, none) {
            (true, _) => Share::All,
            (_, true) => Share::Nothing,
            _ => Share::Some,
        }
    }
}

/// How many of some sites there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Share {
    All,
    Some,
    Nothing,
}

/// The outline of a specimen.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A rhombohedron along the primitive vectors: sites 0 to below these numbers.
    Rhombohedron([i32; 3]),
    /// A box along the laboratory, from its origin, nm.
    Box([f64; 3]),
}

/// The sites of a solid: an outline in a frame less what is taken out.
#[derive(Clone, Debug, PartialEq)]
pub struct Sites {
    pub outline: Outline,
    pub frame: Frame,
    /// Slots without sites.
    pub removed: Vec<Range3>,
    /// A plane across which no bond holds.
    pub cut: Option<Cut>,
}

/// A site on the face of a box is inside, whatever rounding says: nm.
const ON_A_FACE: f64 = 1e-6;

impl Sites {
    pub fn contains(&self, site: [i32; 3]) -> bool {
        self.is_within(site) && !self.removed.iter().any(|slot| slot.contains(site))
    }

    /// Whether a pair of sites never bonds, because the line between them crosses a cut.
    #[inline(always)]
    pub fn severs(&self, a: [i32; 3], b: [i32; 3]) -> bool {
        self.cut.is_some_and(|cut| cut.severs(a, b))
    }

    fn is_within(&self, site: [i32; 3]) -> bool {
        match &self.outline {
            Outline::Rhombohedron(extent) => (0..3).all(|axis| (0..extent[axis]).contains(&site[axis])),
            Outline::Box(size) => {
                let place = self.frame.place(site);
                (0..3).all(|axis| place[axis] >= -ON_A_FACE && place[axis] <= size[axis] + ON_A_FACE)
            }
        }
    }

    /// How many sites of a block there are.
    pub fn share_of(&self, anchor: [i32; 3], size: i32) -> Share {
        let within = match &self.outline {
            Outline::Rhombohedron(extent) => Range3 {
                from: [0; 3],
                to: *extent,
            }
            .share(anchor, size),
            Outline::Box(_) => self.share_within(anchor, size),
        };
        let slots = self.removed.iter().map(|slot| slot.share(anchor, size));
        slots.fold(within, |share, slot| match (share, slot) {
            (Share::Nothing, _) | (_, Share::All) => Share::Nothing,
            (share, Share::Nothing) => share,
            (_, Share::Some) => Share::Some,
        })
    }

    /// A block is convex, and so is the box.
    fn share_within(&self, anchor: [i32; 3], size: i32) -> Share {
        let last = size - 1;
        let corner = |number: i32| std::array::from_fn(|axis| anchor[axis] + last * (number >> axis & 1));
        let inside = (0..8).filter(|&number| self.is_within(corner(number))).count();
        let places: Vec<[f64; 3]> = (0..8).map(|number| self.frame.place(corner(number))).collect();
        let Outline::Box(extent) = &self.outline else {
            return Share::Some;
        };
        let beyond = |axis: usize| {
            places.iter().all(|place| place[axis] < -ON_A_FACE)
                || places.iter().all(|place| place[axis] > extent[axis] + ON_A_FACE)
        };
        match inside {
            8 => Share::All,
            _ if (0..3).any(beyond) => Share::Nothing,
            _ => Share::Some,
        }
    }

    /// Lattice coordinates that hold all sites.
    pub fn bounds(&self) -> Range3 {
        match &self.outline {
            Outline::Rhombohedron(extent) => Range3 {
                from: [0; 3],
                to: *extent,
            },
            Outline::Box(size) => {
                let corner =
                    |number: usize| std::array::from_fn(|axis| size[axis] * f64::from(number as u32 >> axis & 1));
                let corners: Vec<[f64; 3]> = (0..8).map(|number| self.frame.lattice(corner(number))).collect();
                let least = |axis: usize| corners.iter().map(|corner| corner[axis]).fold(f64::INFINITY, f64::min);
                let most = |axis: usize| {
                    corners
                        .iter()
                        .map(|corner| corner[axis])
                        .fold(f64::NEG_INFINITY, f64::max)
                };
                Range3 {
                    from: std::array::from_fn(|axis| least(axis).floor() as i32),
                    to: std::array::from_fn(|axis| most(axis).ceil() as i32 + 1),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn primitive_vectors_have_the_spacing_as_length_and_sixty_degrees_between_them() {
        let frames = [
            Frame::of_blocks(0.25),
            Frame::along([[1, 0, 0], [0, 1, 0], [0, 0, 1]], 0.25),
            Frame::along([[1, 1, -2], [-1, 1, 0], [1, 1, 1]], 0.25),
        ];
        for frame in frames {
            for (first, a) in frame.vectors.iter().enumerate() {
                for (second, b) in frame.vectors.iter().enumerate() {
                    let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                    let expected = if first == second { 0.0625 } else { 0.03125 };
                    assert!((dot - expected).abs() < 1e-15);
                }
            }
            let [i, j, k] = frame.lattice(frame.place([3, -7, 11]));
            assert!((i - 3.0).abs() < 1e-12 && (j + 7.0).abs() < 1e-12 && (k - 11.0).abs() < 1e-12);
        }
    }

    #[test]
    fn shares_of_blocks_are_what_their_sites_say() {
        let cube = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
        let slot = Range3 {
            from: [4, 4, 0],
            to: [9, 20, 30],
        };
        let outlines = [
            (Outline::Rhombohedron([25, 13, 17]), Frame::of_blocks(1.0)),
            (Outline::Box([12.0, 9.0, 10.0]), Frame::along(cube, 1.0)),
        ];
        for (outline, frame) in outlines {
            let sites = Sites {
                outline,
                frame,
                removed: vec![slot],
                cut: None,
            };
            let bounds = sites.bounds();
            for k in (bounds.from[2] - 3..bounds.to[2]).step_by(5) {
                for j in (bounds.from[1] - 3..bounds.to[1]).step_by(5) {
                    for i in (bounds.from[0] - 3..bounds.to[0]).step_by(5) {
                        let mut present = 0;
                        for (p, q, r) in (0..125).map(|number| (number % 5, number / 5 % 5, number / 25)) {
                            present += i32::from(sites.contains([i + p, j + q, k + r]));
                        }
                        match sites.share_of([i, j, k], 5) {
                            Share::All => assert_eq!(present, 125),
                            Share::Nothing => assert_eq!(present, 0),
                            Share::Some => (),
                        }
                    }
                }
            }
        }
    }
}
