//! Types of atoms that tell LAMMPS which pairs a cut severs.
//!
//! Whether a pair is severed depends on both of its sites; LAMMPS asks their types only. Beside the cut one type below
//! and one above say enough: a line from one to the other crosses it. At its ends lines from beside the cut to ahead
//! of it may cross or miss it, so the sites of those pairs where that rule fails get types of their own.

use std::collections::BTreeSet;

use crate::lattice::triangular;
use crate::mesh::Mesh;
use crate::mesh::cut::Cut;

/// The type of every atom, and which pairs of types are severed.
#[derive(Clone, Debug, PartialEq)]
pub struct AtomTypes {
    /// Type of every site, from 1.
    pub of_site: Vec<u32>,
    pub count: u32,
    /// Pairs of types, the lower one first.
    pub severed: Vec<[u32; 2]>,
    /// The types are exact for pairs of sites that stand no further apart in the lattice, in spacings.
    pub reach: f64,
}

const AWAY: u32 = 1;
const BELOW: u32 = 2;
const ABOVE: u32 = 3;

/// Pairs this much longer than the cutoff in the perfect lattice, in spacings, are still typed exactly, whatever brings
/// them within the cutoff later.
const BEYOND_CUTOFF: f64 = 2.0;

impl AtomTypes {
    /// One type for each set of groups that an atom belongs to, where no pair is severed; type 1 is that of none. Also the
    /// types of the members of each group.
    pub fn of_groups(atoms: usize, groups: &[Vec<u32>]) -> (Self, Vec<Vec<u32>>) {
        let mut memberships = vec![Vec::new(); atoms];
        for (group, members) in groups.iter().enumerate() {
            members.iter().for_each(|&atom| memberships[atom as usize].push(group));
        }
        let sets: BTreeSet<&Vec<usize>> = memberships.iter().filter(|set| !set.is_empty()).collect();
        let sets: Vec<&Vec<usize>> = sets.into_iter().collect();
        let kind = |set: &Vec<usize>| sets.binary_search(&set).map_or(AWAY, |place| AWAY + 1 + place as u32);
        let types_of = |group: usize| {
            let own = sets.iter().filter(|set| set.contains(&group));
            own.map(|&set| kind(set)).collect()
        };
        let types = Self {
            of_site: memberships.iter().map(kind).collect(),
            count: AWAY + sets.len() as u32,
            severed: vec![],
            reach: f64::INFINITY,
        };
        (types, (0..groups.len()).map(types_of).collect())
    }

    /// The types for a cutoff in spacings.
    pub fn new(mesh: &Mesh, cutoff: f64) -> Self {
        let reach = cutoff + BEYOND_CUTOFF;
        let Some(cut) = mesh.cut else {
            return Self {
                of_site: vec![AWAY; mesh.sites.len()],
                count: 1,
                severed: vec![],
                reach,
            };
        };
        let beside = |site: [i32; 2]| match (is_beside(&cut, site), site[1] < cut.row) {
            (false, _) => AWAY,
            (true, true) => BELOW,
            (true, false) => ABOVE,
        };
        let mut of_site: Vec<u32> = mesh.sites.iter().map(beside).collect();
        let mut severed = vec![[BELOW, ABOVE]];
        let mut count = ABOVE;
        let tips = sites_at_tips(mesh, &cut, reach);
        let groups = [true, false].map(|below| groups(&cut, &tips, below));
        for (group, other) in groups.iter().zip([ABOVE, BELOW]) {
            for sites in group {
                count += 1;
                if is_beside(&cut, sites[0]) {
                    severed.push([other, count]);
                }
                for &site in sites {
                    of_site[mesh.sites.index(site).expect("it is a site of the mesh")] = count;
                }
            }
        }
        let below_from = ABOVE + 1;
        let above_from = below_from + groups[0].len() as u32;
        for (low, a) in (below_from..).zip(&groups[0]) {
            for (high, b) in (above_from..).zip(&groups[1]) {
                if cut.severs(a[0], b[0]) {
                    severed.push([low, high]);
                }
            }
        }
        Self {
            of_site,
            count,
            severed,
            reach,
        }
    }
}

/// Whether a site stands straight below or above the cut.
fn is_beside(cut: &Cut, site: [i32; 2]) -> bool {
    (cut.from..cut.to).contains(&triangular::position(site)[0])
}

