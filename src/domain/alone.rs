//! One rank, in a program without MPI.

use super::halo::Parcel;
use super::{DomainError, mpirun_ranks};

/// The processes that compute one case together: here only this one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ranks;

/// What lasts as long as ranks can talk.
#[derive(Debug)]
pub struct Session;

/// To be called once, before anything else. An error if there seem to be other ranks.
pub fn start() -> Result<(Ranks, Session), DomainError> {
    match mpirun_ranks() {
        Some(ranks) if ranks > 1 => Err(DomainError::WithoutMpi(ranks)),
        _ => Ok((Ranks, Session)),
    }
}

/// The MPI library; `None` without one.
pub fn library() -> Option<String> {
    None
}

impl Ranks {
    pub fn alone() -> Self {
        Self
    }

    pub fn rank(self) -> usize {
        0
    }

    pub fn count(self) -> usize {
        1
    }

    /// How many of them are on this machine.
    pub fn here(self) -> u32 {
        1
    }

    /// Whether this rank speaks and writes.
    pub fn is_first(self) -> bool {
        true
    }

    /// Ends all ranks.
    pub fn abort(self, _: u8) {}

    pub fn wait_for_all(self) {}

    /// The bits that any rank has set.
    pub(super) fn any(self, bits: u64) -> u64 {
        bits
    }

    pub fn least(self, number: u64) -> u64 {
        number
    }

    pub fn largest(self, number: f64) -> f64 {
        number
    }

    /// Puts what the first rank has there.
    pub fn follow_first(self, _: &mut [f64]) {}

    /// What all ranks have, one after the other.
    pub fn join<T>(self, mine: Vec<T>) -> Vec<T> {
        mine
    }

    /// Sums of the numbers of all ranks, the same on all of them: as one has them where the others have zeros.
    pub fn merge(self, mine: &[f64]) -> Vec<f64> {
        mine.to_vec()
    }

    /// Gives every rank its list, and returns theirs for this one.
    pub(super) fn swap(self, lists: &[Vec<u32>]) -> Vec<Vec<u32>> {
        lists.to_vec()
    }

    pub(super) fn exchange<T>(self, _: &[Parcel], _: &mut [Parcel], work: impl FnOnce() -> T) -> T {
        work()
    }

    /// Sends numbers from the first rank to the second and back.
    pub(super) fn to_and_fro(self, _: &mut [f64]) {}

    /// Puts together the parts of all ranks, each of which gives its own, on the first.
    pub(super) fn gather(self, _: &[f64], _: &mut [f64], _: &[usize]) {}

    /// Brings all ranks' parts of a plane to all.
    pub(super) fn share(self, _: &mut [f64], _: &[usize]) {}
}
