//! Where a mesh has elements smaller than asked for.

use crate::lattice::triangular;
use crate::mesh::element::Element;
use crate::mesh::{Mesh, Plan};

/// Shares of the sites that are in smaller elements than asked for, because no larger one fits there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Leftovers {
    pub grips: f64,
    pub left_face: f64,
    pub right_face: f64,
    /// Where the elements of a region meet coarser ones.
    pub regions: f64,
}

impl Leftovers {
    pub fn of(plan: &Plan, mesh: &Mesh) -> Self {
        let regions = plan.regions.iter().map(|region| i32::from(region.element));
        let wanted: Vec<i32> = regions.chain([i32::from(plan.element)]).collect();
        let mut found = Self::default();
        let share = 1.0 / mesh.sites.len() as f64;
        for element in mesh.elements.iter().filter(|element| !wanted.contains(&element.size)) {
            *found.place(plan, mesh, element) += share * element.site_count() as f64;
        }
        found
    }

    pub fn share(&self) -> f64 {
        self.by_share().iter().map(|(_, share)| share).sum()
    }

    /// Where they are, and the share of the sites that is there; the largest first.
    pub fn by_share(&self) -> Vec<(&'static str, f64)> {
        let mut places = vec![
            ("at the grips", self.grips),
            ("at the left face", self.left_face),
            ("at the right face", self.right_face),
            ("at the borders of regions", self.regions),
        ];
        places.retain(|(_, share)| *share > 0.0);
        places.sort_by(|a, b| b.1.total_cmp(&a.1));
        places
    }

    /// Where at least a tenth of them are; the largest share first.
    pub fn places(&self) -> Vec<&'static str> {
        const TENTH: f64 = 0.1;
        let least = TENTH * self.share();
        let there = self.by_share().into_iter().filter(|(_, share)| *share >= least);
        there.map(|(place, _)| place).collect()
    }

    /// The place that an element counts to: a face where a whole element has no room beside it, else the inner edge of a
    /// grip or the outer edge of the specimen, to which bands of rows are laid.
    fn place(&mut self, plan: &Plan, mesh: &Mesh, element: &Element) -> &mut f64 {
        let whole = i32::from(plan.element);
        let lowest = element.lowest_row();
        let columns = mesh.sites.columns(lowest);
        let ends = [columns.start, columns.end - 1].map(|column| triangular::position([column, lowest])[0]);
        let x = element.centre()[0];
        let room = f64::from(whole + 1);
        let outward = lowest.min(mesh.sites.rows() - lowest - element.size);
        if x - ends[0] < room {
            &mut self.left_face
        } else if ends[1] - x < room {
            &mut self.right_face
        } else if plan.regions.is_empty() || outward < plan.grip_rows + whole {
            &mut self.grips
        } else {
            &mut self.regions
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::sites::Layout;

    fn leftovers(element: u16, block: i32) -> Leftovers {
        let layout = Layout {
            block,
            rows: 12,
            triangles: 41,
        };
        let plan = Plan {
            layout,
            element,
            regions: vec![],
            crack: None,
            grip_rows: block,
            spacing: 0.25559,
        };
        Leftovers::of(&plan, &Mesh::new(&plan))
    }

    #[test]
    fn what_is_left_over_is_told_with_its_place() {
        assert_eq!(leftovers(10, 10).share(), 0.0);
        // Grips of ten rows of atoms and fifty between grip and plane: of size 4 two rows are left over at each of the four.
        let four = leftovers(4, 10);
        const ROWS_LEFT_OVER: f64 = 8.0 / 120.0;
        assert!((four.grips / ROWS_LEFT_OVER - 1.0).abs() < 0.1, "{four:?}");
        assert_eq!(four.by_share()[0].0, "at the grips");
        assert_eq!(four.regions, 0.0);
    }
}
