//! Where a finer element is wanted than elsewhere.

/// Part of a specimen, x from its left edge and y from the crack plane, nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Band { half_width: f64 },
    Box { from: [f64; 2], to: [f64; 2] },
    Disc { center: [f64; 2], radius: f64 },
}

/// A region and the largest element allowed in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    pub shape: Shape,
    pub element: u16,
}

impl Shape {
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        match *self {
            Self::Band { half_width } => y.abs() <= half_width,
            Self::Box { from, to } => (from[0]..=to[0]).contains(&x) && (from[1]..=to[1]).contains(&y),
            Self::Disc { center, radius } => (x - center[0]).hypot(y - center[1]) <= radius,
        }
    }
}
