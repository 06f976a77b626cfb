//! Sites, elements, regions and faces of a solid, from what a case asks for.

use crate::mesh::solid::Plan;
use crate::mesh::solid::region::{Region, Shape as RegionShape};
use crate::mesh::solid::sites::{Frame, Outline, Range3, Sites};
use crate::setup::SetupError;
use crate::study::case::Solid;
use crate::study::case::solid::{self as case, Axis, Depth, Face, Loading, Notch, Pull, Shape, Side};

/// Sites along an edge that 32-bit numbers leave room for.
const MOST_SITES_ALONG: f64 = 5e8;

/// A solid as it is laid out.
#[derive(Clone, Debug, PartialEq)]
pub struct Laid {
    pub plan: Plan,
    /// The edges of the body as vectors, nm: as many cells as it has, or the box.
    pub edges: [[f64; 3]; 3],
}

/// The plan of a mesh with this distance of nearest neighbours, nm.
pub fn lay_out(solid: &Solid, spacing: f64) -> Result<Laid, SetupError> {
    let block = f64::from(solid.specimen.block);
    let (frame, outline, edges) = match solid.specimen.shape {
        Shape::Blocks(blocks) => {
            let cells = blocks.map(|number| block * f64::from(number));
            refuse_too_long(cells.map(|cells| cells * spacing), spacing)?;
            let frame = Frame::of_blocks(spacing);
            let edge = |axis: usize| frame.vectors[axis].map(|part| part * cells[axis]);
            let edges = [0, 1, 2].map(edge);
            (frame, Outline::Rhombohedron(cells.map(|cells| cells as i32)), edges)
        }
        Shape::Box { size, x, z } => {
            refuse_too_long(size, spacing)?;
            let [width, height, depth] = size;
            let edges = [[width, 0.0, 0.0], [0.0, height, 0.0], [0.0, 0.0, depth]];
            (Frame::along([x, cross(z, x), z], spacing), Outline::Box(size), edges)
        }
    };
    let removed = match &solid.notch {
        Some(Notch::Slot { from, to }) => {
            let site = |blocks: &[u32; 3]| blocks.map(|number| (number * solid.specimen.block) as i32);
            vec![Range3 {
                from: site(from),
                to: site(to),
            }]
        }
        _ => Vec::new(),
    };
    let element = |element: u32| u16::try_from(element).map_err(|_| SetupError::BlockTooLarge { element });
    let laid = |regions| Laid {
        plan: Plan {
            sites: Sites {
                outline,
                frame,
                removed,
                cut: None,
            },
            element: 0,
            regions,
            spacing,
        },
        edges,
    };
    let mut laid = laid(Vec::new());
    laid.plan.element = element(solid.resolution.element)?;
    let region = |region: &case::Region| {
        Ok(Region {
            shape: laid.region(&region.shape),
            element: element(region.element)?,
        })
    };
    let regions = solid.resolution.regions.iter().map(region);
    let regions = regions.collect::<Result<_, SetupError>>()?;
    laid.plan.regions = regions;
    laid.plan.sites.cut = laid.cut(solid)?;
    Ok(laid)
}

fn refuse_too_long(sides: [f64; 3], spacing: f64) -> Result<(), SetupError> {
    let side = sides.into_iter().fold(0.0, f64::max);
    let atoms = side / spacing;
    match atoms > MOST_SITES_ALONG {
        true => Err(SetupError::TooLong {
            side,
            is_width: false,
            atoms,
            most: MOST_SITES_ALONG,
        }),
        false => Ok(()),
    }
}

impl Laid {
    /// Normal of the faces of an axis, of length 1, towards the high one.
    pub fn normal(&self, axis: Axis) -> [f64; 3] {
        let [first, second] = [1, 2].map(|next| self.edges[(axis.index() + next) % 3]);
        let normal = [0, 1, 2].map(|i: usize| {
            let [j, k] = [(i + 1) % 3, (i + 2) % 3];
            first[j] * second[k] - first[k] * second[j]
        });
        let length = dot(normal, normal).sqrt();
        normal.map(|part| part / length)
    }

    /// Out of the body.
    pub fn outward(&self, face: Face) -> [f64; 3] {
        let normal = self.normal(face.axis);
        match face.side {
            Side::High => normal,
            Side::Low => normal.map(|part| -part),
        }
    }

    /// Distance between the two faces of an axis, nm.
    pub fn thickness(&self, axis: Axis) -> f64 {
        dot(self.edges[axis.index()], self.normal(axis))
    }

    /// Area of a face, nm^2.
    pub fn area(&self, axis: Axis) -> f64 {
        self.volume() / self.thickness(axis)
    }

    /// Of the whole body, notch included, nm^3.
    pub fn volume(&self) -> f64 {
        let [a, b, c] = self.edges;
        dot(
            a,
            [
                b[1] * c[2] - b[2] * c[1],
                b[2] * c[0] - b[0] * c[2],
                b[0] * c[1] - b[1] * c[0],
            ],
        )
        .abs()
    }

