//! Fuzz targets as plain functions: libFuzzer calls them, and so does every test run.
//!
//! A target panics when its oracle finds the codec wrong; that is its whole interface.

#![allow(clippy::panic, clippy::indexing_slicing, clippy::unwrap_used)] // a panic is the finding

#[cfg(fuzzing)]
pub use libfuzzer_sys;

pub mod targets;

/// A target by its name.
pub struct Target {
    /// Its name, which is that of its binary too.
    pub name: &'static str,
    /// What is called with each input.
    pub body: fn(&[u8]),
}

/// Every target.
pub const TARGETS: [Target; 2] = [
    Target { name: "frame", body: targets::frame },
    Target { name: "stuffing", body: targets::stuffing },
];

/// The `main` of a target's binary: libFuzzer's under cargo-fuzz, else a replay of the files that
/// are named on the command line.
#[macro_export]
macro_rules! shim {
    ($name:ident) => {
        #[cfg(fuzzing)]
        mod shim {
            #![allow(unsafe_code, missing_docs)] // libFuzzer's entry point is a C symbol
            $crate::libfuzzer_sys::fuzz_target!(|data: &[u8]| $crate::targets::$name(data));
        }

        #[cfg(not(fuzzing))]
        fn main() -> std::io::Result<()> {
            for path in std::env::args_os().skip(1) {
                $crate::targets::$name(&std::fs::read(path)?);
            }
            Ok(())
        }
    };
}
