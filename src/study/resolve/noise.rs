//! Random displacements of the start.

use super::Check;
use crate::study::{case::Noise, defaults, file, finding::Finding, reader::Given};

/// In spacings: what is displaced farther is no crystal any more.
const MOST_NOISE: f64 = 0.1;

impl Check<'_> {
    /// The outer `None` is a mistake.
    pub fn noise(&self, given: &Given<file::Noise>) -> Option<Option<Noise>> {
        let (values, section) = match given {
            Given::Absent => return Some(None),
            Given::Wrong(_) => return None,
            Given::Right(values, place) => (values, *place),
        };
        let seed = self.choice(&values.seed, defaults::SEED);
        let (amplitude, place) = self.need(&values.amplitude, section, "noise.amplitude", "1e-3")?;
        if !(amplitude > 0.0 && amplitude <= MOST_NOISE) {
            let message = format!(
                "the amplitude of noise must be more than 0 and at most {MOST_NOISE} lattice spacings, and {amplitude} is not"
            );
            self.add(Finding::at(place, message).help("write 1e-3 for noise of physical size, 1e-10 to see chaos"));
            return None;
        }
        Some(Some(Noise { amplitude, seed: seed? }))
    }
}