/// Sites of the pairs within reach that are severed though not both stand beside the cut, or the other way round.
fn sites_at_tips(mesh: &Mesh, cut: &Cut, reach: f64) -> BTreeSet<[i32; 2]> {
    let vectors = triangular::half_vectors_within(reach);
    let depth = (reach / triangular::ROW_HEIGHT).ceil() as i32;
    let mut found = BTreeSet::new();
    for row in (cut.row - depth).max(0)..cut.row {
        for site in mesh.sites.columns(row).map(|column| [column, row]) {
            for vector in &vectors {
                let other = [site[0] + vector[0], site[1] + vector[1]];
                if other[1] < cut.row || mesh.sites.index(other).is_none() {
                    continue;
                }
                if cut.severs(site, other) != (is_beside(cut, site) && is_beside(cut, other)) {
                    found.extend([site, other]);
                }
            }
        }
    }
    found
}

/// The sites at the tips on one side of the cut, those together that are severed from the same sites.
fn groups(cut: &Cut, tips: &BTreeSet<[i32; 2]>, below: bool) -> Vec<Vec<[i32; 2]>> {
    let (own, others): (Vec<[i32; 2]>, Vec<[i32; 2]>) = tips.iter().partition(|site| (site[1] < cut.row) == below);
    let mut groups: Vec<(Vec<bool>, Vec<[i32; 2]>)> = Vec::new();
    for site in own {
        let severed = others.iter().map(|&other| cut.severs(site, other));
        let key: Vec<bool> = severed.chain([is_beside(cut, site)]).collect();
        match groups.iter_mut().find(|group| group.0 == key) {
            Some(group) => group.1.push(site),
            None => groups.push((key, vec![site])),
        }
    }
    groups.into_iter().map(|group| group.1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Plan;
    use crate::mesh::cut::{Crack, Side};
    use crate::mesh::sites::Layout;

    fn mesh(crack: Option<Crack>) -> Mesh {
        let layout = Layout {
            block: 6,
            rows: 4,
            triangles: 7,
        };
        Mesh::new(&Plan {
            layout,
            element: 1,
            regions: vec![],
            crack,
            grip_rows: 6,
            spacing: 1.0,
        })
    }

    #[test]
    fn types_sever_the_pairs_that_the_cut_severs_and_no_others() {
        let lengths = [(11.0, 1.33), (11.3, 1.33), (11.6, 1.7), (12.0, 2.5)];
        let sides = [Side::Left, Side::Right, Side::Inside { center: 13.2 }];
        for (side, (length, cutoff)) in sides.into_iter().flat_map(|side| lengths.map(|length| (side, length))) {
            let crack = Crack {
                side,
                ..Crack::of_length(length)
            };
            let mesh = mesh(Some(crack));
            let types = AtomTypes::new(&mesh, cutoff);
            let sites: Vec<[i32; 2]> = mesh.sites.iter().collect();
            let mut severed = 0;
            for (a, &first) in sites.iter().enumerate() {
                for vector in triangular::vectors_within(types.reach) {
                    let second = [first[0] + vector[0], first[1] + vector[1]];
                    let Some(b) = mesh.sites.index(second) else { continue };
                    let pair = [types.of_site[a], types.of_site[b]];
                    let pair = [pair[0].min(pair[1]), pair[0].max(pair[1])];
                    assert_eq!(types.severed.contains(&pair), mesh.severed(first, second));
                    severed += usize::from(mesh.severed(first, second));
                }
            }
            assert!(severed > 100 && types.of_site.iter().all(|&kind| (1..=types.count).contains(&kind)));
        }
    }

    #[test]
    fn atoms_of_the_same_groups_have_the_same_type_and_a_group_knows_its_types() {
        let (types, of_groups) = AtomTypes::of_groups(6, &[vec![0, 1, 2], vec![2, 3], vec![]]);
        assert_eq!((types.count, types.of_site), (4, vec![2, 2, 3, 4, 1, 1]));
        assert_eq!(of_groups, [vec![2, 3], vec![3, 4], vec![]]);
    }

    #[test]
    fn without_a_cut_there_is_one_type() {
        let types = AtomTypes::new(&mesh(None), 1.5);
        assert!(types.count == 1 && types.severed.is_empty() && types.of_site.iter().all(|&kind| kind == 1));
    }
}
