//! Who computes what: a specimen cut into domains, one a rank, and what ranks tell each other.
//!
//! Every rank knows the whole mesh. It computes the forces on its own elements, moves their nodes, and keeps the
//! positions of those nodes and of its halo, the nodes that its forces depend on, up to date. Elements are numbered row
//! by row, so a domain is a range of the elements in groups and a range of the atoms.

#[cfg(not(feature = "mpi"))]
mod alone;
mod cut;
mod halo;
mod messages;
#[cfg(feature = "mpi")]
mod mpi;
mod planes;
mod processor;
mod sums;

#[cfg(not(feature = "mpi"))]
pub use alone::{Ranks, Session, library, start};
pub use halo::{Halo, Of};
pub use messages::MessageCost;
#[cfg(feature = "mpi")]
pub use mpi::{Ranks, Session, library, start};

use std::ops::Range;

use crate::mesh::grouped::Grouped;

/// Why the ranks cannot work together.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DomainError {
    #[error(
        "{0} ranks were started, but this cgaft-solve was built without MPI; build one with `make build`, or start it \
         without mpirun"
    )]
    WithoutMpi(u32),
    #[error(
        "{ranks} ranks were started, and each believes to be alone: cgaft-solve was built with {library}, and this mpirun \
         belongs to another MPI; use the mpirun of {library}, or build cgaft-solve again with the other one"
    )]
    OtherMpi { ranks: u32, library: String },
    #[error("MPI does not let threads call it in turn; use an MPI library with MPI_THREAD_SERIALIZED")]
    NoThreads,
}

/// How many ranks an mpirun says that it has started; `None` where there is none.
fn mpirun_ranks() -> Option<u32> {
    let number = |name: &str| std::env::var(name).ok()?.parse().ok();
    // Slurm's own launcher tells the rank by PMIx, and how many there are by a variable of its own.
    let by_slurm = std::env::var_os("PMIX_RANK").and_then(|_| number("SLURM_STEP_NUM_TASKS"));
    let told = [number("OMPI_COMM_WORLD_SIZE"), number("PMI_SIZE"), by_slurm];
    told.into_iter().flatten().max()
}

/// What a rank tells all others when they next agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Call {
    /// An interface is no longer what it was.
    InterfaceChanged = 1,
    /// A list of neighbours has to be made anew.
    ListOutdated = 2,
    /// Somebody asks to stop.
    Stop = 4,
    /// It is time for a checkpoint.
    Checkpoint = 8,
}

/// The bit of the lowest level; those of the calls are before it.
const FIRST_LEVEL: u32 = 4;

/// What falls to the busiest of so many ranks in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Burden {
    pub ranks: u32,
    /// Its part of all elements in groups by their cost, or of all atoms where that is more; 1 for one rank.
    pub work: f64,
    /// Ranks that it hears from.
    pub messages: u32,
    /// What they send it.
    pub bytes: u64,
}

/// The part of a specimen that this rank computes, and those of the others.
#[derive(Clone, Debug)]
pub struct Domain {
    ranks: Ranks,
    /// Whose domain it is.
    rank: usize,
    /// Where every rank's elements in groups start, and their number at the end.
    grouped: Vec<usize>,
    /// The same for their nodes.
    nodes: Vec<usize>,
    /// The same for the atoms, which are counted from 0.
    atoms: Vec<usize>,
    /// Calls of this rank that the others have not heard yet, and what has been heard of any.
    called: u64,
    heard: u64,
}

impl Domain {
    /// Cuts a mesh so that all ranks have equal shares of the costs of its elements in groups and of those of its atoms.
    pub fn new(ranks: Ranks, mesh: &impl Grouped, cost: impl Fn(usize) -> f64 + Copy) -> Self {
        Self::part(ranks, [ranks.rank(), ranks.count()], mesh, cost)
    }

    /// The parts of all of so many ranks, whoever computes them.
    pub fn parts(count: usize, mesh: &impl Grouped, cost: impl Fn(usize) -> f64 + Copy) -> impl Iterator<Item = Self> {
        let first = Self::part(Ranks::alone(), [0, count], mesh, cost);
        (0..count).map(move |rank| Self { rank, ..first.clone() })
    }

    /// The part of one of so many ranks.
    fn part(ranks: Ranks, [rank, count]: [usize; 2], mesh: &impl Grouped, cost: impl Fn(usize) -> f64 + Copy) -> Self {
        let [grouped, elements] = [mesh.grouped(), mesh.element_count()];
        let starts = cut::equal_shares_of_groups(mesh, (0..grouped).map(cost), count);
        Self {
            ranks,
            rank,
            nodes: nodes_at(mesh, &starts),
            grouped: starts,
            atoms: cut::equal_shares((grouped..elements).map(cost), count),
            called: 0,
            heard: 0,
        }
    }

