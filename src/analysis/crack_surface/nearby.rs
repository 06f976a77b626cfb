//! Which of many places are near one.

use std::collections::{HashMap, HashSet};

/// Places by cells as wide as the largest distance asked for.
pub struct Nearby {
    width: f64,
    cells: HashMap<[i32; 3], Vec<(u32, [f64; 3])>>,
}

impl Nearby {
    /// Those of `places` that may be within a radius of one of the `wanted`.
    pub fn around(
        wanted: impl Iterator<Item = [f64; 3]>,
        places: impl Iterator<Item = (u32, [f64; 3])>,
        radius: f64,
    ) -> Self {
        let cells: HashSet<[i32; 3]> = wanted.flat_map(|place| beside(cell(place, radius))).collect();
        let mut nearby = Self {
            width: radius,
            cells: HashMap::new(),
        };
        for (number, place) in places {
            let cell = cell(place, radius);
            if cells.contains(&cell) {
                nearby.cells.entry(cell).or_default().push((number, place));
            }
        }
        nearby
    }

    /// Numbers of the places within a distance that is no larger than the radius.
    pub fn within(&self, place: [f64; 3], distance: f64) -> impl Iterator<Item = u32> {
        let others = beside(cell(place, self.width)).filter_map(|cell| self.cells.get(&cell));
        others.flatten().filter_map(move |&(number, other)| {
            let squared: f64 = (0..3).map(|axis| (other[axis] - place[axis]).powi(2)).sum();
            (squared <= distance * distance).then_some(number)
        })
    }
}

fn cell(place: [f64; 3], width: f64) -> [i32; 3] {
    place.map(|component| (component / width).floor() as i32)
}

/// A cell and those around it.
fn beside([x, y, z]: [i32; 3]) -> impl Iterator<Item = [i32; 3]> {
    (0..27).map(move |number| [x + number % 3 - 1, y + number / 3 % 3 - 1, z + number / 9 - 1])
}
