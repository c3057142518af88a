//! The choice of a back end.

use super::order::{Lsb, Msb, Order};
use super::{MODBUS_INIT, UMTS_INIT, portable};
use crate::simd::Processor;

/// The fastest back end for CRCs on this machine.
///
/// The free functions of [`crc`](super) look it up on every call, which costs a load and a
/// jump. A loop over many short packets keeps an `Engine` instead, which is one byte: every call
/// then begins with one branch that the processor predicts.
///
/// With the feature `std`, the processor is detected at run time. Without it, only instructions
/// that were enabled for the build (`-C target-feature`) are used. All engines give the same
/// results.
///
/// ```
/// use actucheck_codec::crc::{self, Engine};
///
/// let engine = Engine::new();
/// for packet in [&b"one"[..], b"another"] {
///     assert_eq!(engine.umts(packet), crc::umts(packet));
///     assert_eq!(engine.modbus(packet), Engine::portable().modbus(packet));
/// }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Engine(Processor);

impl Default for Engine {
    fn default() -> Self {
        Self::new()
    }
}

impl Engine {
    /// The best engine for this machine.
    #[must_use]
    #[inline]
    pub fn new() -> Self {
        Self(Processor::new())
    }

    /// The engine that runs on every processor.
    #[must_use]
    #[inline]
    pub const fn portable() -> Self {
        Self(Processor::Portable)
    }

    /// Every engine that this machine can run, the portable one first: for tests that compare
    /// them.
    pub fn all() -> impl Iterator<Item = Self> {
        Processor::all().map(Self)
    }

    /// The size of the registers that it computes long messages in: 64, 128, 256 or 512 bits.
    ///
    /// ```
    /// use actucheck_codec::crc::Engine;
    ///
    /// let sizes: Vec<_> = Engine::all().map(Engine::bits).collect();
    /// assert!(sizes.is_sorted());
    /// assert_eq!(Some(&Engine::new().bits()), sizes.last());
    /// ```
    #[must_use]
    pub const fn bits(self) -> u32 {
        match self.0 {
            Processor::Portable => 64,
            #[cfg(target_arch = "aarch64")]
            Processor::Pmull(_) => 128,
            #[cfg(target_arch = "x86_64")]
            Processor::Narrow(_) => 128,
            #[cfg(target_arch = "x86_64")]
            Processor::Wide(wide) => wide.bits(),
        }
    }

    /// As [`crc::umts`](super::umts).
    #[must_use]
    #[inline]
    pub fn umts(self, bytes: &[u8]) -> u16 {
        self.umts_update(UMTS_INIT, bytes)
    }

    /// As [`crc::umts_update`](super::umts_update).
    #[must_use]
    #[inline]
    pub fn umts_update(self, state: u16, bytes: &[u8]) -> u16 {
        self.update::<Msb>(state, bytes)
    }

    /// As [`crc::modbus`](super::modbus).
    #[must_use]
    #[inline]
    pub fn modbus(self, bytes: &[u8]) -> u16 {
        self.modbus_update(MODBUS_INIT, bytes)
    }

    /// As [`crc::modbus_update`](super::modbus_update).
    #[must_use]
    #[inline]
    pub fn modbus_update(self, state: u16, bytes: &[u8]) -> u16 {
        self.update::<Lsb>(state, bytes)
    }

    #[inline]
    fn update<O: Order>(self, state: u16, bytes: &[u8]) -> u16 {
        match self.0 {
            Processor::Portable => portable::update::<O>(state, bytes),
            #[cfg(target_arch = "aarch64")]
            Processor::Pmull(pmull) => pmull.update::<O>(state, bytes),
            #[cfg(target_arch = "x86_64")]
            Processor::Narrow(narrow) => narrow.update::<O>(state, bytes),
            #[cfg(target_arch = "x86_64")]
            Processor::Wide(wide) => wide.update::<O>(state, bytes),
        }
    }
}
