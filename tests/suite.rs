//! All integration tests in one program, one module a part.

#[path = "suite/dump.rs"]
mod dump;
#[path = "suite/study_files.rs"]
mod study_files;
