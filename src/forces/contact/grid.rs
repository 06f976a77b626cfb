//! Points in cells, so that those near a place are found without a look at the others.

/// Points sorted into square cells no smaller than the search radius.
pub struct Grid {
    origin: [f64; 2],
    cell: f64,
    size: [usize; 2],
    /// Where each cell's points start, and the total at the end.
    start: Vec<u32>,
    points: Vec<u32>,
}

impl Grid {
    pub fn new(position: &[[f64; 2]], radius: f64) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for place in position {
            for axis in 0..2 {
                low[axis] = low[axis].min(place[axis]);
                high[axis] = high[axis].max(place[axis]);
            }
        }
        let extent = [0, 1].map(|axis| (high[axis] - low[axis]).max(0.0));
        let cell = cell_side(extent, position.len(), radius);
        let size = cells_along(extent, cell);
        let mut grid = Self {
            origin: low,
            cell,
            size,
            start: vec![0; size[0] * size[1] + 1],
            points: vec![],
        };
        let cells: Vec<u32> = position
            .iter()
            .map(|&place| grid.number(grid.cell_of(place)) as u32)
            .collect();
        // Where each cell ends, and then, from the last point back to the first, where it starts.
        cells.iter().for_each(|&cell| grid.start[cell as usize] += 1);
        for cell in 1..grid.start.len() {
            grid.start[cell] += grid.start[cell - 1];
        }
        grid.points = vec![0; position.len()];
        for (point, &cell) in cells.iter().enumerate().rev() {
            grid.start[cell as usize] -= 1;
            grid.points[grid.start[cell as usize] as usize] = point as u32;
        }
        grid
    }

    fn cell_of(&self, place: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|axis| (((place[axis] - self.origin[axis]) / self.cell) as usize).min(self.size[axis] - 1))
    }

    fn number(&self, [column, row]: [usize; 2]) -> usize {
        row * self.size[0] + column
    }

    /// Calls with every point in the cell of a place and in the cells around it.
    #[inline(always)]
    pub fn for_each_near(&self, place: [f64; 2], mut call: impl FnMut(usize)) {
        let [column, row] = self.cell_of(place);
        let columns = [column.saturating_sub(1), (column + 1).min(self.size[0] - 1)];
        for row in row.saturating_sub(1)..=(row + 1).min(self.size[1] - 1) {
            let first = self.start[self.number([columns[0], row])] as usize;
            let last = self.start[self.number([columns[1], row]) + 1] as usize;
            self.points[first..last].iter().for_each(|&point| call(point as usize));
        }
    }
}

/// Cells a point that a grid may have along both axes: more than one, because the points of a crack lie along a line.
const CELLS_A_POINT: f64 = 100.0;

/// Points beyond which a grid becomes no finer, so that cells are counted in 32 bits.
///
/// With sides as long as [`cell_side`] says there are at most `n` cells along each axis and `CELLS_A_POINT * n` where both
/// axes count, so `(CELLS_A_POINT + 2) n + 1` in all. In a crystal the search radius makes far fewer.
const MOST_POINTS: usize = u32::MAX as usize / (CELLS_A_POINT as usize + 3);

/// Side of a cell, nm: the search radius, or more where fragments have flown so far apart that the cells would be very many
/// more than the points.
fn cell_side(extent: [f64; 2], points: usize, radius: f64) -> f64 {
    let points = points.clamp(1, MOST_POINTS) as f64;
    let fitting = (extent[0] * extent[1] / (CELLS_A_POINT * points)).sqrt();
    let longest = extent[0].max(extent[1]) / points;
    radius.max(fitting).max(longest)
}

fn cells_along(extent: [f64; 2], cell: f64) -> [usize; 2] {
    extent.map(|length| (length / cell) as usize + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_of_any_number_of_points_are_counted_in_32_bits() {
        // From a crystal to fragments that have left the solar system, in a square and along a line, nm.
        for extent in [[3e4, 3e4], [1e9, 1e9], [1e25, 1e25], [1e25, 1.0], [1e25, 0.0]] {
            for points in [1, 1_000_000, MOST_POINTS, 1_000_000_000, u32::MAX as usize] {
                let [columns, rows] = cells_along(extent, cell_side(extent, points, 0.4));
                let cells = columns.checked_mul(rows).unwrap();
                assert!(
                    cells <= u32::MAX as usize && cells <= 103 * points,
                    "{cells} cells for {points} points in {extent:?} nm"
                );
            }
        }
    }

    #[test]
    fn a_crystal_of_a_billion_atoms_is_searched_in_cells_of_the_search_radius() {
        let (spacing, radius) = (0.25, 0.4);
        let side = spacing * (0.75_f64.sqrt() * 1e9).sqrt();
        assert_eq!(cell_side([side, side], 1_000_000_000, radius), radius);
    }
}
