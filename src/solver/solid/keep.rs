//! What a solid keeps beside the motion of its nodes, so that a run goes on as if it had never stopped.

/// What its loading has done, and what was last read of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Kept {
    /// Work of each action on each of its nodes so far, one action after the other, eV.
    pub works: Vec<f64>,
    /// Nominal strain when it was last read.
    pub last_strain: f64,
}
