//! Specimens: which lattice sites there are, which element carries each, and which elements are neighbours.
//!
//! A mesh knows no forces. Elements share no nodes: triangles come first, then the atoms. [`groups`] tells how nodes are numbered.

mod carriers;
pub mod cut;
pub mod element;
pub mod grouped;
pub mod groups;
pub mod interfaces;
mod owners;
mod refined;
pub mod region;
pub mod sites;
pub mod solid;
mod tiling;

use std::collections::HashMap;
use std::ops::Range;

use crate::lattice::triangular;
use cut::{Crack, Cut};
use element::Element;
use grouped::{Grouped, MassCoupling};
use groups::Groups;
use owners::Owners;
use region::Region;
use sites::{Layout, SiteSet};

/// What a mesh is made from. Lengths in units of the lattice spacing unless said otherwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub layout: Layout,
    /// Atoms an edge of the elements outside the regions.
    pub element: u16,
    /// Regions, in nm.
    pub regions: Vec<Region>,
    /// A crack next to mid-height.
    pub crack: Option<Crack>,
    /// Lattice rows of each grip, at the bottom and at the top.
    pub grip_rows: i32,
    /// Lattice spacing, nm.
    pub spacing: f64,
}

impl Plan {
    /// Height between the grips, from the highest row of the lower to the lowest of the upper one, nm.
    pub fn height_between_grips(&self) -> f64 {
        let rows = self.layout.lattice_rows() - 2 * self.grip_rows + 1;
        f64::from(rows) * triangular::ROW_HEIGHT * self.spacing
    }
}

/// Elements, nodes and sites of a specimen in its reference state.
#[derive(Clone, Debug)]
pub struct Mesh {
    pub sites: SiteSet,
    /// Triangles by falling size and from bottom to top, in every row upright ones before inverted ones; then the atoms.
    pub elements: Vec<Element>,
    /// Number of triangles among the elements.
    pub triangles: usize,
    pub groups: Groups,
    owners: Owners,
    pub cut: Option<Cut>,
    /// Lattice spacing, nm.
    pub spacing: f64,
    /// Lattice rows of each grip.
    pub grip_rows: i32,
}

impl Mesh {
    pub fn new(plan: &Plan) -> Self {
        let sites = SiteSet::new(plan.layout);
        let middle = sites.middle_row();
        let mut breaks = vec![0, plan.grip_rows, middle, sites.rows() - plan.grip_rows, sites.rows()];
        breaks.sort_unstable();
        breaks.dedup();
        let elements = tiling::tile(&sites, region::target_sizes(plan, &sites), &breaks);
        Self::of(sites, elements, plan.spacing, plan.grip_rows).with_crack(plan.crack)
    }

    /// The mesh of elements that hold every site once, in their order, without a crack.
    fn of(sites: SiteSet, elements: Vec<Element>, spacing: f64, grip_rows: i32) -> Self {
        let triangles = elements.iter().take_while(|element| !element.is_atom()).count();
        let groups = Groups::new(&elements[..triangles]);
        Self {
            owners: Owners::new(sites.rows(), &elements, &groups),
            groups,
            sites,
            elements,
            triangles,
            cut: None,
            spacing,
            grip_rows,
        }
    }

    /// The same elements with this crack: none of them minds it.
    pub fn with_crack(mut self, crack: Option<Crack>) -> Self {
        self.cut = crack.map(|crack| crack.cut(&self));
        self
    }

    pub fn node_count(&self) -> usize {
        2 * self.triangles + self.elements.len()
    }

    /// Number of the node at a corner of an element; an atom is its only one.
    #[inline(always)]
    pub fn node(&self, element: usize, corner: usize) -> usize {
        if element < self.triangles {
            self.groups.of(element).node(element, corner)
        } else {
            2 * self.triangles + element
        }
    }

    /// Numbers of an element's nodes, corner by corner.
    pub fn nodes_of(&self, element: usize) -> impl Iterator<Item = usize> + Clone + use<> {
        let first = self.node(element, 0);
        let (count, step) = match element < self.triangles {
            true => (3, self.groups.of(element).len()),
            false => (1, 1),
        };
        (0..count).map(move |corner| first + corner * step)
    }

    /// Numbers of a triangle's nodes.
    #[inline(always)]
    pub fn corners_of(&self, triangle: usize) -> [usize; 3] {
        let group = self.groups.of(triangle);
        [0, 1, 2].map(|corner| group.node(triangle, corner))
    }

    /// The element that a node belongs to.
    pub fn element_of_node(&self, node: usize) -> usize {
        match node.checked_sub(3 * self.triangles) {
            None => self.groups.triangle_of_node(node),
            Some(atom) => self.triangles + atom,
        }
    }

