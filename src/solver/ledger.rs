//! Where the energy comes from and where it goes.

use super::error::SolverError;

/// Energy since the start of a run: what the grips put in, what is stored, and what the cutoff releases.
///
/// A truncated potential jumps where a pair crosses the cutoff, so the energy of the specimen rises by -phi(r_c) for
/// every pair that leaves without any force doing work. The release is counted from the number of pairs within the
/// cutoff. What is left over, |dKE + dPE - work - release|, is the error of the computation.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger {
    initial_potential: f64,
    initial_pairs: f64,
    initial_kinetic: f64,
    /// The part of the kinetic energy that belongs to the grips: nobody puts it into the specimen.
    held_kinetic: f64,
    /// At most what random displacements of the start have put in, eV.
    noise: f64,
    /// What the energy of a pair jumps by when it comes within the cutoff, eV.
    jump: f64,
    /// What the mesh has gained of energy where it was refined, eV.
    refined: f64,
    peak_work: f64,
    peak_imbalance: f64,
}

/// The ledger at one moment, relative to the start, eV.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance {
    pub potential: f64,
    pub work: f64,
    pub cutoff_release: f64,
    /// What came with finer meshes.
    pub refined: f64,
    pub imbalance: f64,
}

impl Ledger {
    /// A run is stopped when this share of the energy put in cannot be accounted for.
    const LIMIT: f64 = 0.1;
    /// Units of its last digit by which the potential energy may be off: measured were 40 with five thousand sites and 90
    /// with a million, atoms and elements alike.
    const ROUNDING: f64 = 1000.0;

    /// Opens with what is stored, potential energy (eV) and pairs within the cutoff, kinetic energy, of all and of what is held
    /// alone, and what a pair's energy jumps by when it comes within the cutoff, eV.
    pub fn new([potential, pairs]: [f64; 2], [kinetic, held]: [f64; 2], jump: f64) -> Self {
        Self {
            initial_potential: potential,
            initial_pairs: pairs,
            initial_kinetic: kinetic,
            held_kinetic: held,
            noise: 0.0,
            jump,
            refined: 0.0,
            peak_work: 0.0,
            peak_imbalance: 0.0,
        }
    }

    /// Takes note of at most how much energy random displacements of the start have put in, eV.
    pub fn put_in_by_noise(&mut self, energy: f64) {
        self.noise = energy;
    }

    /// Puts the start where the specimen is now, before any work.
    pub fn begin(&mut self, stored: [f64; 2], kinetic: f64) {
        *self = Self {
            noise: self.noise,
            ..Self::new(stored, [kinetic, self.held_kinetic], self.jump)
        };
    }

    /// Balances the energies of a moment, `work` being that of the grips so far, and remembers the largest imbalance.
    pub fn balance(&mut self, [potential, pairs]: [f64; 2], kinetic: f64, work: f64) -> Balance {
        self.peak_work = self.peak_work.max(work.abs());
        let potential = potential - self.initial_potential;
        // Adding zero turns a negative zero into zero.
        let cutoff_release = self.jump * (pairs - self.initial_pairs) + 0.0;
        let imbalance = (kinetic - self.initial_kinetic + potential - work - cutoff_release - self.refined).abs();
        self.peak_imbalance = self.peak_imbalance.max(imbalance);
        Balance {
            potential,
            work,
            cutoff_release,
            refined: self.refined,
            imbalance,
        }
    }

    /// Books the energy by which a finer mesh holds more than the one before it, at the same moment, less what pairs released:
    /// potential energy (eV), pairs within the cutoff, and kinetic energy (eV) of both.
    pub fn refine(&mut self, before: [f64; 3], after: [f64; 3]) {
        let [potential, pairs, kinetic] = [0, 1, 2].map(|part| after[part] - before[part]);
        self.refined += potential + kinetic - self.jump * pairs;
    }

    /// What the mesh has gained of energy where it was refined, eV.
    pub fn refined(&self) -> f64 {
        self.refined
    }

    /// Largest imbalance over the largest work, or nothing before any work is done.
    pub fn relative_error(&self) -> Option<f64> {
        (self.peak_work > 0.0).then(|| self.peak_imbalance / self.peak_work)
    }

    /// Refuses to go on when energy has gone astray.
    ///
    /// `unresolved` is what the steps leave open of the energy at this moment, eV.
    pub fn check(
        &self,
        step: u64,
        time: f64,
        strain: f64,
        unresolved: f64,
        fastest: impl FnOnce() -> Vec<f64>,
    ) -> Result<(), SolverError> {
        let put_in = self
            .peak_work
            .max(self.initial_kinetic - self.held_kinetic)
            .max(self.noise);
        if self.peak_imbalance <= Self::LIMIT * put_in + self.rounding() + unresolved {
            return Ok(());
        }
        let [imbalance, limit] = [self.peak_imbalance, 100.0 * Self::LIMIT];
        Err(SolverError::EnergyAstray {
            step,
            time,
            strain,
            imbalance,
            put_in,
            limit,
            fastest: fastest(),
        })
    }

