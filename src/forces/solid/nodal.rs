//! How many bonds a bond stands for where those of nodes stand for all: [Deng2011] Eq. (3-33).

use crate::forces::Summation;
use crate::mesh::solid::element::{Element, Shape};

/// How many sites a site of an element, given by its local coordinates, stands for: with [`Summation::Nodal`] a node for its
/// share of the element and any other for none.
pub fn site_weight(summation: Summation, element: Element, local: [i32; 3]) -> f64 {
    match summation {
        Summation::Nodal if element.corners().contains(&local) => element.lumped_mass(),
        Summation::Nodal => 0.0,
        Summation::Exact | Summation::Gauss { .. } | Summation::StrictGauss { .. } => 1.0,
    }
}

/// How many bonds a bond between two sites stands for that stand for so many: half of its energy belongs to either end.
#[inline(always)]
pub fn bond_count([one, other]: [f64; 2]) -> f64 {
    0.5 * (one + other)
}

/// The same of a site of the crystal all of which is in blocks of a size.
pub fn site_weight_in_blocks(summation: Summation, size: i32, site: [i32; 3]) -> f64 {
    let local = site.map(|component| component.rem_euclid(size));
    let parts = Shape::OF_BLOCK.map(|shape| Element::in_block(shape, size));
    let part = parts.into_iter().find(|part| part.has_local(local));
    part.map_or(1.0, |part| site_weight(summation, part, local))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_stand_for_all_sites_of_their_part() {
        // [Deng2011] Eq. (3-33).
        for shape in Shape::OF_BLOCK {
            for size in [3, 6, 10] {
                let part = Element::in_block(shape, size);
                let weights = part.locals().map(|local| site_weight(Summation::Nodal, part, local));
                assert!(
                    (weights.sum::<f64>() - part.site_count() as f64).abs() < 1e-9,
                    "{part:?}"
                );
                let exact = part.locals().map(|local| site_weight(Summation::Exact, part, local));
                assert_eq!(exact.sum::<f64>(), part.site_count() as f64);
            }
        }
        let atom = Element::atom([4, 5, 6]);
        assert_eq!(site_weight(Summation::Nodal, atom, [0; 3]), 1.0);
    }

    #[test]
    fn the_blocks_of_a_crystal_repeat() {
        let weight = |site| site_weight_in_blocks(Summation::Nodal, 10, site);
        assert_eq!(weight([0, 0, 0]), 165.0 / 4.0);
        assert_eq!(weight([-10, 10, 19]), 670.0 / 6.0);
        assert_eq!(weight([3, 3, 3]), 0.0);
    }
}
