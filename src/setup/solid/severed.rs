//! Where a plane that is severed comes to lie: midway between layers of sites, along borders of elements.

use super::plan::Laid;
use crate::mesh::solid::Solid as Mesh;
use crate::mesh::solid::cut::{Cut, height};
use crate::mesh::solid::severed::severed_element;
use crate::mesh::solid::sites::Outline;
use crate::setup::{SetupError, Size};
use crate::study::Subject;
use crate::study::case::Solid;
use crate::study::case::solid::{Axis, Face, Notch, Shape, Side};

/// Layers of sites parallel to a face, counted from it.
struct Layers {
    /// What tells the layer of a site: the sum of its coordinates, each times one of these.
    factors: [i32; 3],
    /// Distance of neighbours, nm.
    height: f64,
    /// From the face to the first of them, in distances of neighbours.
    first: f64,
    /// How many there are.
    count: i32,
}

impl Laid {
    /// The cut that a solid asks for.
    pub fn cut(&self, solid: &Solid) -> Result<Option<Cut>, SetupError> {
        let Some(Notch::Plane {
            normal,
            at,
            from,
            depth,
        }) = solid.notch
        else {
            return Ok(None);
        };
        let across = self.layers(solid, low(normal));
        let along = self.layers(solid, from);
        let size = solid.resolution.element as i32;
        let is_box = matches!(self.plan.sites.outline, Outline::Box(_));
        let Some(offset) = across.border(size) else {
            return Err(refused(
                "elements have no border along this plane, which is no {111} plane of the crystal",
                "sever a plane whose normal is such as [1, 1, 1], or take `resolution: {element: 1}`",
            ));
        };
        let layer = across.nearest(at, size, offset);
        // From the face on; blocks end along borders too.
        let step = if is_box { 1 } else { size };
        let deep = along.nearest(depth, step, 0);
        if !(1..across.count).contains(&layer) {
            return Err(refused(
                "the nearest border of elements is a face of the solid: nothing would be severed",
                "put the plane farther from the face, or take smaller elements",
            ));
        }
        if !(1..along.count).contains(&deep) {
            return Err(refused(
                "as deep as the nearest border of elements it severs nothing, or all of the solid",
                "end it nearer to the middle of the solid, or take smaller elements",
            ));
        }
        let (into, end) = match from.side {
            Side::Low => (along.factors, deep),
            Side::High => (along.factors.map(|factor| -factor), deep - along.count + 1),
        };
        Ok(Some(Cut {
            normal: across.factors,
            layer,
            into,
            end,
        }))
    }

    /// Depth and place of the plane as asked for and as laid out, nm.
    pub fn severed(&self, solid: &Solid) -> Option<[Size; 2]> {
        let (
            Some(Notch::Plane {
                normal,
                at,
                from,
                depth,
            }),
            Some(cut),
        ) = (&solid.notch, self.plan.sites.cut)
        else {
            return None;
        };
        let [across, along] = [low(*normal), *from].map(|face| self.layers(solid, face));
        let deep = match from.side {
            Side::Low => cut.end,
            Side::High => cut.end + along.count - 1,
        };
        let size = |asked: f64, actual: f64| Size { asked, actual };
        Some([size(*depth, along.place(deep)), size(*at, across.place(cut.layer))])
    }

    fn layers(&self, solid: &Solid, Face { axis, side }: Face) -> Layers {
        let vectors = &self.plan.sites.frame.vectors;
        match (&self.plan.sites.outline, &solid.specimen.shape) {
            (Outline::Box(size), Shape::Box { x, z, .. }) => {
                let y = cross(*z, *x);
                let factors = layers_along([*x, y, *z][axis.index()]);
                let height = height(factors, vectors);
                let heights = size[axis.index()] / height;
                let last = (heights + ON_A_LAYER).floor();
                Layers {
                    factors,
                    height,
                    first: if side == Side::Low { 0.0 } else { heights - last },
                    count: last as i32 + 1,
                }
            }
            (outline, _) => {
                let mut factors = [0; 3];
                factors[axis.index()] = 1;
                let height = height(factors, vectors);
                let count = match outline {
                    Outline::Rhombohedron(extent) => extent[axis.index()],
                    Outline::Box(size) => (size[axis.index()] / height) as i32,
                };
                Layers {
                    factors,
                    height,
                    // A block has half a layer before its first sites.
                    first: 0.5,
                    count,
                }
            }
        }
    }
}

fn low(axis: Axis) -> Face {
    Face { axis, side: Side::Low }
}

/// A layer on the face of a box is inside, whatever rounding says; in distances of layers.
const ON_A_LAYER: f64 = 1e-6;

impl Layers {
    /// How far from the face the middle between a layer and the one before is, nm.
    fn place(&self, layer: i32) -> f64 {
        (f64::from(layer) - 0.5 + self.first) * self.height
    }

