//! Where a finer element is wanted than elsewhere.

use super::Plan;
use super::sites::SiteSet;
use super::tiling::Target;
use crate::lattice::triangular;

/// Part of a specimen, x from its left edge and y from the crack plane, nm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Band { half_width: f64 },
    Box { from: [f64; 2], to: [f64; 2] },
    Disc { center: [f64; 2], radius: f64 },
}

/// A region and the largest element allowed in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Region {
    pub shape: Shape,
    pub element: u16,
}

impl Shape {
    pub fn contains(&self, [x, y]: [f64; 2]) -> bool {
        match *self {
            Self::Band { half_width } => y.abs() <= half_width,
            Self::Box { from, to } => (from[0]..=to[0]).contains(&x) && (from[1]..=to[1]).contains(&y),
            Self::Disc { center, radius } => (x - center[0]).hypot(y - center[1]) <= radius,
        }
    }
}

/// The largest element size allowed at every site.
pub(super) fn target_sizes(plan: &Plan, sites: &SiteSet) -> Target {
    if plan.regions.is_empty() {
        return Target::Everywhere(plan.element);
    }
    let left = sites.left();
    let middle = (f64::from(sites.middle_row()) - 0.5) * triangular::ROW_HEIGHT;
    let size = |site: [i32; 2]| {
        let [x, y] = triangular::position(site);
        let place = [(x - left) * plan.spacing, (y - middle) * plan.spacing];
        let finer = plan
            .regions
            .iter()
            .filter(|region| region.shape.contains(place))
            .map(|region| region.element);
        finer
            .chain([plan.element])
            .min()
            .expect("the specimen's own size is there")
    };
    Target::Each(sites.iter().map(size).collect())
}
