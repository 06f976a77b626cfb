//! The next mesh of a specimen: some of its triangles have become atoms.

use super::Mesh;
use super::element::Element;

impl Mesh {
    /// This mesh with some of its triangles, ascending, replaced by their atoms. It depends on nothing but this mesh and the
    /// list: not on how often and in which order triangles were replaced.
    pub fn refined(&self, triangles: &[u32]) -> Self {
        let (coarse, atoms) = self.elements.split_at(self.triangles);
        let mut listed = triangles.iter().peekable();
        let mut elements = Vec::with_capacity(self.elements.len());
        for (number, element) in (0..).zip(coarse) {
            if listed.next_if_eq(&&number).is_none() {
                elements.push(*element);
            }
        }
        let first_atom = elements.len();
        elements.extend_from_slice(atoms);
        let refined = triangles.iter().map(|&triangle| &coarse[triangle as usize]);
        elements.extend(refined.flat_map(Element::sites).map(Element::atom));
        elements[first_atom..].sort_unstable_by_key(|atom| (atom.row, atom.column));
        let mesh = Self::of(self.sites.clone(), elements, self.spacing, self.grip_rows);
        Self { cut: self.cut, ..mesh }
    }

    /// The numbers in this mesh of the triangles that are left when some, ascending, have become atoms: the first is that of
    /// triangle 0 of the [refined](Self::refined) mesh, and so on.
    pub fn left_by(&self, refined: &[u32]) -> Vec<u32> {
        let mut listed = refined.iter().peekable();
        let numbers = 0..self.triangles as u32;
        numbers.filter(|number| listed.next_if_eq(&number).is_none()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Plan;
    use crate::mesh::cut::Crack;
    use crate::mesh::sites::Layout;

    fn mesh() -> Mesh {
        Mesh::new(&Plan {
            layout: Layout {
                block: 10,
                rows: 6,
                triangles: 9,
            },
            element: 10,
            regions: vec![],
            crack: Some(Crack::of_length(20.0)),
            grip_rows: 10,
            spacing: 1.0,
        })
    }

    #[test]
    fn a_refined_mesh_holds_every_site_once_in_the_order_of_any_mesh() {
        let mesh = mesh();
        let refined = mesh.refined(&[3, 13, 14, 30]);
        assert_eq!(refined.triangles, mesh.triangles - 4);
        assert_eq!(refined.elements.len(), mesh.triangles - 4 + 4 * 55);
        let holds = |site: [i32; 2]| {
            refined
                .owner_of(site)
                .is_some_and(|owner| refined.elements[owner].contains(site))
        };
        assert!(refined.sites.iter().all(holds));
        let key = |e: &Element| (-e.size, e.lowest_row(), -e.sign, e.lowest_column());
        assert!(refined.elements.is_sorted_by_key(key));
        assert_eq!(refined.cut, mesh.cut);
        let left = mesh.left_by(&[3, 13, 14, 30]);
        let same = left
            .iter()
            .zip(&refined.elements)
            .all(|(&number, element)| mesh.elements[number as usize] == *element);
        assert!(same && left.len() == refined.triangles);
    }

    #[test]
    fn a_mesh_in_which_all_have_become_atoms_is_that_of_atoms() {
        let mesh = mesh();
        let all: Vec<u32> = (0..mesh.triangles as u32).collect();
        let refined = mesh.refined(&all);
        assert_eq!(refined.triangles, 0);
        assert_eq!(refined.elements.len(), mesh.sites.len());
        assert!(
            refined
                .elements
                .iter()
                .zip(mesh.sites.iter())
                .all(|(atom, site)| atom.contains(site))
        );
    }
}
