//! Fuzz targets as plain functions: libFuzzer calls them, and so does every test run.
//!
//! A target panics when its oracle finds the code wrong; that is its whole interface. Expected
//! results come from the spec's reference model or from the documents' YAML, never from the codec.

#![allow(clippy::panic, clippy::indexing_slicing, clippy::unwrap_used)] // a panic is the finding

use actucheck_spec::wire::{self, Wire};

#[cfg(feature = "suite")]
mod dictionary;
mod draw;
#[cfg(feature = "suite")]
pub mod published;
pub mod targets;
mod yaml;

#[cfg(fuzzing)]
pub use libfuzzer_sys;

/// A target, and what libFuzzer should know about it.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// Its name, which is that of its module, its binary and its folders too.
    pub name: &'static str,
    /// Compares the code under test with the oracle for one input.
    ///
    /// # Panics
    /// If the code under test is wrong.
    pub check: fn(&[u8]),
    /// Mends lengths and CRCs in an input, so that mutations get past their checks. Inputs reach
    /// [`Target::check`] without it too.
    pub repair: Option<fn(&mut [u8])>,
    /// The family of its inputs: a folder of `seeds/`, and a dictionary of that name.
    pub seeds: Seeds,
    /// The longest input worth trying, in bytes.
    pub max_len: usize,
}

/// A family of inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Seeds {
    /// Frames of a wire.
    Wire(Wire),
    /// Files of a spec folder.
    Yaml,
    /// Texts that the suite reads.
    Texts,
    /// Bytes as people paste them.
    Forms,
}

impl Seeds {
    /// Every family.
    pub fn all() -> impl Iterator<Item = Self> {
        Wire::ALL.into_iter().map(Self::Wire).chain([Self::Yaml, Self::Texts, Self::Forms])
    }

    /// Its folder's name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wire(wire) => wire.id(),
            Self::Yaml => "yaml",
            Self::Texts => "texts",
            Self::Forms => "forms",
        }
    }
}

const DYNAMIXEL2: Seeds = Seeds::Wire(wire::dynamixel2::WIRE);
const INNFOS: Seeds = Seeds::Wire(wire::innfos::WIRE);
const YAML: Seeds = Seeds::Yaml;
#[cfg(feature = "suite")]
const TEXTS: Seeds = Seeds::Texts;
#[cfg(feature = "suite")]
const FORMS: Seeds = Seeds::Forms;

macro_rules! table {
    ($($(#[$when:meta])* $name:ident $(, $repair:ident)?: $seeds:ident, $max_len:literal;)*) => {
        /// Every target.
        pub const TARGETS: &[Target] = &[$($(#[$when])* Target {
            name: stringify!($name),
            check: targets::$name::check,
            repair: table!(@ $($repair targets::$name::repair)?),
            seeds: $seeds,
            max_len: $max_len,
        }),*];
    };
    (@) => { None };
    (@ repair $path:path) => { Some($path) };
}

table! {
    stuffing: DYNAMIXEL2, 128;
    crc: DYNAMIXEL2, 128;
    stream_raw, repair: DYNAMIXEL2, 1500;
    stream_scenario: DYNAMIXEL2, 1000;
    stream_cost, repair: DYNAMIXEL2, 2000;
    packet, repair: DYNAMIXEL2, 160;
    register: DYNAMIXEL2, 64;
    fast_status, repair: DYNAMIXEL2, 160;
    innfos_frame, repair: INNFOS, 300;
    innfos_stream, repair: INNFOS, 500;
    spec_yaml: YAML, 2000;
    #[cfg(feature = "suite")]
    readers: TEXTS, 12000;
    #[cfg(feature = "suite")]
    forms: FORMS, 300;
    #[cfg(feature = "suite")]
    bus: DYNAMIXEL2, 400;
}

/// The `main` of a target's binary: libFuzzer's under cargo-fuzz, else a replay of the files that
/// are named on the command line. `repair` gives libFuzzer the target's own mutations.
#[macro_export]
macro_rules! shim {
    ($name:ident $(, $repair:ident)?) => {
        #[cfg(fuzzing)]
        mod shim {
            #![allow(unsafe_code, missing_docs)] // libFuzzer's entry points are C symbols
            $crate::libfuzzer_sys::fuzz_target!(|data: &[u8]| $crate::targets::$name::check(data));
            $crate::shim!(@ $($repair $name)?);
        }

        #[cfg(not(fuzzing))]
        fn main() -> std::io::Result<()> {
            for path in std::env::args_os().skip(1) {
                $crate::targets::$name::check(&std::fs::read(path)?);
            }
            Ok(())
        }
    };
    (@) => {};
    (@ repair $name:ident) => {
        use $crate::libfuzzer_sys; // where the macro looks for it
        libfuzzer_sys::fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
            let size = libfuzzer_sys::fuzzer_mutate(data, size, max_size);
            // Wrong lengths and CRCs must be tried too.
            if seed % 4 != 0 {
                data.get_mut(..size).map($crate::targets::$name::repair);
            }
            size
        });
    };
}
