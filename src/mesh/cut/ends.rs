//! Where a cut ends among the elements along the crack plane.
//!
//! In rows of triangles six elements meet at a corner: of each side two edges and, between them, the tip of a third
//! element, a single site. The corner is halfway between the two tips, on the bond that joins them.

use crate::lattice::triangular;
use crate::mesh::Mesh;

/// Where among the elements a notch is to end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WantedEnd {
    /// At a corner: the bond between the tips of two elements is the first that is not severed.
    Corner,
    /// In the middle of an edge, halfway between two corners.
    MidEdge,
}

/// Where among the elements a cut ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotchEnd {
    /// The bond between the tips of two elements is the first that is whole or the last that is severed.
    Corner,
    WithinEdge,
    /// Between atoms on either side.
    Atoms,
}

/// Tips on the two sides of a corner are half a spacing apart; where a corner meets an edge, or elements of unlike size
/// each other, there is no tip so near.
const OPPOSITE: f64 = 0.75;

/// Two bonds across the plane are this far apart, in spacings.
const BOND_TO_BOND: f64 = 0.5;

impl WantedEnd {
    /// The place of this kind nearest to a wanted one, lattice x in spacings: the wanted one itself at atoms, and where
    /// there is none.
    pub(super) fn nearest(self, mesh: &Mesh, wanted: f64) -> f64 {
        if is_among_atoms(mesh, wanted) {
            return wanted;
        }
        let corners = corners(mesh);
        let places = match self {
            Self::Corner => corners,
            Self::MidEdge => corners.windows(2).map(|ends| 0.5 * (ends[0] + ends[1])).collect(),
        };
        let rows = plane_rows(mesh).map(|row| mesh.sites.columns(row));
        let starts = plane_rows(mesh).map(|row| triangular::position([mesh.sites.columns(row).start, row])[0]);
        let first = starts[0].max(starts[1]);
        let last = first + f64::from(rows.map(|columns| columns.len()).into_iter().min().unwrap_or(0) as i32);
        // Some bonds are severed, and some are not.
        let inside = places.into_iter().filter(|x| (first + 1.0..last - 2.0).contains(x));
        let found = inside.min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs()));
        found.filter(|&x| !is_among_atoms(mesh, x)).unwrap_or(wanted)
    }
}

/// Where a cut that ends here, lattice x in spacings, and comes from the left (`way` 1) or from the right (-1), ends among
/// the elements.
pub(super) fn judge(mesh: &Mesh, end: f64, way: f64) -> NotchEnd {
    if is_among_atoms(mesh, end) {
        return NotchEnd::Atoms;
    }
    let is_near = |corner: &f64| {
        let past = way * (end - corner);
        -BOND_TO_BOND < past && past <= BOND_TO_BOND
    };
    if corners(mesh).iter().any(is_near) {
        NotchEnd::Corner
    } else {
        NotchEnd::WithinEdge
    }
}

/// Whether there are atoms on either side of a place, lattice x in spacings.
fn is_among_atoms(mesh: &Mesh, end: f64) -> bool {
    let is_atom = |row: i32| {
        let columns = mesh.sites.columns(row);
        let column = (end - 0.5 * f64::from(row)).round() as i32;
        let owner = mesh.owner_of([column.clamp(columns.start, columns.end - 1), row]);
        owner.is_none_or(|owner| mesh.elements[owner].is_atom())
    };
    plane_rows(mesh).into_iter().all(is_atom)
}

/// The lattice rows below and above the crack plane.
fn plane_rows(mesh: &Mesh) -> [i32; 2] {
    let middle = mesh.sites.middle_row();
    [middle - 1, middle]
}

/// The corners of triangles on the crack plane, lattice x in spacings, ascending.
fn corners(mesh: &Mesh) -> Vec<f64> {
    let [below, above] = plane_rows(mesh).map(|row| corners_beside(mesh, row));
    let opposite = |x: f64, others: &[f64]| others.iter().copied().find(|other| (other - x).abs() < OPPOSITE);
    let lone = below.iter().copied().filter(|&x| opposite(x, &above).is_none());
    let met = above
        .iter()
        .map(|&x| opposite(x, &below).map_or(x, |other| 0.5 * (x + other)));
    let mut corners: Vec<f64> = met.chain(lone).collect();
    corners.sort_unstable_by(f64::total_cmp);
    corners
}

