//! Ranks that talk by MPI: the only place that knows it.

use mpi::collective::SystemOperation;
use mpi::datatype::{Partition, PartitionMut};
use mpi::environment::{self, Universe};
use mpi::topology::SimpleCommunicator;
use mpi::traits::{Communicator, CommunicatorCollectives, Destination, Equivalence, Root, Source};
use mpi::{Count, Rank, Threading};

use super::halo::Parcel;
use super::{DomainError, mpirun_ranks};

/// The processes that compute one case together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ranks {
    rank: usize,
    count: usize,
    here: u32,
}

/// What lasts as long as ranks can talk.
pub struct Session {
    /// `None` for a process that nobody has started beside others.
    _universe: Option<Universe>,
}

/// To be called once, before anything else. From then on a panic of one rank ends all. A process on its own does without
/// MPI, which would start a daemon for it.
pub fn start() -> Result<(Ranks, Session), DomainError> {
    if !is_launched() {
        return Ok((Ranks::alone(), Session { _universe: None }));
    }
    let (universe, threading) = mpi::initialize_with_threading(Threading::Serialized).expect("MPI starts only once");
    if threading < Threading::Serialized {
        return Err(DomainError::NoThreads);
    }
    let world = universe.world();
    let ranks = Ranks {
        rank: world.rank() as usize,
        count: world.size() as usize,
        here: world.split_shared(0).size() as u32,
    };
    match mpirun_ranks() {
        Some(started) if started > 1 && ranks.count == 1 => {
            let library = library().expect("it has just been started");
            return Err(DomainError::OtherMpi {
                ranks: started,
                library,
            });
        }
        _ => {}
    }
    if ranks.count > 1 {
        let hook = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| {
            hook(panic);
            world_of_all().abort(PANICKED);
        }));
    }
    Ok((
        ranks,
        Session {
            _universe: Some(universe),
        },
    ))
}

/// Whether mpirun or another launcher of parallel programs has started this process.
fn is_launched() -> bool {
    let told = ["OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"];
    told.iter().any(|name| std::env::var_os(name).is_some())
}

/// Rust's own exit code after a panic.
const PANICKED: i32 = 101;

/// Name and version of the MPI library.
pub fn library() -> Option<String> {
    let told = environment::library_version().ok()?;
    // "Open MPI v4.1.4, package: …"
    let name = told.split([',', '\n']).next()?;
    Some(name.trim_matches([' ', '\0']).replace(" v", " "))
}

fn world_of_all() -> SimpleCommunicator {
    SimpleCommunicator::world()
}

impl Ranks {
    /// Only this process, whoever else there is.
    pub fn alone() -> Self {
        Self {
            rank: 0,
            count: 1,
            here: 1,
        }
    }

    pub fn rank(self) -> usize {
        self.rank
    }

    pub fn count(self) -> usize {
        self.count
    }

    /// How many of them are on this machine.
    pub fn here(self) -> u32 {
        self.here
    }

    /// Whether this rank speaks and writes.
    pub fn is_first(self) -> bool {
        self.rank == 0
    }

    fn is_alone(self) -> bool {
        self.count == 1
    }

    /// Ends all ranks.
    pub fn abort(self, code: u8) {
        if !self.is_alone() {
            world_of_all().abort(i32::from(code));
        }
    }

    pub fn wait_for_all(self) {
        if !self.is_alone() {
            world_of_all().barrier();
        }
    }

    /// The bits that any rank has set.
    pub(super) fn any(self, bits: u64) -> u64 {
        self.reduce(bits, SystemOperation::bitwise_or())
    }

    pub fn least(self, number: u64) -> u64 {
        self.reduce(number, SystemOperation::min())
    }

    pub fn largest(self, number: f64) -> f64 {
        self.reduce(number, SystemOperation::max())
    }

    fn reduce<T: Equivalence + Copy>(self, number: T, operation: SystemOperation) -> T {
        let mut result = number;
        if !self.is_alone() {
            world_of_all().all_reduce_into(&number, &mut result, operation);
        }
        result
    }

    /// Puts what the first rank has there.
    pub fn follow_first(self, numbers: &mut [f64]) {
        if !self.is_alone() {
            world_of_all().process_at_rank(0).broadcast_into(numbers);
        }
    }

    /// What all ranks have, one after the other.
    pub fn join<T: Equivalence + Copy + Default>(self, mine: Vec<T>) -> Vec<T> {
        if self.is_alone() {
            return mine;
        }
        let mut counts = vec![0; self.count];
        world_of_all().all_gather_into(&(mine.len() as Count), &mut counts);
        let starts = starts(&counts);
        let mut all = vec![T::default(); total(&counts)];
        world_of_all().all_gather_varcount_into(&mine[..], &mut PartitionMut::new(&mut all[..], counts, starts));
        all
    }

