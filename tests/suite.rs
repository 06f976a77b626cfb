//! All integration tests in one program, one module a part.

#[path = "suite/analysis.rs"]
mod analysis;
#[path = "suite/forces.rs"]
mod forces;
#[path = "suite/solver.rs"]
mod solver;
#[path = "suite/specimens.rs"]
mod specimens;
#[path = "suite/synthetic.rs"]
mod synthetic;
