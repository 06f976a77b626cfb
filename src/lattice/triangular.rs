//! The triangular lattice with close-packed rows along x.
//!
//! Site (i, j) stands at x = (i + j/2) r0, y = j (sqrt(3)/2) r0, so a lattice vector is a pair of integers.

/// Height of one row over the lattice spacing.
pub const ROW_HEIGHT: f64 = 0.866_025_403_784_438_6;

/// Area of one site over the square of the lattice spacing.
pub const SITE_AREA: f64 = ROW_HEIGHT;

/// One of each pair of opposite nearest-neighbour vectors. Bond events name them by their index.
pub const NEAREST: [[i32; 2]; 3] = [[1, 0], [0, 1], [-1, 1]];

/// Position of the lattice vector (i, j) in units of the lattice spacing.
#[inline(always)]
pub fn position(vector: [i32; 2]) -> [f64; 2] {
    [f64::from(vector[0]) + 0.5 * f64::from(vector[1]), f64::from(vector[1]) * ROW_HEIGHT]
}

/// Squared length of a lattice vector in units of the squared lattice spacing; an integer (the Loeschian numbers).
#[inline(always)]
pub fn squared_length(vector: [i32; 2]) -> i32 {
    let [i, j] = vector;
    i * i + i * j + j * j
}

/// Every lattice vector no longer than `radius` spacings, both signs, without zero: by length, then row, then column.
pub fn vectors_within(radius: f64) -> Vec<[i32; 2]> {
    let reach = (radius / ROW_HEIGHT).ceil() as i32 + 1;
    let limit = radius * radius * (1.0 + 1e-12);
    let mut vectors: Vec<[i32; 2]> = (-reach..=reach)
        .flat_map(|j| (-2 * reach..=2 * reach).map(move |i| [i, j]))
        .filter(|&vector| vector != [0, 0] && f64::from(squared_length(vector)) <= limit)
        .collect();
    vectors.sort_by_key(|&vector| (squared_length(vector), vector[1], vector[0]));
    vectors
}

/// One of each pair of opposite vectors of [`vectors_within`]: the one that points up, or right along a row.
pub fn half_vectors_within(radius: f64) -> Vec<[i32; 2]> {
    vectors_within(radius).into_iter().filter(|&[i, j]| j > 0 || (j == 0 && i > 0)).collect()
}

/// Length, in spacings, of the shortest lattice vectors longer than `radius` spacings.
pub fn next_length(radius: f64) -> f64 {
    let longer = vectors_within(radius + 2.0).into_iter().map(|vector| f64::from(squared_length(vector)).sqrt());
    longer.filter(|&length| length > radius * (1.0 + 1e-12)).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_shells_have_six_vectors_each_at_one_root_three_and_two() {
        let lengths: Vec<i32> = vectors_within(2.0).into_iter().map(squared_length).collect();
        assert_eq!(lengths, [[1; 6], [3; 6], [4; 6]].concat());
        assert_eq!(half_vectors_within(2.0).len(), 9);
        assert_eq!(next_length(2.0), 7f64.sqrt());
        assert_eq!(next_length(1.4), 3f64.sqrt());
    }

    #[test]
    fn positions_have_the_length_their_integers_say() {
        for vector in vectors_within(4.0) {
            let [x, y] = position(vector);
            assert!((x * x + y * y - f64::from(squared_length(vector))).abs() < 1e-12);
        }
    }
}
