//! The back end for ARM64, by carry-less multiplication in registers of 128 bits: any processor with PMULL,
//! which comes with the instructions for AES.
//!
//! Windows are searched by the portable back end; CRCs alone are multiplied.
#![allow(unsafe_code)]

mod pmull;

use core::arch::aarch64::{uint8x16_t, vld1q_u8};

use super::portable::Portable;
use super::unit::unit;
use super::{Backend, Looked, Pieces, Places, Processor, Task, WINDOW};
use crate::crc::order::{Msb, Order};

/// The fastest back end of this processor.
#[inline]
pub(super) fn fastest() -> Processor {
    Pmull::new().map_or(Processor::Portable, Processor::Pmull)
}

/// Proof that the processor multiplies without carry in 128-bit registers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pmull(());

impl Pmull {
    /// Whether it does is detected at run time with `std`, which remembers it; otherwise it is told by the build.
    #[inline]
    pub(super) fn new() -> Option<Self> {
        #[cfg(feature = "std")]
        let has = std::arch::is_aarch64_feature_detected!("aes");
        #[cfg(not(feature = "std"))]
        let has = cfg!(target_feature = "aes");
        // The order of lanes was thought of with the low byte first.
        (has && cfg!(target_endian = "little")).then_some(Self(()))
    }

    /// The state after `bytes`.
    #[inline]
    pub(crate) fn update<O: Order>(self, state: u16, bytes: &[u8]) -> u16 {
        // SAFETY: a `Pmull` is made only where the features that the function needs were found.
        unsafe { pmull::update::<O>(state, bytes, self) }
    }

    /// Runs the task with these features.
    #[inline]
    pub(super) fn run<T: Task>(self, task: T) -> T::Output {
        #[target_feature(enable = "neon,aes")]
        fn run<T: Task>(backend: Pmull, task: T) -> T::Output {
            task.run(backend)
        }
        // SAFETY: a `Pmull` is made only where the features that the function needs were found.
        unsafe { run(self, task) }
    }
}

impl Backend for Pmull {
    #[inline]
    fn umts(self, bytes: &[u8]) -> u16 {
        self.update::<Msb>(0, bytes)
    }

    #[inline]
    fn look(self, pieces: Pieces<'_>) -> Option<Looked> {
        Portable.look(pieces)
    }

    #[inline]
    fn ends_in_crc(self, window: &[u8; WINDOW], len: usize) -> bool {
        // SAFETY: a `Pmull` is made only where the features that the function needs were found.
        unsafe { pmull::ends_in_crc(window, len) }
    }

    #[inline]
    fn places(self, window: &[u8; WINDOW]) -> Places {
        Portable.places(window)
    }

    #[inline]
    fn pairs(self, window: &[u8; WINDOW]) -> u64 {
        Portable.pairs(window)
    }
}

unit!(Pmull, 16, uint8x16_t, pmull);

#[inline]
#[target_feature(enable = "neon")]
fn load(bytes: &[u8; 16]) -> uint8x16_t {
    // SAFETY: 16 bytes may be read from the reference, and the load asks for no alignment.
    unsafe { vld1q_u8(bytes.as_ptr()) }
}
