//! Rectangles in cells, so that those near a place are found without a look at the others.

use super::near::Bounds;

/// Rectangles sorted into square cells, each into all that it covers: a triangle that a crack has torn to a great length is
/// in many cells, and leaves them as small as the others need them.
pub struct Boxes {
    origin: [f64; 2],
    cell: f64,
    size: [usize; 2],
    /// The first cell of every rectangle, in either direction.
    first: Vec<[usize; 2]>,
    /// Where each cell's rectangles start, and the total at the end.
    start: Vec<u32>,
    boxes: Vec<u32>,
}

impl Boxes {
    /// No more than one rectangle in so many is larger than a cell.
    const LARGER: usize = 10;

    /// Neither cells nor entries in them are more than so many times the rectangles: fragments may fly far, and be torn far.
    const MOST: f64 = 100.0;

    /// For searches within a distance.
    pub fn new(bounds: &[Bounds], distance: f64) -> Self {
        let mut all = Bounds::NOTHING;
        bounds.iter().for_each(|bounds| all.join(bounds));
        let origin = all.low();
        let mut sides: Vec<f64> = bounds.iter().map(Bounds::longer_side).collect();
        sides.sort_unstable_by(f64::total_cmp);
        let usual = sides.iter().rev().nth(sides.len() / Self::LARGER);
        let most = Self::MOST * sides.len().max(Self::LARGER) as f64;
        let mut cell = usual.unwrap_or(&0.0) + distance;
        let cells_of = |bounds: &Bounds, cell: f64| bounds.extent().map(|side| side / cell + 1.0);
        let covered = |bounds: &Bounds, cell: f64| cells_of(bounds, cell).iter().product::<f64>();
        while covered(&all, cell) > most || bounds.iter().map(|bounds| covered(bounds, cell)).sum::<f64>() > most {
            cell *= 2.0;
        }
        let mut boxes = Self {
            origin,
            cell,
            size: cells_of(&all, cell).map(|cells| cells as usize),
            first: Vec::new(),
            start: Vec::new(),
            boxes: Vec::new(),
        };
        boxes.start = vec![0; boxes.size[0] * boxes.size[1] + 1];
        boxes.first = bounds.iter().map(|bounds| boxes.cell_of(bounds.low())).collect();
        boxes.sort_in(bounds);
        boxes
    }

    fn sort_in(&mut self, bounds: &[Bounds]) {
        let mut start = std::mem::take(&mut self.start);
        for bounds in bounds {
            self.cells(bounds).for_each(|cell| start[self.number(cell) + 1] += 1);
        }
        for cell in 1..start.len() {
            start[cell] += start[cell - 1];
        }
        let mut next = start.clone();
        self.boxes = vec![0; start[start.len() - 1] as usize];
        for (number, bounds) in bounds.iter().enumerate() {
            for cell in self.cells(bounds) {
                let next = &mut next[self.number(cell)];
                self.boxes[*next as usize] = number as u32;
                *next += 1;
            }
        }
        self.start = start;
    }

    fn cell_of(&self, place: [f64; 2]) -> [usize; 2] {
        [0, 1].map(|axis| (((place[axis] - self.origin[axis]) / self.cell) as usize).min(self.size[axis] - 1))
    }

    /// The cells that a rectangle covers.
    fn cells(&self, bounds: &Bounds) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [first, last] = [bounds.low(), bounds.high()].map(|corner| self.cell_of(corner));
        (first[1]..=last[1]).flat_map(move |row| (first[0]..=last[0]).map(move |column| [column, row]))
    }

    fn number(&self, [column, row]: [usize; 2]) -> usize {
        row * self.size[0] + column
    }

    /// Calls once with every rectangle in a cell that this one covers.
    #[inline(always)]
    pub fn for_each_near(&self, bounds: &Bounds, mut call: impl FnMut(usize)) {
        let own = self.cell_of(bounds.low());
        for cell in self.cells(bounds) {
            let number = self.number(cell);
            for &other in &self.boxes[self.start[number] as usize..self.start[number + 1] as usize] {
                let first = self.first[other as usize];
                // Where both cover several cells it is called in the first of them.
                if cell == [first[0].max(own[0]), first[1].max(own[1])] {
                    call(other as usize);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn rectangle([x, y]: [f64; 2], [width, height]: [f64; 2]) -> Bounds {
        let mut bounds = Bounds::NOTHING;
        bounds.include(&[[x, y], [x + width, y + height]]);
        bounds
    }

    #[test]
    fn one_torn_triangle_leaves_the_search_among_the_others_short() {
        let row = |count: u32| (0..count).map(|k| rectangle([f64::from(k), 0.0], [1.0, 0.9]));
        let torn = rectangle([0.0, 0.0], [1000.0, 600.0]);
        let bounds: Vec<Bounds> = row(1000).chain([torn]).collect();
        let boxes = Boxes::new(&bounds, 0.1);
        let mut looks = 0;
        for near in row(1000) {
            boxes.for_each_near(&near.widened(0.1), |_| looks += 1);
        }
        // Each covers three cells of 1.1 in a row at most, which touch six of the others; and there is the torn one.
        assert!(looks <= 8 * 1000, "{looks} looks");
    }

    #[test]
    fn cells_are_no_more_than_some_times_the_rectangles_however_far_these_fly() {
        let far = [rectangle([0.0, 0.0], [1.0, 1.0]), rectangle([1e9, 1e9], [1e6, 1e6])];
        let boxes = Boxes::new(&far, 0.1);
        assert!(boxes.start.len() < 2000 && boxes.boxes.len() < 2000);
        assert_eq!(Boxes::new(&[], 0.1).boxes.len(), 0);
    }

    proptest! {
        #[test]
        fn every_rectangle_that_overlaps_is_found_once(
            numbers in prop::collection::vec(prop::array::uniform4(0.0..1.0f64), 1..60),
            distance in 0.01..0.5f64,
        ) {
            // One in some is much longer than the others.
            let bounds: Vec<Bounds> = numbers
                .iter()
                .map(|&[x, y, width, height]| rectangle([10.0 * x, 10.0 * y], [0.1 / (width + 0.01), height]))
                .collect();
            let boxes = Boxes::new(&bounds, distance);
            for one in &bounds {
                let mut found = vec![0; bounds.len()];
                boxes.for_each_near(&one.widened(distance), |other| found[other] += 1);
                for (other, times) in bounds.iter().zip(found) {
                    let overlaps = one.widened(distance).overlaps(other);
                    prop_assert!(times == 1 || (times == 0 && !overlaps));
                }
            }
        }
    }
}
