//! Where a finer element is wanted than elsewhere in a solid.

/// Part of a solid, in the laboratory, nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Box {
        from: [f64; 3],
        to: [f64; 3],
    },
    /// So far on both sides of a plane through a point; the normal has the length 1.
    Slab {
        point: [f64; 3],
        normal: [f64; 3],
        half_width: f64,
    },
    Ball {
        center: [f64; 3],
        radius: f64,
    },
    /// Around a line through a point; the axis has the length 1.
    Cylinder {
        point: [f64; 3],
        axis: [f64; 3],
        radius: f64,
    },
}

/// A region and the largest element allowed in it, atoms an edge of its block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    pub shape: Shape,
    pub element: u16,
}

impl Shape {
    pub fn contains(&self, place: [f64; 3]) -> bool {
        self.distance(place) <= 0.0
    }

    /// Distance of a place from the region, nm, or less of one that is outside; not positive inside.
    pub fn distance(&self, place: [f64; 3]) -> f64 {
        match *self {
            Self::Box { from, to } => {
                let outside = |axis: usize| (from[axis] - place[axis]).max(place[axis] - to[axis]);
                outside(0).max(outside(1)).max(outside(2))
            }
            Self::Slab {
                point,
                normal,
                half_width,
            } => dot(minus(place, point), normal).abs() - half_width,
            Self::Ball { center, radius } => squared(minus(place, center)).sqrt() - radius,
            Self::Cylinder { point, axis, radius } => {
                let way = minus(place, point);
                let along = dot(way, axis);
                (squared(way) - along * along).max(0.0).sqrt() - radius
            }
        }
    }
}

fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn squared(a: [f64; 3]) -> f64 {
    dot(a, a)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_hold_what_is_within_their_radius_or_width() {
        let z = [0.0, 0.0, 1.0];
        let shapes = [
            Shape::Box {
                from: [0.0; 3],
                to: [2.0; 3],
            },
            Shape::Slab {
                point: [0.0, 0.0, 1.0],
                normal: z,
                half_width: 1.0,
            },
            Shape::Ball {
                center: [1.0; 3],
                radius: 1.0,
            },
            Shape::Cylinder {
                point: [1.0, 1.0, 9.0],
                axis: z,
                radius: 1.0,
            },
        ];
        let held = |place| shapes.map(|shape| shape.contains(place));
        assert_eq!(held([1.0, 1.0, 1.5]), [true; 4]);
        assert_eq!(held([1.9, 1.9, 1.9]), [true, true, false, false]);
        assert_eq!(held([1.0, 1.5, 7.0]), [false, false, false, true]);
    }
}
