//! Whether the disk has room for what is to be computed.

use std::path::Path;

use super::format;
use super::terminal::warn;
use crate::executor::probe;

/// A warning where results of so many bytes, by estimate and at most, do not fit on the disk of a folder.
pub fn warning(results: &Path, needed: u64) -> Option<String> {
    warning_of(probe::free_disk(results)?, needed)
}

/// Tells of it before anything is started.
pub fn tell(results: &Path, needed: u64) {
    warning(results, needed).iter().for_each(|warning| warn(warning));
}

fn warning_of(free: u64, needed: u64) -> Option<String> {
    (needed > free).then(|| {
        format!(
            "warning: the results may take {} of disk, and {} are free: a full disk interrupts cases, which go on when there \
             is room; make some, take fewer snapshots or choose another folder with --results DIR",
            format::bytes(needed),
            format::bytes(free)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_that_do_not_fit_are_told_with_both_sizes() {
        assert_eq!(warning_of(1000, 1000), None);
        let told = warning_of(2_000_000_000, 5_000_000_000).unwrap();
        assert!(
            told.contains(&format::bytes(2_000_000_000)) && told.contains(&format::bytes(5_000_000_000)),
            "{told}"
        );
    }
}
