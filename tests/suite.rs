//! All integration tests in one program, one module a part.

#[path = "suite/study_files.rs"]
mod study_files;
