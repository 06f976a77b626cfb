//! One binary for all integration tests, so that the heavy crates are linked once.

mod suite {
    mod cli;
    mod executor;
    mod store;
    mod tidy;
}
