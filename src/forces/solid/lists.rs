//! Lists of the partners of points, those of as many points side by side as there may be lanes.

use std::ops::Range;

use crate::lanes::MOST;

/// For each group of [`MOST`] points their partners: first one of each, then the next of each, and so on.
#[derive(Clone, Debug, Default)]
pub struct Lists {
    of_group: Vec<Range<u32>>,
    partners: Vec<u32>,
}

impl Lists {
    /// One list a group.
    pub fn of(lists: &[Vec<u32>]) -> Self {
        let mut total = 0;
        let of_group = lists.iter().map(|list| {
            let start = total;
            total += list.len() as u32;
            start..total
        });
        Self {
            of_group: of_group.collect(),
            partners: lists.concat(),
        }
    }

    /// The partners of a group.
    #[inline(always)]
    pub fn of_group(&self, group: usize) -> &[u32] {
        let list = &self.of_group[group];
        &self.partners[list.start as usize..list.end as usize]
    }

    /// Puts another list in place of that of a group.
    pub fn replace(&mut self, group: usize, list: &[u32]) {
        let start = self.partners.len() as u32;
        self.partners.extend(list);
        self.of_group[group] = start..self.partners.len() as u32;
    }
}

/// Adds the partners of one point of a group to the list of the group, in which `nobody` fills what other points leave free.
pub fn add(list: &mut Vec<u32>, lane: usize, partners: &[u32], nobody: u32) {
    if list.len() < partners.len() * MOST {
        list.resize(partners.len() * MOST, nobody);
    }
    let slots = partners.iter().enumerate();
    slots.for_each(|(slot, &partner)| list[slot * MOST + lane] = partner);
}
