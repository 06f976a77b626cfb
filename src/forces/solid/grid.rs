//! Points sorted into cubes, so that those near a place are found.

use rayon::prelude::*;

#[derive(Clone, Debug, Default)]
pub struct Grid {
    origin: [f64; 3],
    width: f64,
    counts: [usize; 3],
    starts: Vec<u32>,
    members: Vec<u32>,
}

/// Cubes a point, at most: where points are strewn over a wide space, cubes are wider.
const MOST_CUBES_A_POINT: usize = 4;

impl Grid {
    /// Cubes no narrower than a radius.
    pub fn new(places: &[[f64; 3]], is_point: impl Fn(usize) -> bool, radius: f64) -> Self {
        let (mut least, mut most) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for (_, place) in places.iter().enumerate().filter(|(point, _)| is_point(*point)) {
            for axis in 0..3 {
                least[axis] = least[axis].min(place[axis]);
                most[axis] = most[axis].max(place[axis]);
            }
        }
        let mut width = radius;
        let counts_at = |width: f64| -> [usize; 3] {
            std::array::from_fn(|axis| ((most[axis] - least[axis]).max(0.0) / width) as usize + 1)
        };
        let too_many = |counts: [usize; 3]| {
            let product = counts.iter().map(|&count| count as f64).product::<f64>();
            product > (MOST_CUBES_A_POINT * places.len() + 64) as f64
        };
        while too_many(counts_at(width)) {
            width *= 1.26;
        }
        let mut grid = Self {
            origin: least,
            width,
            counts: counts_at(width),
            starts: Vec::new(),
            members: Vec::new(),
        };
        let cubes: Vec<u32> = places
            .par_iter()
            .map(|&place| grid.number(grid.cube(place)) as u32)
            .collect();
        let mut starts = vec![0u32; grid.counts.iter().product::<usize>() + 1];
        let points = || cubes.iter().enumerate().filter(|(point, _)| is_point(*point));
        points().for_each(|(_, &cube)| starts[cube as usize + 1] += 1);
        (1..starts.len()).for_each(|cube| starts[cube] += starts[cube - 1]);
        let mut next = starts.clone();
        grid.members = vec![0; starts[starts.len() - 1] as usize];
        for (point, &cube) in points() {
            grid.members[next[cube as usize] as usize] = point as u32;
            next[cube as usize] += 1;
        }
        grid.starts = starts;
        grid
    }

    fn cube(&self, place: [f64; 3]) -> [usize; 3] {
        std::array::from_fn(|axis| {
            let number = ((place[axis] - self.origin[axis]) / self.width).max(0.0) as usize;
            number.min(self.counts[axis] - 1)
        })
    }

    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    /// Gives all points that may be within the radius of a place, and more.
    #[inline(always)]
    pub fn near(&self, place: [f64; 3], mut give: impl FnMut(u32)) {
        let [x, y, z] = self.cube(place);
        let beside = |at: usize, axis: usize| at.saturating_sub(1)..=(at + 1).min(self.counts[axis] - 1);
        for z in beside(z, 2) {
            for y in beside(y, 1) {
                let row = beside(x, 0);
                let from = self.starts[self.number([*row.start(), y, z])];
                let to = self.starts[self.number([*row.end(), y, z]) + 1];
                self.members[from as usize..to as usize]
                    .iter()
                    .for_each(|&point| give(point));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_within_the_radius_is_given_once() {
        let mut places: Vec<[f64; 3]> = (0..400u32)
            .map(|number| [7, 11, 13].map(|prime| f64::from(number * prime % 101) * 0.1))
            .collect();
        places.push([90.0, -40.0, 3.0]);
        let grid = Grid::new(&places, |point| point != 17, 1.0);
        for place in &places {
            let mut found = Vec::new();
            grid.near(*place, |point| found.push(point as usize));
            let squared = |other: &[f64; 3]| (0..3).map(|axis| (other[axis] - place[axis]).powi(2)).sum::<f64>();
            let near = places
                .iter()
                .enumerate()
                .filter(|(point, other)| *point != 17 && squared(other) <= 1.0);
            for (point, _) in near {
                assert_eq!(found.iter().filter(|&&other| other == point).count(), 1);
            }
        }
    }
}
