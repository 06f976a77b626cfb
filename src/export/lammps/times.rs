use super::exact;

/// How long a case runs and when it is looked at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Times {
    /// ps
    pub time_step: f64,
    pub steps: u64,
    /// Steps between rows of the log, and between snapshots.
    pub probe_every: u64,
    pub snapshot_every: u64,
}

impl Times {
    /// The end of a script: what the log tells beside step and time, what the dump tells of atoms, and the run.
    pub(super) fn run(&self, name: &str, told: &str, of_atoms: &str) -> String {
        let Self {
            steps,
            probe_every,
            snapshot_every,
            ..
        } = self;
        let time_step = exact(self.time_step);
        format!(
            "timestep {time_step}
thermo_style custom step time {told}
thermo_modify norm no format float %.16e
thermo {probe_every}
dump fields all custom {snapshot_every} dump.{name} id type {of_atoms}
dump_modify fields sort id format float %.16e
run {steps}
"
        )
    }
}
