//! Which triangles are near each other.

/// The corners of a triangle, nm.
pub type Corners = [[f64; 2]; 3];

/// A rectangle along the axes: from and to in x and in y, nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds([[f64; 2]; 2]);

impl Bounds {
    /// Those that hold nothing.
    pub const NOTHING: Self = Self([[f64::INFINITY, f64::NEG_INFINITY]; 2]);

    pub fn are_nothing(&self) -> bool {
        *self == Self::NOTHING
    }

    /// Widens them until they hold these points.
    pub fn include(&mut self, points: &[[f64; 2]]) {
        for point in points {
            for (axis, [low, high]) in self.0.iter_mut().enumerate() {
                *low = low.min(point[axis]);
                *high = high.max(point[axis]);
            }
        }
    }

    /// Widens them until they hold others.
    pub fn join(&mut self, other: &Self) {
        self.include(&[other.low(), other.high()]);
    }

    /// The same with so much more on each side.
    pub fn widened(&self, by: f64) -> Self {
        Self(self.0.map(|[low, high]| [low - by, high + by]))
    }

    pub fn low(&self) -> [f64; 2] {
        self.0.map(|[low, _]| low)
    }

    pub fn high(&self) -> [f64; 2] {
        self.0.map(|[_, high]| high)
    }

    /// Whether some point is in both.
    pub fn overlaps(&self, other: &Self) -> bool {
        let mut sides = self.0.iter().zip(&other.0);
        sides.all(|(own, other)| own[0] <= other[1] && other[0] <= own[1])
    }

    /// Lengths of the sides; none of what holds nothing.
    pub fn extent(&self) -> [f64; 2] {
        self.0.map(|[low, high]| (high - low).max(0.0))
    }

    pub fn longer_side(&self) -> f64 {
        let [x, y] = self.extent();
        x.max(y)
    }

    /// Whether a point is inside or less than a distance away from each side.
    pub fn are_within(&self, distance: f64, point: [f64; 2]) -> bool {
        let mut sides = self.0.iter().zip(point);
        sides.all(|([low, high], x)| x - high < distance && low - x < distance)
    }
}

/// Whether a straight strip at least this wide lies between two triangles, along an edge of one of them: then no site of
/// one is nearer to a site of the other. Triangles that only meet corner to corner may have no such strip although they
/// are a little farther apart.
pub fn are_apart(one: &Corners, other: &Corners, distance: f64) -> bool {
    has_strip_along_an_edge(one, other, distance) || has_strip_along_an_edge(other, one, distance)
}

/// The same of a triangle and a point, with the strip along an edge of the triangle.
pub fn is_apart_from(triangle: &Corners, point: [f64; 2], distance: f64) -> bool {
    has_strip_along_an_edge(triangle, &[point; 3], distance)
}

fn has_strip_along_an_edge(own: &Corners, others: &Corners, distance: f64) -> bool {
    (0..3).any(|corner| {
        let [from, to, third] = [0, 1, 2].map(|k| own[(corner + k) % 3]);
        let edge = [to[0] - from[0], to[1] - from[1]];
        // Twice the area of the triangle that the edge makes with a point, negative on one side.
        let side = |point: [f64; 2]| edge[0] * (point[1] - from[1]) - edge[1] * (point[0] - from[0]);
        let outward = if side(third) > 0.0 { -1.0 } else { 1.0 };
        let nearest = others
            .iter()
            .map(|&point| outward * side(point))
            .fold(f64::INFINITY, f64::min);
        // An edge without length separates nothing.
        nearest > distance * (edge[0] * edge[0] + edge[1] * edge[1]).sqrt()
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const UP: Corners = [[0.0, 0.0], [9.0, 0.0], [4.5, 7.8]];

    fn moved(by: [f64; 2]) -> Corners {
        UP.map(|[x, y]| [x + by[0], y + by[1]])
    }

    #[test]
    fn triangles_with_a_strip_between_them_are_apart() {
        assert!(are_apart(&UP, &moved([0.0, -9.8]), 1.9));
        assert!(!are_apart(&UP, &moved([0.0, -9.8]), 2.1));
        assert!(!are_apart(&UP, &moved([3.0, 2.0]), 0.1), "they overlap");
        assert!(!are_apart(&UP, &moved([10.0, 0.0]), 1.7), "they meet corner to corner");
        assert!(is_apart_from(&UP, [4.5, -2.0], 1.9) && !is_apart_from(&UP, [4.5, -2.0], 2.1));
    }

    #[test]
    fn bounds_hold_what_was_included_and_what_is_near_it() {
        let mut bounds = Bounds::NOTHING;
        assert!(bounds.are_nothing() && !bounds.are_within(1e9, [0.0, 0.0]));
        bounds.include(&UP);
        assert!(bounds.are_within(1.0, [9.9, 7.0]) && !bounds.are_within(1.0, [10.1, 7.0]));
    }

    #[test]
    fn a_triangle_without_an_inside_is_near_to_everything_on_its_line() {
        let flat = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0]];
        assert!(!are_apart(&flat, &flat, 0.5));
    }

    proptest! {
        #[test]
        fn no_two_points_of_triangles_that_are_apart_are_near(
            corners in prop::array::uniform12(-10.0..10.0f64),
            shares in prop::array::uniform4(0.0..1.0f64),
            distance in 0.1..5.0f64,
        ) {
            let [one, other] = [0, 6].map(|at| [0, 2, 4].map(|k| [corners[at + k], corners[at + k + 1]]));
            let inside = |triangle: &Corners, [a, b]: [f64; 2]| {
                let weights = [1.0 - a, a * (1.0 - b), a * b];
                [0, 1].map(|axis| (0..3).map(|k| weights[k] * triangle[k][axis]).sum::<f64>())
            };
            let [p, q] = [inside(&one, [shares[0], shares[1]]), inside(&other, [shares[2], shares[3]])];
            let between = (p[0] - q[0]).hypot(p[1] - q[1]);
            const ROUNDING: f64 = 1e-9;
            prop_assert!(!are_apart(&one, &other, distance) || between >= distance - ROUNDING);
            prop_assert!(!is_apart_from(&one, q, distance) || between >= distance - ROUNDING);
        }
    }
}
