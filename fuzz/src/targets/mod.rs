//! The targets.

#[cfg(feature = "suite")]
pub mod bus;
pub mod crc;
pub mod fast_status;
#[cfg(feature = "suite")]
pub mod forms;
pub mod innfos_frame;
pub mod innfos_stream;
mod model;
pub mod packet;
#[cfg(feature = "suite")]
pub mod readers;
pub mod register;
pub mod spec_yaml;
mod stream;
pub mod stream_cost;
pub mod stream_raw;
pub mod stream_scenario;
pub mod stuffing;

use std::fmt::{self, Display, Write};

/// Asserts that an error can be displayed and is not empty.
///
/// # Panics
/// If it is empty.
pub(crate) fn shown(error: &impl Display) {
    /// Only counts the bytes, as most errors are not shown.
    struct Length(usize);
    impl Write for Length {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            self.0 += text.len();
            Ok(())
        }
    }
    let mut length = Length(0);
    assert!(write!(length, "{error}").is_ok() && length.0 > 0, "an error without a word");
}

/// Does nothing: measures the speed of libFuzzer itself.
pub mod baseline {
    /// Ignores the input.
    pub const fn check(_input: &[u8]) {}
}
