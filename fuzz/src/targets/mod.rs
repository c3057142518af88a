//! What each target does with its input.

pub mod crc;
pub mod fast_status;
pub mod innfos_frame;
pub mod innfos_stream;
mod model;
pub mod packet;
pub mod register;
pub mod spec_yaml;
mod stream;
pub mod stream_cost;
pub mod stream_raw;
pub mod stream_scenario;
pub mod stuffing;

use std::fmt::{self, Display, Write};

/// An error can be shown, and says something.
///
/// # Panics
/// If not.
pub(crate) fn shown(error: &impl Display) {
    /// Counts, as most errors are shown to nobody.
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

/// Does nothing: how fast libFuzzer itself is.
pub mod baseline {
    /// Looks at nothing.
    pub const fn check(_input: &[u8]) {}
}
