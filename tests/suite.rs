//! All integration tests in one program, one module a part.

#[path = "suite/analysis.rs"]
mod analysis;
#[path = "suite/forces.rs"]
mod forces;
#[path = "suite/specimens.rs"]
mod specimens;
