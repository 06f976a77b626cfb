//! One binary for all integration tests, so that the heavy crates are linked once.

mod suite {
    mod analysis;
    mod cli;
    mod executor;
    mod record;
    mod report;
    mod store;
    mod study_files;
    mod synthetic;
    mod tidy;
}
