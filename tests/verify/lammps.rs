//! The same specimen in LAMMPS: forces, energies and trajectories.

mod program;

use cgaft::export::lammps::Model;
use cgaft::forces::{Forces, Planes};
use cgaft::plan;
use cgaft::setup;
use cgaft::solver::Solver;
use cgaft::state::State;
use cgaft::study;
use cgaft::study::case::Case;

use super::specimens;
use program::{Folder, rows};

/// Sums over the same pairs in another order, and products of the same factors in another order, differ by rounding only.
const ROUNDING: f64 = 1e-12;

/// Rounding grows while atoms move, by less than this within 1,000 steps.
const TRAJECTORY: f64 = 1e-9;

/// 0.005 in the time unit of the potential, sigma sqrt(m/epsilon) = 1.0192 ps.
const TIME_STEP: &str = "0.005096 ps";
const STEPS: u64 = 1000;
const SNAPSHOT_STEPS: u64 = 100;

const SMOOTH: &str = "lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.43263 nm, at-cutoff: {smooth-from: 0.34155 nm}}";

/// Every potential and treatment of the cutoff that LAMMPS has, short and long.
const POTENTIALS: [&str; 6] = [
    "lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.34 nm, at-cutoff: truncated}",
    "lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.57 nm, at-cutoff: shifted}",
    SMOOTH,
    "lennard-jones: {epsilon: 0.415 eV, sigma: 0.2277 nm, cutoff: 0.57 nm, at-cutoff: {smooth-from: 0.45 nm}}",
    "morse: {depth: 0.343 eV, decay: 13.6 /nm, distance: 0.2866 nm, cutoff: 0.5 nm, at-cutoff: truncated}",
    "morse: {depth: 0.343 eV, decay: 13.6 /nm, distance: 0.2866 nm, cutoff: 0.5 nm, at-cutoff: shifted}",
];
