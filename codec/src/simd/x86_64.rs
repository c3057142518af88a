//! The back ends for x86-64, by carry-less multiplication in registers of 128, 256 and 512 bits.
//!
//! [`product`](crate::crc::product) has the sum V of the products of a message's words. One more
//! product gives the quotient of V by P. As P is x^16 + x^15 + x^2 + 1, its 16 lowest bits q give
//! the remainder without a product: V ^ q ^ q << 2 ^ q << 15.
//!
//! This is the only module of the crate with `unsafe`. It is needed for loads from a reference to
//! an array, and for calls of functions that need processor features; a value of [`Narrow`],
//! [`Wide`] or [`Widest`] is the proof that the processor has them.
#![allow(unsafe_code)]

mod narrow;
mod pieces;
mod wide;
mod widest;
mod window;

use core::arch::x86_64::{
    __m128i, __m256i, __m512i, _mm_loadu_si128, _mm256_loadu_si256, _mm512_loadu_si512,
};

#[cfg(feature = "std")]
use core::sync::atomic::{AtomicU8, Ordering};

use super::unit::unit;
use super::{Processor, Task};
use crate::crc::order::Order;

/// Whether the processor has all of the features: detected at run time with `std`, otherwise those
/// enabled for the build.
macro_rules! has {
    ($($feature:tt)*) => {{
        #[cfg(feature = "std")]
        {
            true $(&& std::is_x86_feature_detected!($feature))*
        }
        #[cfg(not(feature = "std"))]
        {
            true $(&& cfg!(target_feature = $feature))*
        }
    }};
}

/// The fastest back end of this processor.
#[cfg(not(feature = "std"))]
pub(super) fn fastest() -> Processor {
    detect()
}

/// The fastest back end of this processor, remembered: a load and a jump, where asking for each
/// feature would cost more than the CRC of a short packet.
#[cfg(feature = "std")]
#[inline(always)]
#[expect(clippy::inline_always, reason = "a call would cost more than the load")]
pub(super) fn fastest() -> Processor {
    // Only what was detected is remembered. Relaxed is enough: the answer is always the same.
    match remembered::FASTEST.load(Ordering::Relaxed) {
        remembered::WIDEST => Processor::Wide(Wide { widest: Some(Widest(())) }),
        remembered::WIDE => Processor::Wide(Wide { widest: None }),
        remembered::NARROW => Processor::Narrow(Narrow(())),
        remembered::PORTABLE => Processor::Portable,
        _ => remembered::ask(),
    }
}

#[cfg(feature = "std")]
mod remembered {
    use super::{AtomicU8, Ordering, Processor, Wide, detect};

    /// Unknown at first.
    pub(super) static FASTEST: AtomicU8 = AtomicU8::new(0);
    pub(super) const PORTABLE: u8 = 1;
    pub(super) const NARROW: u8 = 2;
    pub(super) const WIDE: u8 = 3;
    pub(super) const WIDEST: u8 = 4;

    #[cold]
    pub(super) fn ask() -> Processor {
        let fastest = detect();
        let number = match fastest {
            Processor::Portable => PORTABLE,
            Processor::Narrow(_) => NARROW,
            Processor::Wide(Wide { widest: None }) => WIDE,
            Processor::Wide(Wide { widest: Some(_) }) => WIDEST,
        };
        FASTEST.store(number, Ordering::Relaxed);
        fastest
    }
}

/// Asks the processor, or the build, from the fastest back end down.
fn detect() -> Processor {
    let wide = || Wide::widest().or_else(Wide::new).map(Processor::Wide);
    let narrow = || Narrow::new().map(Processor::Narrow);
    wide().or_else(narrow).unwrap_or(Processor::Portable)
}

/// Proof that the processor multiplies without carry in 128-bit registers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Narrow(());

impl Narrow {
    #[inline]
    pub(super) fn new() -> Option<Self> {
        has!("pclmulqdq" "ssse3").then_some(Self(()))
    }