    /// The layer before which the middle is nearest to a place, among those so many apart from an offset on.
    fn nearest(&self, place: f64, step: i32, offset: i32) -> i32 {
        let layer = place / self.height + 0.5 - self.first;
        ((layer - f64::from(offset)) / f64::from(step)).round() as i32 * step + offset
    }

    /// The first layer beyond a border of elements of a size; `None` where these layers are no planes of borders.
    ///
    /// Blocks begin at multiples of their size along a1, a2 and a3, and are cut where the sum of the coordinates reaches one
    /// less than a multiple.
    fn border(&self, size: i32) -> Option<i32> {
        let [i, j, k] = self.factors;
        match (i + j + k, i.abs() + j.abs() + k.abs()) {
            _ if size == 1 => Some(0),
            (1, 1) => Some(0),
            (-1, 1) => Some(1),
            (3, 3) => Some(-1),
            (-3, 3) => Some(2),
            _ => None,
        }
    }
}

/// The factors of the layers along a direction of the cube: a1, a2 and a3 lead along [011], [101] and [110].
fn layers_along([h, k, l]: [i32; 3]) -> [i32; 3] {
    let factors = [k + l, h + l, h + k];
    let divisor = factors.into_iter().fold(0, common_divisor);
    factors.map(|factor| factor / divisor.max(1))
}

fn common_divisor(a: i32, b: i32) -> i32 {
    let (mut a, mut b) = (a.abs(), b.abs());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

fn cross(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    [0, 1, 2].map(|i: usize| {
        let [j, k] = [(i + 1) % 3, (i + 2) % 3];
        a[j] * b[k] - a[k] * b[j]
    })
}

/// Bonds inside an element are summed together: none of them can be severed.
pub fn refuse_severed_elements(mesh: &Mesh) -> Result<(), SetupError> {
    match severed_element(mesh) {
        Some(_) => Err(refused(
            "the plane goes through elements: those that fill what the large ones leave at the faces have other borders",
            "take an even number of cells an edge of `resolution.element`, or `resolution: {element: 1}`",
        )),
        None => Ok(()),
    }
}

fn refused(message: &'static str, help: &'static str) -> SetupError {
    SetupError::NotThere {
        subject: Subject::Notch,
        message,
        help,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::solid::cut::layer;
    use crate::mesh::solid::sites::{Frame, Sites};
    use crate::mesh::solid::{Plan, Solid};

    #[test]
    fn layers_along_an_axis_of_a_box_are_those_of_equal_height() {
        const ROUNDING: f64 = 1e-12;
        let axes = [[1, 1, -2], [3, -3, 0], [1, 1, 1]];
        let frame = Frame::along(axes, 0.3);
        for (number, axis) in axes.into_iter().enumerate() {
            let factors = layers_along(axis);
            let height = height(factors, &frame.vectors);
            for site in [[3, -1, 2], [0, 4, 1], [7, 7, -2], [1, 0, 0]] {
                let expected = f64::from(layer(factors, site)) * height;
                assert!(
                    (frame.place(site)[number] - expected).abs() < ROUNDING,
                    "{axis:?} {site:?}"
                );
            }
        }
        assert_eq!(
            [[1, 1, 1], [-1, 1, 1], [1, 0, 0]].map(layers_along),
            [[1, 1, 1], [1, 0, 0], [0, 1, 1]]
        );
    }

    #[test]
    fn no_element_is_severed_along_the_borders_of_blocks() {
        const BOX: [f64; 3] = [26.0, 25.0, 27.0];
        let frame = Frame::along([[1, 1, -2], [-1, 1, 0], [1, 1, 1]], 1.0);
        for (normal, signs) in [([1, 1, 1], [1, -1]), ([1, 0, 0], [1, -1]), ([0, 0, 1], [1, -1])] {
            for sign in signs {
                let factors = normal.map(|factor| sign * factor);
                let layers = Layers {
                    factors,
                    height: 1.0,
                    first: 0.0,
                    count: 0,
                };
                let mesh = |layer: i32| {
                    Solid::new(&Plan {
                        sites: Sites {
                            outline: Outline::Box(BOX),
                            frame,
                            removed: vec![],
                            cut: Some(Cut {
                                normal: factors,
                                layer,
                                into: [1, -1, 0],
                                end: 1000,
                            }),
                        },
                        element: 6,
                        regions: vec![],
                        spacing: 1.0,
                    })
                };
                let offset = layers.border(6).expect("it is a {111} plane");
                let middle = frame.lattice(BOX.map(|edge| 0.5 * edge)).map(|number| number as i32);
                let blocks = layer(factors, middle) / 6;
                let severed: Vec<bool> = (0..6)
                    .map(|beyond| severed_element(&mesh(6 * blocks + offset + beyond)).is_some())
                    .collect();
                assert_eq!(severed, [false, true, true, true, true, true], "{factors:?}");
            }
        }
    }
}