    /// Cuts anew, from what every rank's elements in groups and atoms have cost: an element costs what it was thought to, times how far
    /// its rank was off. Nobody knows the numbers of another rank's nodes before they have been shared.
    pub fn cut_anew(&mut self, mesh: &impl Grouped, cost: impl Fn(usize) -> f64 + Copy, spent: [&[f64]; 2]) {
        let count = self.grouped.len() - 1;
        let costs = |starts: &[usize], first: usize, spent: &[f64]| -> Vec<f64> {
            let costs = starts.windows(2).zip(spent).flat_map(|(ends, &spent)| {
                let elements = first + ends[0]..first + ends[1];
                let thought: f64 = elements.clone().map(cost).sum();
                elements.map(move |element| cost(element) * spent / thought)
            });
            costs.collect()
        };
        let of_groups = costs(&self.grouped, 0, spent[0]);
        let of_atoms = costs(&self.atoms, mesh.grouped(), spent[1]);
        self.grouped = cut::equal_shares_of_groups(mesh, of_groups.into_iter(), count);
        self.nodes = nodes_at(mesh, &self.grouped);
        self.atoms = cut::equal_shares(of_atoms.iter().copied(), count);
    }

    pub fn ranks(&self) -> Ranks {
        self.ranks
    }

    /// My elements in groups: triangles, or parts of blocks.
    pub fn grouped(&self) -> Range<usize> {
        self.grouped[self.rank]..self.grouped[self.rank + 1]
    }

    /// My atoms, counted from 0.
    pub fn atoms(&self) -> Range<usize> {
        self.atoms[self.rank]..self.atoms[self.rank + 1]
    }

    /// How many parts there are.
    pub fn count(&self) -> usize {
        self.grouped.len() - 1
    }

    fn grouped_count(&self) -> usize {
        self.grouped[self.grouped.len() - 1]
    }

    /// My elements: those in groups and atoms.
    pub fn elements(&self) -> [Range<usize>; 2] {
        let atoms = self.atoms();
        let first = self.grouped_count();
        [self.grouped(), first + atoms.start..first + atoms.end]
    }

    /// My nodes: those of elements in groups and those of atoms.
    pub fn nodes(&self) -> [Range<usize>; 2] {
        let atoms = self.atoms();
        let first = self.grouped_nodes();
        [
            self.nodes[self.rank]..self.nodes[self.rank + 1],
            first + atoms.start..first + atoms.end,
        ]
    }

    /// Whether this rank moves a node.
    pub fn moves(&self, node: usize) -> bool {
        self.nodes().iter().any(|mine| mine.contains(&node))
    }

    pub fn is_mine(&self, element: usize) -> bool {
        self.elements().iter().any(|mine| mine.contains(&element))
    }

    /// The rank that computes an element.
    pub fn owner(&self, element: usize) -> usize {
        let (starts, number) = match element.checked_sub(self.grouped_count()) {
            None => (&self.grouped, element),
            Some(atom) => (&self.atoms, atom),
        };
        starts[1..].partition_point(|&end| end <= number)
    }

    /// Takes over what has been called in another domain of the same ranks.
    pub fn hear_after(&mut self, before: &Self) {
        (self.called, self.heard) = (before.called, before.heard);
    }

    /// Tells something to all ranks when they next agree.
    pub fn call(&mut self, call: Call) {
        self.called |= call as u64;
    }

    /// All ranks hear what any of them has called.
    pub fn agree(&mut self) {
        self.heard |= self.ranks.any(std::mem::take(&mut self.called));
    }

    /// Whether any rank has called for a stop or a checkpoint that nobody has asked about yet.
    pub fn is_called(&self) -> bool {
        self.heard & (Call::Stop as u64 | Call::Checkpoint as u64) != 0
    }

    /// Whether any rank has called this since it was last asked.
    pub fn hears(&mut self, call: Call) -> bool {
        let heard = self.heard & call as u64 != 0;
        self.heard &= !(call as u64);
        heard
    }

    /// Tells all ranks a level, at most 59, when they next agree.
    pub fn call_level(&mut self, level: u32) {
        if level > 0 {
            self.called |= 1 << (FIRST_LEVEL + level - 1);
        }
    }

    /// The highest level that any rank has called since this was last asked; 0 for none.
    pub fn hears_level(&mut self) -> u32 {
        let levels = self.heard >> FIRST_LEVEL;
        self.heard &= (1 << FIRST_LEVEL) - 1;
        u64::BITS - levels.leading_zeros()
    }

