//! Which nodes carry a site.

use super::Mesh;

impl Mesh {
    /// The element that carries a site, and its nodes with their weights N_i, [Deng2011] Eq. (3-27): the site stands at the sum
    /// of weight times place. `None` if the specimen does not hold it.
    pub fn carriers(&self, site: [i32; 2]) -> Option<(usize, Vec<(usize, f64)>)> {
        let number = self.owner_of(site)?;
        let element = &self.elements[number];
        let weights = element.shape_functions(element.local(site));
        Some((number, self.nodes_of(number).zip(weights).collect()))
    }
}

#[cfg(test)]
mod tests {
    use super::super::Plan;
    use super::super::sites::Layout;
    use super::*;

    /// Rounding of a sum of three products.
    const ROUNDING: f64 = 1e-12;

    #[test]
    fn a_site_stands_where_its_nodes_carry_it_as_of_eq_3_27() {
        for element in [1, 5] {
            let mesh = Mesh::new(&Plan {
                layout: Layout {
                    block: 5,
                    rows: 4,
                    triangles: 5,
                },
                element,
                regions: vec![],
                crack: None,
                grip_rows: 5,
                spacing: 0.25,
            });
            let places = mesh.node_positions();
            for site in mesh.sites.iter() {
                let (owner, carriers) = mesh.carriers(site).expect("the site is there");
                assert!(mesh.elements[owner].contains(site));
                for (axis, expected) in mesh.reference(site).into_iter().enumerate() {
                    let found: f64 = carriers.iter().map(|&(node, weight)| weight * places[axis][node]).sum();
                    assert!((found - expected).abs() < ROUNDING, "{site:?}: {found} for {expected}");
                }
            }
            assert_eq!(mesh.carriers([0, -1]), None);
        }
    }
}
