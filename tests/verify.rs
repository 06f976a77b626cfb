//! Physics against closed forms and published numbers. It takes minutes: `cargo test --release --test verify`.

mod verify {
    mod gates;
    mod table;
}
