//! The study that a new user starts from.

/// The commented study that `cgaft new NAME` writes.
pub fn starter(name: &str) -> String {
    include_str!("starter.yaml").replace("NAME", name)
}