    /// How deep what belongs to a face reaches, nm.
    pub fn depth(&self, axis: Axis, depth: Depth) -> f64 {
        match depth {
            Depth::Length(length) => length,
            Depth::Layers(layers) => {
                let cell = self.plan.sites.frame.vectors[axis.index()];
                f64::from(layers) * dot(cell, self.normal(axis))
            }
        }
    }

    /// Where a face that moves goes to, of length 1.
    pub fn direction(&self, face: Face, direction: Option<[f64; 3]>) -> [f64; 3] {
        direction.unwrap_or_else(|| self.outward(face))
    }

    /// Where the loading of a solid pulls or pushes, of length 1.
    pub fn pull_direction(&self, solid: &Solid) -> [f64; 3] {
        let (face, pull) = match solid.loading {
            Loading::Velocity { face, direction, .. } => return self.direction(face, direction),
            Loading::Impact { face, .. } => return self.outward(face),
            Loading::Traction { face, pull, .. } | Loading::Pulse { face, pull, .. } => (face, pull),
            Loading::OpposedTractions { axis, pull, .. } => (Face { axis, side: Side::High }, pull),
        };
        match pull {
            Pull::Pressure(_) => self.outward(face),
            Pull::Stress(parts) => {
                let length = dot(parts, parts).sqrt();
                parts.map(|part| part / length)
            }
        }
    }

    /// The length that a moving face strains, nm: displacement over it is the nominal strain. It is the strain along the motion
    /// of an even stretching between the moving part and what is held on the other side, or where the face moves along itself
    /// the shear.
    pub fn strained_length(&self, solid: &Solid, face: Face, direction: Option<[f64; 3]>, depth: Depth) -> f64 {
        let free = self.free_length(solid, face, depth);
        let pull = dot(self.direction(face, direction), self.normal(face.axis)).abs();
        if pull > ALONG_ITSELF { free / pull } else { free }
    }

    /// Between a face that moves to a depth and what is held opposite, nm.
    pub fn free_length(&self, solid: &Solid, face: Face, depth: Depth) -> f64 {
        let held = solid.held.as_ref().filter(|held| held.faces.contains(&face.opposite()));
        let held = held.map_or(0.0, |held| self.depth(face.axis, held.depth));
        self.thickness(face.axis) - self.depth(face.axis, depth) - held
    }

    /// Thickness of the layer of a site, nm; nothing in a box, which begins and ends with the middles of sites.
    pub fn depth_of_a_layer(&self, axis: Axis) -> f64 {
        match self.plan.sites.outline {
            Outline::Rhombohedron(_) => self.depth(axis, Depth::Layers(1)),
            Outline::Box(_) => 0.0,
        }
    }

    /// The diagonal of a cell, by which the sites of blocks end before their edges, nm; nothing in a box.
    pub fn first_cell(&self) -> [f64; 3] {
        let vectors = self.plan.sites.frame.vectors;
        match self.plan.sites.outline {
            Outline::Rhombohedron(_) => [0, 1, 2].map(|axis| vectors.iter().map(|vector| vector[axis]).sum()),
            Outline::Box(_) => [0.0; 3],
        }
    }

    /// The place so far before the middle of a face, nm. Blocks begin with the middle of their first site.
    pub fn before(&self, face: Face, distance: f64) -> [f64; 3] {
        let sum = |axis: usize| self.edges.iter().map(|edge| edge[axis]).sum::<f64>();
        let middle = [0, 1, 2].map(|axis| 0.5 * (sum(axis) - self.first_cell()[axis]));
        let outward = self.outward(face);
        let half = 0.5 * (self.thickness(face.axis) - self.depth_of_a_layer(face.axis));
        [0, 1, 2].map(|axis| middle[axis] + (half + distance) * outward[axis])
    }

    /// Area of a face over the sites on it, nm^2. Of blocks each site has a cell, whatever a slot has taken of the face.
    pub fn area_of_a_site(&self, axis: Axis, sites: usize) -> f64 {
        match &self.plan.sites.outline {
            Outline::Rhombohedron(extent) => {
                let cells: f64 = (0..3)
                    .filter(|&other| other != axis.index())
                    .map(|other| f64::from(extent[other]))
                    .product();
                self.area(axis) / cells
            }
            Outline::Box(_) => self.area(axis) / sites.max(1) as f64,
        }
    }

    fn region(&self, shape: &case::RegionShape) -> RegionShape {
        match *shape {
            case::RegionShape::Box { from, to } => RegionShape::Box { from, to },
            case::RegionShape::Slab { normal, at, half_width } => {
                let normal = self.normal(normal);
                RegionShape::Slab {
                    point: normal.map(|part| part * at),
                    normal,
                    half_width,
                }
            }
            case::RegionShape::Ball { center, radius } => RegionShape::Ball { center, radius },
            case::RegionShape::Cylinder { along, center, radius } => {
                let edge = self.edges[along.index()];
                let length = dot(edge, edge).sqrt();
                RegionShape::Cylinder {
                    point: center,
                    axis: edge.map(|part| part / length),
                    radius,
                }
            }
        }
    }
}

/// A face moves along itself where its motion has no more than this share through it.
pub const ALONG_ITSELF: f64 = 0.5;

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [i32; 3], b: [i32; 3]) -> [i32; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
