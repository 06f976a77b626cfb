//! The face-centred cubic lattice in its primitive vectors.
//!
//! Site (i, j, k) stands at i a1 + j a2 + k a3, in units of the distance r0 of nearest neighbours; a1, a2, a3 point along
//! [011], [101] and [110] of the cube, 60 degrees apart. So a lattice vector is three integers, and {111} planes are those of
//! constant i, j, k or i + j + k.

/// Volume of one site over the cube of the lattice spacing.
pub const SITE_VOLUME: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// One of each pair of opposite nearest-neighbour vectors.
pub const NEAREST: [[i32; 3]; 6] = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, -1, 0], [1, 0, -1], [0, 1, -1]];

/// Position of a lattice vector along the edges of the cube, in units of the lattice spacing.
pub fn in_the_cube([i, j, k]: [i32; 3]) -> [f64; 3] {
    [j + k, i + k, i + j].map(|half_edges| f64::from(half_edges) * std::f64::consts::FRAC_1_SQRT_2)
}

/// Squared length of a lattice vector in units of the squared lattice spacing; an integer.
#[inline(always)]
pub fn squared_length([i, j, k]: [i32; 3]) -> i32 {
    i * i + j * j + k * k + i * j + j * k + i * k
}

/// One of each pair of opposite lattice vectors no longer than `radius` spacings, without zero, by length and then by
/// k, j and i: the one whose last component that is not zero is positive.
pub fn half_vectors_within(radius: f64) -> Vec<[i32; 3]> {
    // A component is the distance from a {111} plane over that of two such planes, sqrt(2/3).
    let reach = (radius * 1.5f64.sqrt()).ceil() as i32 + 1;
    let limit = radius * radius * (1.0 + 1e-12);
    let range = -reach..=reach;
    let mut vectors: Vec<[i32; 3]> = Vec::new();
    for k in 0..=reach {
        for j in range.clone() {
            let plane = range.clone().map(|i| [i, j, k]);
            let is_half = |&[i, j, k]: &[i32; 3]| k > 0 || j > 0 || (j == 0 && i > 0);
            let is_near = |&vector: &[i32; 3]| f64::from(squared_length(vector)) <= limit;
            vectors
                .extend(plane.filter(|vector| is_half(vector) && (vector[2] > 0 || vector[1] >= 0) && is_near(vector)));
        }
    }
    vectors.sort_by_key(|&vector| (squared_length(vector), vector[2], vector[1], vector[0]));
    vectors
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_five_shells_have_12_6_24_12_and_24_sites() {
        // The shells of any textbook; their squared radii are 1 to 5 nearest-neighbour distances squared.
        let vectors = half_vectors_within(5f64.sqrt());
        let shells = [1, 2, 3, 4, 5].map(|squared| vectors.iter().filter(|&&v| squared_length(v) == squared).count());
        assert_eq!(shells.map(|half| 2 * half), [12, 6, 24, 12, 24]);
        let nearest = &vectors[..6];
        assert!(NEAREST.iter().all(|vector| {
            let opposite = vector.map(|component| -component);
            nearest.contains(vector) || nearest.contains(&opposite)
        }));
    }

    #[test]
    fn positions_have_the_length_their_integers_say() {
        for vector in half_vectors_within(3.0) {
            let squared: f64 = in_the_cube(vector).iter().map(|component| component * component).sum();
            assert!((squared - f64::from(squared_length(vector))).abs() < 1e-12);
        }
    }
}