    /// Reference position of a site, nm, in lattice coordinates.
    pub fn reference(&self, site: [i32; 2]) -> [f64; 2] {
        triangular::position(site).map(|component| component * self.spacing)
    }

    /// Reference positions of the nodes, x and y, nm.
    pub fn node_positions(&self) -> [Vec<f64>; 2] {
        self.node_positions_of(std::slice::from_ref(&(0..self.elements.len())))
    }

    /// The same of the nodes of some ranges of elements; the others are untouched zeros, which take no memory.
    pub fn node_positions_of(&self, elements: &[Range<usize>]) -> [Vec<f64>; 2] {
        let [mut x, mut y] = [0, 1].map(|_| vec![0.0; self.node_count()]);
        for number in elements.iter().cloned().flatten() {
            for (node, corner) in self.nodes_of(number).zip(self.elements[number].corners()) {
                [x[node], y[node]] = self.reference(corner);
            }
        }
        [x, y]
    }

    /// Reference position of a node, nm, in lattice coordinates.
    pub fn node_position(&self, node: usize) -> [f64; 2] {
        let element = self.element_of_node(node);
        let mut corners = self.nodes_of(element).zip(self.elements[element].corners());
        let own = corners.find(|(other, _)| *other == node);
        own.map_or([f64::NAN; 2], |(_, corner)| self.reference(corner))
    }

    /// Largest coordinate of a node in its reference position, nm.
    pub fn farthest(&self) -> f64 {
        let corners = self.elements.iter().flat_map(Element::corners);
        let places = corners.flat_map(|corner| self.reference(corner));
        places.fold(0.0, |most, place| most.max(place.abs()))
    }

    /// Lumped mass of every node in site masses.
    pub fn lumped_masses(&self) -> Vec<f64> {
        grouped::masses_of(self, std::slice::from_ref(&(0..self.elements.len())))
    }

    /// The element that carries a site; `None` where there is none.
    #[inline(always)]
    pub fn owner_of(&self, site: [i32; 2]) -> Option<usize> {
        self.owners.of(site)
    }

    /// The same, quickly where it is the element that is guessed.
    #[inline(always)]
    pub fn owner_beside(&self, site: [i32; 2], guess: Option<usize>) -> Option<usize> {
        guess
            .filter(|&element| self.elements[element].contains(site))
            .or_else(|| self.owner_of(site))
    }

    /// Whether the pair of sites never bonds because its line crosses a cut.
    #[inline(always)]
    pub fn severed(&self, a: [i32; 2], b: [i32; 2]) -> bool {
        self.cut.is_some_and(|cut| cut.severs(a, b))
    }

    /// y of the crack plane, or of mid-height where there is no crack, nm.
    pub fn middle_height(&self) -> f64 {
        (f64::from(self.sites.middle_row()) - 0.5) * triangular::ROW_HEIGHT * self.spacing
    }

    /// y of the inner edges of the grips, nm.
    pub fn grip_edges(&self) -> [f64; 2] {
        let rows = [self.grip_rows - 1, self.sites.rows() - self.grip_rows];
        rows.map(|row| f64::from(row) * triangular::ROW_HEIGHT * self.spacing)
    }

    /// -1, 0 or 1: in the lower grip, between the grips, in the upper one.
    pub fn grip_of(&self, element: &Element) -> i32 {
        if element.row < self.grip_rows {
            -1
        } else if element.row >= self.sites.rows() - self.grip_rows {
            1
        } else {
            0
        }
    }
}

impl Grouped for Mesh {
    fn element_count(&self) -> usize {
        self.elements.len()
    }

    fn node_count(&self) -> usize {
        Self::node_count(self)
    }

    fn grouped(&self) -> usize {
        self.triangles
    }

    fn group_number(&self, element: usize) -> usize {
        self.groups.number_of(element)
    }

    fn group_count(&self) -> usize {
        self.groups.all().len()
    }

    fn group(&self, number: usize) -> [Range<usize>; 2] {
        let group = &self.groups.all()[number];
        [group.elements.clone(), group.nodes()]
    }

    fn lumped_mass(&self, element: usize) -> f64 {
        self.elements[element].lumped_mass()
    }

