//! One binary for all integration tests, so that the heavy crates are linked once.

mod suite {
    mod cli;
    mod dump;
    mod executor;
    mod record;
    mod store;
    mod study_files;
    mod tidy;
}
