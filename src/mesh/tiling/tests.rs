use super::*;
use crate::mesh::region::{Region, Shape};
use crate::mesh::sites::Layout;
use crate::mesh::{Mesh, Plan};

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

#[test]
fn elements_beside_the_crack_plane_are_of_the_size_asked_for() {
    let band = |element| Region {
        shape: Shape::Band { half_width: 6.0 },
        element,
    };
    for (element, block) in (3..=20)
        .chain([40])
        .flat_map(|element| [4, 5, 10].map(|block| (element, block)))
    {
        let layout = Layout {
            block,
            // Room for two rows of elements on either side of the crack plane, and an odd number of blocks below it.
            rows: 2 * (2 * i32::from(element) / block + 2) + 3,
            triangles: 61,
        };
        let uniform = plan(layout, element);
        let mixed = Plan {
            element: 2 * element,
            regions: vec![band(element)],
            ..uniform.clone()
        };
        for plan in [uniform, mixed] {
            let mesh = Mesh::new(&plan);
            let held: usize = mesh.elements.iter().map(Element::site_count).sum();
            assert_eq!(held, mesh.sites.len());
            let middle = mesh.sites.middle_row();
            for row in [middle - 1, middle] {
                let columns = mesh.sites.columns(row);
                // Where a whole element has no room before the end of the row.
                let inner = columns.start + i32::from(element)..columns.end - i32::from(element) - 1;
                assert!(!inner.is_empty());
                for column in inner {
                    let owner = mesh.owner_of([column, row]).unwrap();
                    assert_eq!(
                        mesh.elements[owner].size,
                        i32::from(element),
                        "block {block}, row {row}"
                    );
                }
            }
        }
    }
}

#[test]
fn grips_are_whole_rows_and_keep_what_is_left_over_at_their_far_end() {
    let layout = Layout {
        block: 10,
        rows: 12,
        triangles: 41,
    };
    let mesh = Mesh::new(&plan(layout, 4));
    // Ten rows of atoms in a grip: two rows of elements at its inner edge, and two rows of atoms outside.
    for row in [2, 9, 110, 117] {
        let columns = mesh.sites.columns(row);
        for column in columns.start + 10..columns.end - 10 {
            let owner = mesh.owner_of([column, row]).unwrap();
            assert_eq!(mesh.elements[owner].size, 4, "row {row}");
        }
    }
}