    fn mass_couplings(&self) -> Vec<MassCoupling> {
        let mut of_size: HashMap<i32, f64> = HashMap::new();
        let coupling = self.groups.all().iter().map(|group| {
            let element = &self.elements[group.elements.start];
            MassCoupling::even(3, *of_size.entry(group.size).or_insert_with(|| element.mass_coupling()))
        });
        coupling.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::region::Shape;
    use super::*;

    fn plan(layout: Layout, element: u16) -> Plan {
        Plan {
            layout,
            element,
            regions: vec![],
            crack: None,
            grip_rows: layout.block,
            spacing: 0.25559,
        }
    }

    fn check_cover(mesh: &Mesh) {
        let holds = |site: [i32; 2]| {
            mesh.owner_of(site)
                .is_some_and(|owner| mesh.elements[owner].contains(site))
        };
        assert!(mesh.sites.iter().all(holds), "every site is in its element");
        let held: usize = mesh.elements.iter().map(Element::site_count).sum();
        assert_eq!(held, mesh.sites.len(), "and only one");
    }

    #[test]
    fn table_5_1_counts_come_out_exactly() {
        // [Deng2011] Table 5-1, and the 32,060 elements of cases 1 and 2; length and width in nm.
        let rows = [
            ("A", 1127.0, 354.0, 128_160, 384_480, 7_048_800),
            ("D", 566.0, 354.0, 64_160, 192_480, 3_528_800),
            ("E", 1127.0, 708.0, 256_320, 768_960, 14_097_600),
        ];
        let spacing = 2f64.powf(1.0 / 6.0) * 0.2277;
        for (model, length, width, elements, nodes, atoms) in rows {
            let layout = Layout::nearest(length / spacing, width / spacing, 10);
            let mesh = Mesh::new(&Plan {
                spacing,
                ..plan(layout, 10)
            });
            assert_eq!(mesh.elements.len(), elements, "model {model}");
            assert_eq!(mesh.node_count(), nodes, "model {model}");
            assert_eq!(mesh.sites.len(), atoms, "model {model}");
            check_cover(&mesh);
        }
        let case_1 = Layout {
            block: 10,
            rows: 140,
            triangles: 229,
        };
        assert_eq!(Mesh::new(&plan(case_1, 10)).elements.len(), 32_060);
    }

    #[test]
    fn any_element_size_covers_the_same_sites_and_leaves_few_over() {
        let layout = Layout {
            block: 10,
            rows: 12,
            triangles: 41,
        };
        for element in [1, 3, 4, 7, 13, 20, 40] {
            let mesh = Mesh::new(&plan(layout, element));
            check_cover(&mesh);
            assert_eq!(mesh.sites.len() as u64, layout.site_count());
            assert!(mesh.elements.iter().all(|e| e.size <= i32::from(element)));
        }
        let uniform = Mesh::new(&plan(layout, 10));
        assert_eq!(uniform.triangles, 12 * 41);
    }

    #[test]
    fn regions_are_at_least_as_fine_as_asked_and_mix_freely() {
        let layout = Layout {
            block: 10,
            rows: 12,
            triangles: 41,
        };
        let band = Region {
            shape: Shape::Band { half_width: 3.0 },
            element: 1,
        };
        let disc = Region {
            shape: Shape::Disc {
                center: [40.0, 8.0],
                radius: 4.0,
            },
            element: 4,
        };
        let boxed = Region {
            shape: Shape::Box {
                from: [5.0, -12.0],
                to: [9.0, -9.0],
            },
            element: 5,
        };
        let mesh = Mesh::new(&Plan {
            regions: vec![band, disc, boxed],
            ..plan(layout, 10)
        });
        check_cover(&mesh);
        let left = mesh.sites.left() * mesh.spacing;
        for element in &mesh.elements {
            for site in element.sites() {
                let [x, y] = mesh.reference(site);
                let place = [x - left, y - mesh.middle_height()];
                for region in [band, disc, boxed] {
                    assert!(!region.shape.contains(place) || element.size <= i32::from(region.element));
                }
            }
        }
        let sizes: std::collections::BTreeSet<i32> = mesh.elements.iter().map(|element| element.size).collect();
        assert!([1, 4, 5, 10].iter().all(|size| sizes.contains(size)), "{sizes:?}");
    }

    #[test]
    fn no_element_crosses_the_crack_plane_or_a_grip() {
        let layout = Layout {
            block: 10,
            rows: 9,
            triangles: 21,
        };
        for element in [7, 10, 20] {
            let mesh = Mesh::new(&plan(layout, element));
            for boundary in [10, 40, 80] {
                let astride = |e: &Element| e.sites().any(|s| s[1] < boundary) && e.sites().any(|s| s[1] >= boundary);
                assert!(
                    !mesh.elements.iter().any(astride),
                    "element {element}, boundary {boundary}"
                );
            }
        }
    }
}