    /// What rounding may leave of the balance, eV, however little work is done: a millionth of the energy of a bond in a
    /// specimen of a million atoms.
    fn rounding(&self) -> f64 {
        Self::ROUNDING * f64::EPSILON * self.initial_potential.abs()
    }

    /// eV
    pub fn peak_work(&self) -> f64 {
        self.peak_work
    }

    /// eV
    pub fn peak_imbalance(&self) -> f64 {
        self.peak_imbalance
    }

    /// Potential energy, pairs within the cutoff and kinetic energy at the start.
    pub fn start(&self) -> [f64; 3] {
        [self.initial_potential, self.initial_pairs, self.initial_kinetic]
    }

    pub fn restore(&mut self, start: [f64; 3], refined: f64, [peak_work, peak_imbalance]: [f64; 2]) {
        self.refined = refined;
        [self.initial_potential, self.initial_pairs, self.initial_kinetic] = start;
        self.peak_work = peak_work;
        self.peak_imbalance = peak_imbalance;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a slab of five thousand atoms that is pulled at 1000 /s, eV.
    const POTENTIAL: f64 = -6.5e3;
    const PAIRS: f64 = 1.56e4;
    const KINETIC: f64 = 2.3e-13;
    /// What rounding was seen to make of its balance, eV.
    const ROUNDING_SEEN: f64 = 5.5e-11;
    /// The energy of a bond, eV.
    const BOND: f64 = 0.415;

    fn goes_on(peak_work: f64, peak_imbalance: f64) -> bool {
        goes_on_with(0.0, peak_work, peak_imbalance)
    }

    /// With grips of so much kinetic energy, eV.
    fn goes_on_with(held: f64, peak_work: f64, peak_imbalance: f64) -> bool {
        let mut ledger = Ledger::new([0.0; 2], [0.0, held], 0.0);
        ledger.restore([POTENTIAL, PAIRS, KINETIC + held], 0.0, [peak_work, peak_imbalance]);
        ledger.check(1, 1.0, 1e-9, 0.0, Vec::new).is_ok()
    }

    #[test]
    fn rounding_ends_no_run_however_little_work_is_done() {
        assert!(goes_on(1e-14, ROUNDING_SEEN) && goes_on(0.0, ROUNDING_SEEN));
    }

    #[test]
    fn a_blow_up_is_told_before_it_is_worth_a_millionth_of_a_bond() {
        assert!(!goes_on(1e-14, 1e-6 * BOND) && !goes_on(0.0, 1e-6 * BOND));
    }

    #[test]
    fn the_motion_of_the_grips_is_no_energy_put_in() {
        // A slab of 6.7 nm whose grips are torn off in the first step.
        assert!(!goes_on_with(1500.0, 1e-6, 42.0) && goes_on_with(1500.0, 1e4, 42.0));
    }

    #[test]
    fn a_load_that_sets_in_within_a_step_ends_no_run() {
        // A plate of 371,000 atoms in the second step after a ball has touched it, eV.
        let [work, imbalance, unresolved] = [1.326e-6, 1.337e-6, 2.6e-6];
        let mut ledger = Ledger::new([0.0; 2], [0.0; 2], 0.0);
        ledger.restore([-9.2e5, 2.2e6, 0.0], 0.0, [work, imbalance]);
        let goes_on = |unresolved: f64| ledger.check(22, 2.232, 0.0, unresolved, Vec::new).is_ok();
        assert!(goes_on(unresolved) && !goes_on(0.0));
    }

    #[test]
    fn what_comes_with_a_finer_mesh_is_no_error_of_the_computation() {
        let mut ledger = Ledger::new([-10.0, 30.0], [2.0, 0.0], 0.5);
        // The finer mesh holds 0.25 more, and a pair more, which costs 0.5.
        ledger.refine([-9.0, 30.0, 3.0], [-8.5, 31.0, 3.25]);
        let balance = ledger.balance([-8.5, 31.0], 3.25, 2.0);
        assert_eq!([balance.refined, balance.imbalance], [0.25, 0.0]);
    }

    #[test]
    fn where_work_is_done_a_tenth_of_it_may_be_missing() {
        assert!(goes_on(10.0, 0.99) && !goes_on(10.0, 1.01));
    }
}
