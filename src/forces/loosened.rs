//! Interfaces that are no longer as in the lattice, anywhere in the specimen: all ranks know all of them, each computes its own.

use super::Forces;
use super::interface::State;
use crate::domain::Domain;
use crate::mesh::interfaces::Interfaces;

/// An interface that is not tight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Loosened {
    /// In the whole mesh.
    pub number: u32,
    pub state: State,
    pub both: [u32; 2],
    /// A cut severs some of its bonds.
    pub is_severed: bool,
}

impl Loosened {
    /// The interface at a place, in a state that it comes to have.
    pub fn at(interfaces: &Interfaces, place: usize, state: State) -> Self {
        let pair = interfaces.pairs[place];
        Self {
            number: interfaces.number_of(place),
            state,
            both: pair.both(),
            is_severed: pair.severed,
        }
    }

    pub fn is_open(&self) -> bool {
        self.state == State::Open
    }

    /// All that any rank names; an interface named more than once has the loosest of its states. Ascending.
    pub fn of_all_ranks(domain: &Domain, mine: &[Self]) -> Vec<Self> {
        let words = mine.iter().flat_map(|known| {
            let [first, second] = known.both;
            [
                known.number,
                known.state as u32,
                first,
                second,
                u32::from(known.is_severed),
            ]
        });
        let words = domain.ranks().join(words.collect());
        let (words, _) = words.as_chunks::<5>();
        let all = words.iter().map(|&[number, state, first, second, is_severed]| Self {
            number,
            state: State::from_number(state),
            both: [first, second],
            is_severed: is_severed != 0,
        });
        let mut all: Vec<Self> = all.collect();
        include(&mut all, Vec::new());
        all
    }
}

/// Adds interfaces to ascending ones. One that is there already has the looser of both states.
pub fn include(ascending: &mut Vec<Loosened>, more: Vec<Loosened>) {
    ascending.extend(more);
    ascending.sort_by_key(|known| (known.number, std::cmp::Reverse(known.state)));
    ascending.dedup_by_key(|known| known.number);
}

impl Forces {
    /// Numbers of the interfaces that have left the intact path, ascending: the only memory that a restart must keep.
    pub fn open_interfaces(&self) -> Vec<u32> {
        let open = self.loosened.iter().filter(|known| known.is_open());
        open.map(|known| known.number).collect()
    }

    /// Puts back what [`Self::open_interfaces`] gave. All ranks must call this together.
    pub fn restore_open_interfaces(&mut self, open: &[u32]) {
        self.states.fill(State::Tight);
        self.loosened.clear();
        self.watched.clear();
        let places = open.iter().filter_map(|&number| self.interfaces.place_of(number));
        self.loosen(places.collect());
        self.atoms.calm();
        self.contacts.forget();
    }

    /// All ranks learn that interfaces at places of this one are open.
    pub(super) fn loosen(&mut self, places: Vec<usize>) {
        let own = places.into_iter().filter(|&place| self.is_told_here(place));
        let mine: Vec<Loosened> = own
            .map(|place| Loosened::at(&self.interfaces, place, State::Open))
            .collect();
        let all = Loosened::of_all_ranks(&self.domain, &mine);
        self.watch(&all);
    }

    /// Whether this rank is the one that tells of an interface.
    pub(super) fn is_told_here(&self, place: usize) -> bool {
        let first = self.interfaces.pairs[place].first as usize;
        self.domain.grouped().contains(&first)
    }

    /// Takes note of interfaces that have changed, and of those that must be tested in every step from now on: those of
    /// triangles with an open interface. What follows from regular bonds ends where a crack begins.
    pub(super) fn watch(&mut self, changed: &[Loosened]) {
        for known in changed {
            if let Some(place) = self.interfaces.place_of(known.number) {
                self.states[place] = self.states[place].max(known.state);
            }
        }
        let beside = changed
            .iter()
            .filter(|known| known.is_open())
            .flat_map(|known| known.both);
        let newly_watched: Vec<u32> = beside
            .flat_map(|triangle| self.interfaces.of(triangle as usize))
            .copied()
            .collect();
        let mut watched = std::mem::take(&mut self.watched);
        super::include(&mut watched, newly_watched);
        watched.retain(|&place| !self.is_open(place as usize));
        self.watched = watched;
        include(&mut self.loosened, changed.to_vec());
        self.certain_is_current = false;
    }

    /// How many interfaces between triangles have opened, without those that a cut severs.
    pub fn opened_interfaces(&self) -> usize {
        self.loosened
            .iter()
            .filter(|known| known.is_open() && !known.is_severed)
            .count()
    }

    /// How many interfaces the mesh has.
    pub fn interface_count(&self) -> usize {
        self.interfaces.count()
    }

    /// All pairs of triangles that border on each other, in any order, and whether a cut severs them. All ranks must ask for
    /// them together.
    pub fn neighbours(&self) -> Vec<([u32; 2], bool)> {
        let places = (0..self.interfaces.pairs.len()).filter(|&place| self.is_told_here(place));
        let mine = places.flat_map(|place| {
            let pair = self.interfaces.pairs[place];
            [pair.first, pair.second, u32::from(pair.severed)]
        });
        let all = self.domain.ranks().join(mine.collect());
        let (all, _) = all.as_chunks::<3>();
        all.iter()
            .map(|&[first, second, severed]| ([first, second], severed != 0))
            .collect()
    }
}
