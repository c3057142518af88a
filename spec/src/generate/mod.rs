//! Turns the spec into Rust source.
