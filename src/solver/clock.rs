/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clock {
    pub step: u64,
    /// ps
    pub time: f64,
    /// In force, ps.
    pub time_step: f64,
}