    /// The state after `bytes`.
    #[inline]
    pub(crate) fn update<O: Order>(self, state: u16, bytes: &[u8]) -> u16 {
        // SAFETY: a `Narrow` is made only where the features that the function needs were found.
        unsafe { narrow::update::<O>(self, state, bytes) }
    }

    /// Runs the task with these features.
    #[inline]
    pub(super) fn run<T: Task>(self, task: T) -> T::Output {
        #[target_feature(enable = "pclmulqdq,ssse3")]
        fn run<T: Task>(backend: Narrow, task: T) -> T::Output {
            task.run(backend)
        }
        // SAFETY: a `Narrow` is made only where the features that the function needs were found.
        unsafe { run(self, task) }
    }
}

/// Proof that the processor multiplies without carry in 256-bit registers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide {
    /// Wider registers for long messages, if there are some. Windows need none.
    widest: Option<Widest>,
}

impl Wide {
    #[inline]
    pub(super) fn new() -> Option<Self> {
        has!("vpclmulqdq" "avx2" "pclmulqdq" "ssse3" "popcnt" "bmi1" "bmi2")
            .then_some(Self { widest: None })
    }

    /// With wider registers for long messages.
    #[inline]
    pub(super) fn widest() -> Option<Self> {
        Self::new()?;
        let widest = has!("avx512f" "avx512bw" "avx512vbmi").then_some(Widest(()))?;
        Some(Self { widest: Some(widest) })
    }

    /// The size of its widest registers.
    pub(crate) const fn bits(self) -> u32 {
        if self.widest.is_some() { 512 } else { 256 }
    }

    /// The state after `bytes`.
    #[inline]
    pub(crate) fn update<O: Order>(self, state: u16, bytes: &[u8]) -> u16 {
        // SAFETY: a `Wide` is made only where the features that the function needs were found.
        unsafe { wide::update::<O>(state, bytes, self) }
    }

    /// Runs the task with these features.
    #[inline]
    pub(super) fn run<T: Task>(self, task: T) -> T::Output {
        #[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3,popcnt,bmi1,bmi2")]
        fn run<T: Task>(backend: Wide, task: T) -> T::Output {
            task.run(backend)
        }
        // SAFETY: a `Wide` is made only where the features that the function needs were found.
        unsafe { run(self, task) }
    }
}

/// Proof that the processor multiplies without carry in 512-bit registers, and in those of 256 bits.
#[derive(Clone, Copy, Debug)]
struct Widest(());

impl Widest {
    /// The state after `bytes`, at least [`widest::LEAST`].
    #[inline]
    fn update<O: Order>(self, state: u16, bytes: &[u8]) -> u16 {
        // SAFETY: a `Widest` is made only where the features that the function needs were found.
        unsafe { widest::update::<O>(self, state, bytes) }
    }
}

unit!(Narrow, 16, __m128i, narrow);
unit!(Wide, 32, __m256i, wide);
unit!(Widest, 64, __m512i, widest);

#[inline]
fn load128(bytes: &[u8; 16]) -> __m128i {
    // SAFETY: 16 bytes may be read from the reference, and the load asks for no alignment. SSE2
    // is part of x86-64.
    unsafe { _mm_loadu_si128(bytes.as_ptr().cast()) }
}

#[inline]
#[target_feature(enable = "avx")]
fn load256(bytes: &[u8; 32]) -> __m256i {
    // SAFETY: 32 bytes may be read from the reference, and the load asks for no alignment.
    unsafe { _mm256_loadu_si256(bytes.as_ptr().cast()) }
}

#[inline]
#[target_feature(enable = "avx512f")]
fn load512(bytes: &[u8; 64]) -> __m512i {
    // SAFETY: 64 bytes may be read from the reference, and the load asks for no alignment.
    unsafe { _mm512_loadu_si512(bytes.as_ptr().cast()) }
}