/// The same on one side: the tips of triangles between two edges, and where edge meets edge.
fn corners_beside(mesh: &Mesh, row: i32) -> Vec<f64> {
    let owned = mesh.sites.columns(row).filter_map(|column| {
        let owner = mesh.owner_of([column, row])?;
        Some((triangular::position([column, row])[0], owner))
    });
    let owned: Vec<(f64, usize)> = owned.collect();
    // First and last site of each triangle's run.
    let runs: Vec<[f64; 2]> = owned
        .chunk_by(|a, b| a.1 == b.1)
        .filter(|run| run[0].1 < mesh.triangles)
        .map(|run| [run[0].0, run[run.len() - 1].0])
        .collect();
    let is_tip = |run: &[f64; 2]| run[0] == run[1];
    let follows = |a: &[f64; 2], b: &[f64; 2]| b[0] - a[1] == 1.0;
    let tips = runs
        .windows(3)
        .filter(|near| follows(&near[0], &near[1]) && follows(&near[1], &near[2]));
    let tips = tips.filter(|near| is_tip(&near[1])).map(|near| near[1][0]);
    let meet = runs
        .windows(2)
        .filter(|near| follows(&near[0], &near[1]) && !near.iter().any(is_tip));
    let mut corners: Vec<f64> = tips.chain(meet.map(|near| 0.5 * (near[0][1] + near[1][0]))).collect();
    corners.sort_unstable_by(f64::total_cmp);
    corners
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Plan;
    use crate::mesh::cut::{Crack, Cut};
    use crate::mesh::region::{Region, Shape};
    use crate::mesh::sites::Layout;

    fn mesh(size: i32, rows: i32, crack: Crack, regions: Vec<Region>) -> Mesh {
        Mesh::new(&Plan {
            layout: Layout {
                block: size,
                rows,
                triangles: 15,
            },
            element: size as u16,
            regions,
            crack: Some(crack),
            grip_rows: size,
            spacing: 1.0,
        })
    }

    fn ending(length: f64, end: WantedEnd) -> Crack {
        Crack {
            end: Some(end),
            ..Crack::of_length(length)
        }
    }

    /// Nearest-neighbour bonds across the crack plane by the place of their middle: whether severed, and their sites.
    fn bonds(mesh: &Mesh) -> Vec<(bool, [[i32; 2]; 2])> {
        let [below, above] = plane_rows(mesh);
        let upward = |column: i32| [[column, below], [column, above]];
        let leaning = |column: i32| [[column, below], [column - 1, above]];
        let all = mesh
            .sites
            .columns(below)
            .flat_map(|column| [leaning(column), upward(column)]);
        let there = all.filter(|bond| bond.iter().all(|&site| mesh.owner_of(site).is_some()));
        there.map(|bond| (mesh.severed(bond[0], bond[1]), bond)).collect()
    }

    #[test]
    fn a_notch_ends_on_the_bond_between_two_tips_or_halfway_and_severs_exactly_the_bonds_before() {
        for size in [3, 4, 5, 7, 10] {
            for length in [1.6, 2.0, 2.3, 2.8, 3.1].map(|cells| cells * f64::from(size + 1)) {
                let corner = mesh(size, 8, ending(length, WantedEnd::Corner), vec![]);
                let middle = mesh(size, 8, ending(length, WantedEnd::MidEdge), vec![]);
                let [at_corner, at_middle] = [&corner, &middle].map(|mesh| {
                    let bonds = bonds(mesh);
                    let severed = bonds.iter().take_while(|bond| bond.0).count();
                    assert!(bonds[severed..].iter().all(|bond| !bond.0), "from the left on");
                    (severed as i32, bonds[severed].1)
                });
                // Two bonds a spacing; the first corner comes after the edge of `size` sites, the next a site later each.
                assert_eq!((at_corner.0 - 2 * size) % (2 * (size + 1)), 0, "n = {size}, {length}");
                assert_eq!((at_middle.0 - (size - 1)) % (2 * (size + 1)), 0, "n = {size}, {length}");
                let tips = at_corner.1;
                let mut met: Vec<Option<usize>> = tips
                    .iter()
                    .flat_map(|&[column, row]| [-1, 0, 1].map(|step| corner.owner_of([column + step, row])))
                    .collect();
                met.sort_unstable();
                met.dedup();
                assert_eq!(met.len(), 6, "six elements meet");
                for (mesh, end) in [(&corner, NotchEnd::Corner), (&middle, NotchEnd::WithinEdge)] {
                    let cut = mesh.cut.unwrap();
                    assert_eq!(cut.end(mesh), end);
                    let moved = cut.to - mesh.sites.left() - length;
                    assert!(
                        moved.abs() <= 0.5 * f64::from(size + 1),
                        "the nearest: n = {size}, {moved}"
                    );
                }
            }
        }
    }

    #[test]
    fn rows_that_begin_with_an_inverted_element_have_corners_too_and_so_have_small_elements_in_large_blocks() {
        for (block, element, rows) in [(10, 10, 6), (10, 10, 7), (10, 5, 8), (10, 4, 6), (10, 7, 8)] {
            let plan = |end| Plan {
                layout: Layout {
                    block,
                    rows,
                    triangles: 15,
                },
                element,
                regions: vec![],
                crack: Some(ending(33.0, end)),
                grip_rows: block,
                spacing: 1.0,
            };
            let [corner, middle] = [WantedEnd::Corner, WantedEnd::MidEdge].map(|end| Mesh::new(&plan(end)));
            let end = |mesh: &Mesh| mesh.cut.unwrap().end(mesh);
            assert_eq!(end(&corner), NotchEnd::Corner, "{element} in {block}");
            if element == 10 {
                assert_eq!(end(&middle), NotchEnd::WithinEdge);
            }
        }
    }

    #[test]
    fn among_atoms_a_notch_is_as_long_as_given() {
        let band = Region {
            shape: Shape::Band { half_width: 3.0 },
            element: 1,
        };
        for end in [WantedEnd::Corner, WantedEnd::MidEdge] {
            let mesh = mesh(10, 8, ending(33.3, end), vec![band]);
            let cut = mesh.cut.unwrap();
            assert_eq!(cut.to, mesh.sites.left() + 33.3);
            assert_eq!(cut.end(&mesh), NotchEnd::Atoms);
        }
    }

    #[test]
    fn a_cut_is_judged_by_the_bonds_next_to_its_end() {
        let mesh = mesh(10, 8, ending(33.0, WantedEnd::Corner), vec![]);
        let cut = mesh.cut.unwrap();
        let ends = [-1.0, -0.4, 0.0, 0.4, 1.0].map(|off| {
            Cut {
                to: cut.to + off,
                ..cut
            }
            .end(&mesh)
        });
        let [corner, within] = [NotchEnd::Corner, NotchEnd::WithinEdge];
        assert_eq!(ends, [within, corner, corner, corner, within]);
    }
}
