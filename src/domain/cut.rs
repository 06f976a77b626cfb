//! Where to cut.

use crate::mesh::grouped::Grouped;

/// Starts of the parts of a sequence that all cost about the same, and its length at the end: an item belongs to the part in
/// which its middle lies, so that no part is farther from its share than an item.
pub fn equal_shares(costs: impl Iterator<Item = f64> + Clone, parts: usize) -> Vec<usize> {
    let total: f64 = costs.clone().sum();
    let mut starts = vec![0];
    let mut spent = 0.0;
    let mut length = 0;
    for cost in costs {
        // Where the middle of the item lies tells its part.
        let part = ((spent + 0.5 * cost) / total * parts as f64) as usize;
        while starts.len() <= part.min(parts - 1) {
            starts.push(length);
        }
        spent += cost;
        length += 1;
    }
    starts.resize(parts + 1, length);
    starts
}

/// The same for the elements of a mesh that are in groups, which stay whole: the nodes of a part follow each other.
pub fn equal_shares_of_groups(mesh: &impl Grouped, mut costs: impl Iterator<Item = f64>, parts: usize) -> Vec<usize> {
    let groups = 0..mesh.group_count();
    let sizes = groups.map(|number| mesh.group(number)[0].len());
    let of_groups: Vec<f64> = sizes.map(|size| costs.by_ref().take(size).sum()).collect();
    let starts = equal_shares(of_groups.iter().copied(), parts).into_iter();
    let start = |number: usize| match number < mesh.group_count() {
        true => mesh.group(number)[0].start,
        false => mesh.grouped(),
    };
    starts.map(start).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cost_the_same_whatever_the_items_cost() {
        let costs: Vec<f64> = (0..10_000).map(|k| if k < 1000 { 20.0 } else { 1.0 }).collect();
        let total: f64 = costs.iter().sum();
        for parts in [1, 2, 3, 7, 64] {
            let starts = equal_shares(costs.iter().copied(), parts);
            assert_eq!((starts.len(), starts[0], starts[parts]), (parts + 1, 0, costs.len()));
            for ends in starts.windows(2) {
                let part: f64 = costs[ends[0]..ends[1]].iter().sum();
                assert!((part - total / parts as f64).abs() <= 20.0, "{parts} parts: {part}");
            }
        }
    }

    #[test]
    fn more_parts_than_items_leave_some_parts_empty() {
        let starts = equal_shares([1.0, 1.0].into_iter(), 5);
        assert!(starts.is_sorted() && starts.len() == 6 && starts[5] == 2, "{starts:?}");
        assert_eq!(equal_shares([].into_iter(), 3), [0; 4]);
    }
}
