//! The back ends for x86-64, by carry-less multiplication.
//!
//! Each 64-bit word W of the message, i words from its end, is multiplied by
//! x^(64 i + 16) mod P; the sum V of the products, less than 80 bits, has the same remainder as
//! the message times x^16. One more product gives the quotient of V by P. As P is
//! x^16 + x^15 + x^2 + 1, its 16 lowest bits q give the remainder without a product:
//! V ^ q ^ q << 2 ^ q << 15.
//!
//! This is the only module of the crate with `unsafe`. It is needed for loads from a reference to
//! an array, and for calls of functions that need processor features; a value of [`Narrow`] or
//! [`Wide`] is the proof that the processor has them.
#![allow(unsafe_code)]

mod constants;
mod narrow;
mod pieces;
mod wide;
mod window;

use core::arch::x86_64::{__m128i, __m256i, _mm_loadu_si128, _mm256_loadu_si256};

#[cfg(feature = "std")]
use core::sync::atomic::{AtomicU8, Ordering};

use super::Task;
use crate::crc::order::Order;

/// Whether the processor has all of the features: detected at run time with `std`, otherwise those
/// enabled for the build.
macro_rules! has {
    ($($feature:tt)*) => {{
        #[cfg(feature = "std")]
        {
            static ANSWER: Answer = Answer::unknown();
            ANSWER.get(|| true $(&& std::is_x86_feature_detected!($feature))*)
        }
        #[cfg(not(feature = "std"))]
        {
            true $(&& cfg!(target_feature = $feature))*
        }
    }};
}

/// Whether the processor has a set of features, remembered: a load and a compare, where asking
/// for each feature would cost more than the CRC of a short packet.
#[cfg(feature = "std")]
struct Answer(AtomicU8);

#[cfg(feature = "std")]
impl Answer {
    const NO: u8 = 1;
    const YES: u8 = 2;

    const fn unknown() -> Self {
        Self(AtomicU8::new(0))
    }

    // Relaxed is enough: the answer is always the same.
    #[inline(always)]
    #[expect(clippy::inline_always, reason = "a call would cost more than the load")]
    fn get(&self, ask: impl FnOnce() -> bool) -> bool {
        match self.0.load(Ordering::Relaxed) {
            Self::YES => true,
            Self::NO => false,
            _ => self.set(ask()),
        }
    }

    #[cold]
    fn set(&self, answer: bool) -> bool {
        self.0.store(if answer { Self::YES } else { Self::NO }, Ordering::Relaxed);
        answer
    }
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
    #[expect(clippy::unused_self, reason = "its value is the proof")]
    pub(crate) fn update<O: Order>(self, state: u16, bytes: &[u8]) -> u16 {
        // SAFETY: `new` alone makes a `Narrow`, having found the features that the function needs.
        unsafe { narrow::update::<O>(state, bytes) }
    }

    /// Runs the task with these features.
    #[inline]
    pub(super) fn run<T: Task>(self, task: T) -> T::Output {
        #[target_feature(enable = "pclmulqdq,ssse3")]
        fn run<T: Task>(backend: Narrow, task: T) -> T::Output {
            task.run(backend)
        }
        // SAFETY: `new` alone makes a `Narrow`, having found the features that the function needs.
        unsafe { run(self, task) }
    }
}

/// Proof that the processor multiplies without carry in 256-bit registers.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wide(());

impl Wide {
    #[inline]
    pub(super) fn new() -> Option<Self> {
        has!("vpclmulqdq" "avx2" "pclmulqdq" "ssse3" "popcnt" "bmi1" "bmi2").then_some(Self(()))
    }

    /// The state after `bytes`.
    #[inline]
    #[expect(clippy::unused_self, reason = "its value is the proof")]
    pub(crate) fn update<O: Order>(self, state: u16, bytes: &[u8]) -> u16 {
        // SAFETY: `new` alone makes a `Wide`, having found the features that the function needs.
        unsafe { wide::update::<O>(state, bytes) }
    }

    /// Runs the task with these features.
    #[inline]
    pub(super) fn run<T: Task>(self, task: T) -> T::Output {
        #[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3,popcnt,bmi1,bmi2")]
        fn run<T: Task>(backend: Wide, task: T) -> T::Output {
            task.run(backend)
        }
        // SAFETY: `new` alone makes a `Wide`, having found the features that the function needs.
        unsafe { run(self, task) }
    }
}

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
