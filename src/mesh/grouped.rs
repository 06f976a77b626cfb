//! What meshes of all dimensions have in common.

use std::ops::Range;

/// How a mesh of any dimension numbers its elements: first those in groups of alike ones, then the atoms.
///
/// The nodes of a group follow each other, first corner by first corner, then the second corners, and so on; the groups'
/// nodes follow each other as the groups do, and those of atoms come last.
pub trait Grouped {
    fn element_count(&self) -> usize;
    fn node_count(&self) -> usize;
    /// How many elements are in groups.
    fn grouped(&self) -> usize;
    /// The place of the group of an element among all groups.
    fn group_number(&self, element: usize) -> usize;
    fn group_count(&self) -> usize;
    /// The elements and the nodes of a group.
    fn group(&self, number: usize) -> [Range<usize>; 2];

    /// Where the nodes of elements from a number on begin that starts a group or the atoms.
    fn first_node(&self, element: usize) -> usize {
        match element < self.grouped() {
            true => self.group(self.group_number(element))[1].start,
            false => self.node_count() - (self.element_count() - element),
        }
    }

    /// The nodes of consecutive elements, all in groups or all atoms: corner by corner of each group.
    fn nodes_of_range(&self, elements: &Range<usize>) -> Vec<Range<usize>> {
        if elements.start >= self.grouped() {
            let first = self.first_node(elements.start);
            return std::iter::once(first..first + elements.len()).collect();
        }
        let groups = self.group_number(elements.start)..=self.group_number(elements.end - 1);
        let of_group = |number: usize| {
            let [all, nodes] = self.group(number);
            let part = elements.start.max(all.start) - all.start..elements.end.min(all.end) - all.start;
            let corners = nodes.step_by(all.len());
            corners.map(move |first| first + part.start..first + part.end)
        };
        groups.flat_map(of_group).collect()
    }
}
