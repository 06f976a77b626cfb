//! Where the energy comes from and where it goes.

use super::SolverError;
use crate::forces::Measure;

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
    /// What the energy of a pair jumps by when it comes within the cutoff, eV.
    jump: f64,
    work: f64,
    peak_work: f64,
    peak_imbalance: f64,
}

/// The ledger at one moment, relative to the start, eV.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance {
    pub potential: f64,
    pub work: f64,
    pub cutoff_release: f64,
    pub imbalance: f64,
}

impl Ledger {
    /// A run is stopped when this share of the energy put in cannot be accounted for.
    const LIMIT: f64 = 0.1;

    pub fn new(start: &Measure, kinetic: f64, jump: f64) -> Self {
        Self {
            initial_potential: start.energy,
            initial_pairs: start.pairs,
            initial_kinetic: kinetic,
            jump,
            work: 0.0,
            peak_work: 0.0,
            peak_imbalance: 0.0,
        }
    }

    /// Puts the start where the specimen is now, before any work.
    pub fn begin(&mut self, start: &Measure, kinetic: f64) {
        *self = Self::new(start, kinetic, self.jump);
    }

    /// What grips put in, less what sponges take out.
    pub fn add_work(&mut self, work: f64) {
        self.work += work;
        self.peak_work = self.peak_work.max(self.work.abs());
    }

    /// Balances the energies of a moment and remembers the largest imbalance.
    pub fn balance(&mut self, measure: &Measure, kinetic: f64) -> Balance {
        let potential = measure.energy - self.initial_potential;
        // Adding zero turns a negative zero into zero.
        let cutoff_release = self.jump * (measure.pairs - self.initial_pairs) + 0.0;
        let imbalance = (kinetic - self.initial_kinetic + potential - self.work - cutoff_release).abs();
        self.peak_imbalance = self.peak_imbalance.max(imbalance);
        Balance {
            potential,
            work: self.work,
            cutoff_release,
            imbalance,
        }
    }

    /// Largest imbalance over the largest work, or nothing before any work is done.
    pub fn relative_error(&self) -> Option<f64> {
        (self.peak_work > 0.0).then(|| self.peak_imbalance / self.peak_work)
    }

    /// Refuses to go on when energy has gone astray.
    pub fn check(
        &self,
        step: u64,
        time: f64,
        strain: f64,
        fastest: impl FnOnce() -> [f64; 2],
    ) -> Result<(), SolverError> {
        let put_in = self.peak_work.max(self.initial_kinetic);
        if self.peak_imbalance <= Self::LIMIT * put_in || self.peak_imbalance == 0.0 {
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

    pub fn work(&self) -> f64 {
        self.work
    }

    pub fn peak_work(&self) -> f64 {
        self.peak_work
    }

    pub fn peak_imbalance(&self) -> f64 {
        self.peak_imbalance
    }

    /// Potential energy, pairs within the cutoff and kinetic energy at the start.
    pub fn start(&self) -> [f64; 3] {
        [self.initial_potential, self.initial_pairs, self.initial_kinetic]
    }

    pub fn restore(&mut self, start: [f64; 3], work: f64, peak_work: f64, peak_imbalance: f64) {
        [self.initial_potential, self.initial_pairs, self.initial_kinetic] = start;
        self.work = work;
        self.peak_work = peak_work;
        self.peak_imbalance = peak_imbalance;
    }
}