    /// Sums of the numbers of all ranks, the same on all of them: as one has them where the others have zeros.
    pub fn merge(self, mine: &[f64]) -> Vec<f64> {
        let mut all = mine.to_vec();
        if !self.is_alone() {
            world_of_all().all_reduce_into(mine, &mut all[..], SystemOperation::sum());
        }
        all
    }

    /// Gives every rank its list, and returns theirs for this one.
    pub(super) fn swap(self, lists: &[Vec<u32>]) -> Vec<Vec<u32>> {
        if self.is_alone() {
            return lists.to_vec();
        }
        let given: Vec<Count> = lists.iter().map(|list| list.len() as Count).collect();
        let mut taken = vec![0; self.count];
        world_of_all().all_to_all_into(&given, &mut taken);
        let all_given: Vec<u32> = lists.concat();
        let mut all_taken = vec![0u32; total(&taken)];
        let [starts_given, starts_taken] = [&given, &taken].map(|counts| starts(counts));
        world_of_all().all_to_all_varcount_into(
            &Partition::new(&all_given[..], given, starts_given),
            &mut PartitionMut::new(&mut all_taken[..], &taken[..], starts_taken),
        );
        let mut rest = all_taken.as_slice();
        let mut next = |&count: &Count| {
            let (list, others) = rest.split_at(count as usize);
            rest = others;
            list.to_vec()
        };
        taken.iter().map(&mut next).collect()
    }

    /// Sends and receives parcels while some work is done.
    pub(super) fn exchange<T>(self, outgoing: &[Parcel], incoming: &mut [Parcel], work: impl FnOnce() -> T) -> T {
        if outgoing.is_empty() && incoming.is_empty() {
            return work();
        }
        let world = world_of_all();
        mpi::request::multiple_scope(outgoing.len() + incoming.len(), |scope, requests| {
            for parcel in incoming {
                let peer = world.process_at_rank(parcel.peer as Rank);
                requests.add(peer.immediate_receive_into(scope, &mut parcel.numbers[..]));
            }
            for parcel in outgoing {
                let peer = world.process_at_rank(parcel.peer as Rank);
                requests.add(peer.immediate_send(scope, &parcel.numbers[..]));
            }
            let done = work();
            requests.wait_all(&mut Vec::new());
            done
        })
    }

    /// Sends numbers from the first rank to the second and back.
    pub(super) fn to_and_fro(self, numbers: &mut [f64]) {
        let world = world_of_all();
        if self.rank == 0 {
            let second = world.process_at_rank(1);
            second.send(&*numbers);
            second.receive_into(numbers);
        } else if self.rank == 1 {
            let first = world.process_at_rank(0);
            first.receive_into(numbers);
            first.send(&*numbers);
        }
    }

    /// Puts together the parts of all ranks, each of which gives its own, on the first; they start there.
    pub(super) fn gather(self, mine: &[f64], plane: &mut [f64], starts: &[usize]) {
        if self.is_alone() {
            return;
        }
        let world = world_of_all();
        let first = world.process_at_rank(0);
        if self.is_first() {
            first.gather_varcount_into_root(mine, &mut parts(plane, starts));
        } else {
            first.gather_varcount_into(mine);
        }
    }

    /// Brings all ranks' parts of a plane, which start there, to all.
    pub(super) fn share(self, plane: &mut [f64], starts: &[usize]) {
        if !self.is_alone() {
            let mine = plane[starts[self.rank]..starts[self.rank + 1]].to_vec();
            world_of_all().all_gather_varcount_into(&mine[..], &mut parts(plane, starts));
        }
    }
}

fn parts<'a>(plane: &'a mut [f64], starts: &[usize]) -> PartitionMut<'a, [f64], Vec<Count>, Vec<Count>> {
    let counts = starts.windows(2).map(|ends| (ends[1] - ends[0]) as Count).collect();
    let starts = starts[..starts.len() - 1].iter().map(|&start| start as Count).collect();
    PartitionMut::new(plane, counts, starts)
}

fn starts(counts: &[Count]) -> Vec<Count> {
    let mut sum = 0;
    counts
        .iter()
        .map(|count| {
            sum += count;
            sum - count
        })
        .collect()
}

fn total(counts: &[Count]) -> usize {
    counts.iter().sum::<Count>() as usize
}
