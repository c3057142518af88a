//! What each target does with its input.

pub mod crc;
pub mod fast_status;
pub mod innfos_frame;
pub mod innfos_stream;
pub mod packet;
pub mod register;
pub mod spec_yaml;
pub mod stream_cost;
pub mod stream_raw;
pub mod stream_scenario;
pub mod stuffing;

/// Does nothing: how fast libFuzzer itself is.
pub mod baseline {
    /// Looks at nothing.
    pub const fn check(_input: &[u8]) {}
}
