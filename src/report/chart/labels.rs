//! Where the names of points stand, so that they cover neither each other nor points.

/// Upper left corner, width and height, pixels.
type Rectangle = [i32; 4];

/// For each point, with a name of this width and height, the upper left corner of the name relative to the point. Points are
/// dots of a radius.
pub fn places(points: &[(i32, i32)], sizes: &[(i32, i32)], radius: i32) -> Vec<(i32, i32)> {
    let mut taken: Vec<Rectangle> = points
        .iter()
        .map(|(x, y)| [x - radius, y - radius, 2 * radius, 2 * radius])
        .collect();
    let mut places = Vec::new();
    for (&(x, y), &(width, height)) in points.iter().zip(sizes) {
        let covered = |&(right, down): &(i32, i32)| -> i64 {
            let name = [x + right, y + down, width, height];
            taken.iter().map(|other| overlap(name, *other)).sum()
        };
        let place = around((width, height), radius).into_iter().min_by_key(covered);
        let place = place.unwrap_or_default();
        taken.push([x + place.0, y + place.1, width, height]);
        places.push(place);
    }
    places
}

/// Places for a name around a dot, the best ones first, nearer ones before farther ones.
fn around((width, height): (i32, i32), radius: i32) -> Vec<(i32, i32)> {
    let at = |gap: i32| {
        let (right, left, below, above) = (gap, -gap - width, gap, -gap - height);
        let middle = (-width / 2, -height / 2);
        [
            (right, above + height / 4),
            (right, below - height / 4),
            (left, above + height / 4),
            (left, below - height / 4),
            (right, middle.1),
            (left, middle.1),
            (middle.0, above),
            (middle.0, below),
        ]
    };
    (1..=4).flat_map(|times| at(times * radius + radius / 2)).collect()
}

/// Area that two rectangles share.
fn overlap(a: Rectangle, b: Rectangle) -> i64 {
    let along = |axis: usize| (a[axis] + a[axis + 2]).min(b[axis] + b[axis + 2]) - a[axis].max(b[axis]);
    i64::from(along(0).max(0)) * i64::from(along(1).max(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_points_that_stand_close_cover_nothing() {
        let points = [(100, 100), (104, 102), (97, 108), (110, 95), (102, 100), (300, 100)];
        let sizes = [(14, 10); 6];
        let places = places(&points, &sizes, 4);
        assert_eq!(
            places[5],
            around(sizes[5], 4)[0],
            "a point that stands alone has its name in the best place"
        );
        let name = |index: usize| {
            [
                points[index].0 + places[index].0,
                points[index].1 + places[index].1,
                14,
                10,
            ]
        };
        for first in 0..points.len() {
            for second in 0..first {
                assert_eq!(overlap(name(first), name(second)), 0, "{first} and {second}");
            }
            for (x, y) in points {
                assert_eq!(overlap(name(first), [x - 4, y - 4, 8, 8]), 0, "{first} and ({x}, {y})");
            }
        }
    }
}
