//! Where the names of points stand, so that they cover neither each other nor points, and stay within the chart.

/// Upper left corner, width and height, pixels.
type Rectangle = [i32; 4];

/// A dot with a name of this size beside it.
pub struct Label {
    pub at: (i32, i32),
    pub size: (i32, i32),
    /// Whether it has its name even where there is no free place.
    pub is_needed: bool,
}

/// For each label the upper left corner of the name relative to its dot; `None` where there is no free place for it within
/// the bounds. Dots have one radius; the needed names are placed first.
pub fn places(labels: &[Label], radius: i32, bounds: Rectangle) -> Vec<Option<(i32, i32)>> {
    let dot = |label: &Label| [label.at.0 - radius, label.at.1 - radius, 2 * radius, 2 * radius];
    let mut taken: Vec<Rectangle> = labels.iter().map(dot).collect();
    let mut places = vec![None; labels.len()];
    let [needed, others] = [true, false].map(|is_needed| {
        let of_kind = labels.iter().enumerate();
        of_kind.filter(move |(_, label)| label.is_needed == is_needed)
    });
    for (number, label) in needed.chain(others) {
        let name = |&(right, down): &(i32, i32)| [label.at.0 + right, label.at.1 + down, label.size.0, label.size.1];
        let covered = |place: &(i32, i32)| -> i64 {
            let name = name(place);
            let outside = i64::from(name[2]) * i64::from(name[3]) - overlap(name, bounds);
            outside + taken.iter().map(|other| overlap(name, *other)).sum::<i64>()
        };
        let best = around(label.size, radius).into_iter().min_by_key(covered);
        if let Some(place) = best.filter(|place| label.is_needed || covered(place) == 0) {
            taken.push(name(&place));
            places[number] = Some(place);
        }
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

    const BOUNDS: Rectangle = [0, 0, 320, 200];

    fn labels(points: &[(i32, i32)], is_needed: bool) -> Vec<Label> {
        let label = |&at: &(i32, i32)| Label {
            at,
            size: (14, 10),
            is_needed,
        };
        points.iter().map(label).collect()
    }

    #[test]
    fn names_of_points_that_stand_close_cover_nothing_and_stay_inside() {
        let points = [
            (100, 100),
            (104, 102),
            (97, 108),
            (110, 95),
            (102, 100),
            (300, 100),
            (318, 4),
        ];
        let labels = labels(&points, true);
        let places = places(&labels, 4, BOUNDS);
        assert_eq!(
            places[5],
            Some(around(labels[5].size, 4)[0]),
            "a point that stands alone has its name in the best place"
        );
        let name = |index: usize| {
            let (right, down) = places[index].unwrap();
            [points[index].0 + right, points[index].1 + down, 14, 10]
        };
        for first in 0..points.len() {
            assert_eq!(overlap(name(first), BOUNDS), 140, "{first} is inside");
            for second in 0..first {
                assert_eq!(overlap(name(first), name(second)), 0, "{first} and {second}");
            }
            for (x, y) in points {
                assert_eq!(overlap(name(first), [x - 4, y - 4, 8, 8]), 0, "{first} and ({x}, {y})");
            }
        }
    }

    #[test]
    fn in_a_crowd_only_the_needed_names_are_there() {
        let crowd: Vec<(i32, i32)> = (0..40).map(|place| (100 + place % 8, 100 + place / 8)).collect();
        let mut labels = labels(&crowd, false);
        labels[39].is_needed = true;
        let places = places(&labels, 4, BOUNDS);
        assert!(places[39].is_some());
        assert!(places.iter().any(Option::is_none));
    }
}