    /// How many nodes elements in groups have.
    fn grouped_nodes(&self) -> usize {
        self.nodes[self.nodes.len() - 1]
    }
}

/// Where the nodes of elements start that start groups; how many there are, where the atoms do.
fn nodes_at(mesh: &impl Grouped, starts: &[usize]) -> Vec<usize> {
    starts.iter().map(|&start| mesh.first_node(start)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::region::{Region, Shape};
    use crate::mesh::sites::Layout;
    use crate::mesh::{Mesh, Plan};

    fn mixed_mesh() -> Mesh {
        let layout = Layout {
            block: 10,
            rows: 8,
            triangles: 21,
        };
        let band = Region {
            shape: Shape::Band { half_width: 12.0 },
            element: 1,
        };
        Mesh::new(&Plan {
            layout,
            element: 10,
            regions: vec![band],
            crack: None,
            grip_rows: 10,
            spacing: 1.0,
        })
    }

    #[test]
    fn every_element_and_node_belongs_to_one_rank_which_all_know() {
        let mesh = mixed_mesh();
        for count in [1, 2, 3, 7, 50] {
            let parts: Vec<Domain> = (0..count)
                .map(|rank| Domain::part(Ranks::alone(), [rank, count], &mesh, |_| 1.0))
                .collect();
            let mut owners = vec![Vec::new(); mesh.node_count()];
            for (rank, part) in parts.iter().enumerate() {
                for element in part.elements().into_iter().flatten() {
                    assert!(part.is_mine(element));
                    assert!(parts.iter().all(|other| other.owner(element) == rank));
                }
                part.nodes()
                    .into_iter()
                    .flatten()
                    .for_each(|node| owners[node].push(rank));
            }
            assert!(owners.iter().all(|owners| owners.len() == 1), "{count} ranks");
            let largest = parts.iter().map(|part| part.atoms().len()).max().unwrap_or(0);
            let share = (mesh.elements.len() - mesh.triangles).div_ceil(count);
            assert!(largest <= share + 1, "{count} ranks: {largest} atoms for {share}");
        }
    }

    #[test]
    fn a_cut_follows_what_was_measured() {
        let mesh = mixed_mesh();
        let part = |rank| Domain::part(Ranks::alone(), [rank, 4], &mesh, |_| 1.0);
        let atoms = mesh.elements.len() - mesh.triangles;
        let mut domain = part(0);
        // The first quarter of the atoms costs three times as much as any other, so that it is half of the whole.
        domain.cut_anew(&mesh, |_| 1.0, [&[1.0; 4], &[3.0, 1.0, 1.0, 1.0]]);
        let share = domain.atoms().len() as f64 / atoms as f64;
        assert!((share - 0.125).abs() < 0.01, "{share}");
        assert_eq!(domain.grouped(), part(0).grouped());
    }

    #[test]
    fn a_cut_of_atoms_alone_follows_what_was_measured_too() {
        let layout = Layout {
            block: 10,
            rows: 4,
            triangles: 9,
        };
        let mesh = Mesh::new(&Plan {
            layout,
            element: 1,
            regions: vec![],
            crack: None,
            grip_rows: 10,
            spacing: 1.0,
        });
        let atoms = mesh.elements.len();
        let mut domain = Domain::part(Ranks::alone(), [0, 2], &mesh, |_| 1.0);
        domain.cut_anew(&mesh, |_| 1.0, [&[0.0; 2], &[3.0, 1.0]]);
        // The first half costs three quarters of the whole, so that two thirds of it are a half.
        let share = domain.atoms().len() as f64 / atoms as f64;
        assert!((share - 1.0 / 3.0).abs() < 0.01, "{share}");
        assert!(domain.grouped().is_empty());
    }

    #[test]
    fn what_is_called_is_heard_once() {
        let mut domain = Domain::new(Ranks::alone(), &mixed_mesh(), |_| 1.0);
        domain.call(Call::Stop);
        assert!(!domain.hears(Call::Stop), "not before all have agreed");
        domain.agree();
        assert!(!domain.hears(Call::Checkpoint));
        assert!(domain.hears(Call::Stop) && !domain.hears(Call::Stop));
        [0, 3, 59, 58].into_iter().for_each(|level| domain.call_level(level));
        domain.call(Call::Checkpoint);
        domain.agree();
        assert_eq!([domain.hears_level(), domain.hears_level()], [59, 0]);
        assert!(domain.hears(Call::Checkpoint));
    }
}
