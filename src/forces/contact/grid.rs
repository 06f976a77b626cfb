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
        // Fragments that fly far apart must not make very many more cells than there are points; some more they may be,
        // because the points of a crack lie along a line.
        let fitting = (extent[0] * extent[1] / position.len().max(1) as f64).sqrt();
        let longest = extent[0].max(extent[1]) / (position.len().max(1) as f64);
        let cell = radius.max(0.1 * fitting).max(longest);
        let size = extent.map(|length| (length / cell) as usize + 1);
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
