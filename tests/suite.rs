//! The integration tests, one binary.
mod suite {
    mod record;
}
