//! All integration tests in one program, one module a part, so that the heavy crates are linked once.

mod suite {
    mod analysis;
    mod forces;
    mod record;
    mod solver;
    mod specimens;
    mod study_files;
    mod synthetic;
}
