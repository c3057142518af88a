//! Searches in windows of 64 bytes, with the fastest instructions that the processor has.
//!
//! A [`Task`] is a loop over windows. [`run`] compiles it once for each back end and picks the one
//! for this machine. A [`Backend`] finds the pattern of byte stuffing in a window, and checks
//! whether a window ends in its CRC. All of the crate's `unsafe` is in `aarch64` and `x86_64`; the
//! arithmetic of CRCs is in [`crc`](crate::crc).

#[cfg(target_arch = "aarch64")]
mod aarch64;
#[cfg(any(test, feature = "meter"))]
pub mod meter;
#[cfg(not(any(test, feature = "meter")))]
pub(crate) mod meter;
mod portable;
mod search;
#[cfg(test)]
mod tests;
#[cfg(any(target_arch = "aarch64", target_arch = "x86_64"))]
mod unit;
mod words;
#[cfg(target_arch = "x86_64")]
mod x86_64;

#[cfg(target_arch = "aarch64")]
use aarch64::Pmull;
use portable::Portable;
pub(crate) use search::{header, patterns};
#[cfg(target_arch = "x86_64")]
use x86_64::{Narrow, Wide};

/// Whether the processor has registers of 64 bits. Without them a window costs more than it saves, in
/// time and in code, so that everything is done byte by byte.
pub(crate) const HAS_WORDS: bool = cfg!(any(target_pointer_width = "64", target_family = "wasm"));

/// Bytes of a window.
pub(crate) const WINDOW: usize = 64;

/// Work that is compiled once for each back end, with that back end's processor features.
///
/// The compiler never inlines a function that needs processor features into one that does not. So
/// the caller's whole inner loop is the task, and its `run` is `inline(always)`: a function that is
/// not inlined would be compiled without the features.
pub(crate) trait Task {
    type Output;
    fn run(self, backend: impl Backend) -> Self::Output;
}

/// The places found in a window; bit i of a set is byte i.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Places {
    /// Where FF FF FD begins.
    pub(crate) patterns: u64,
    /// The places of the stuffing byte, FD. Only places after a pattern matter.
    pub(crate) stuffing: u64,
}

/// A packet, up to its CRC, that is still in pieces.
///
/// The prefix and the lead are not neighbours in memory, so that no compiler loads both at once: a
/// processor has to wait when one load covers two stores that it has just made.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Pieces<'a> {
    /// Header, ID, length and instruction, the first byte lowest.
    pub(crate) prefix: u64,
    /// The number of parameters in the lead, fewer than eight.
    pub(crate) lead_len: usize,
    /// The first parameters, the first one lowest, padded with zeros.
    pub(crate) lead: u64,
    /// The other parameters.
    pub(crate) tail: &'a [u8],
}

/// The task that examines it.
impl Task for Pieces<'_> {
    type Output = Option<Looked>;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> Option<Looked> {
        backend.look(self)
    }
}

/// The CRC and patterns of a packet in pieces in which no pattern begins before the tail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Looked {
    /// Its CRC-16/UMTS without stuffing.
    pub(crate) crc: u16,
    /// The places in the tail at which FF FF FD begins; bit i is byte i.
    pub(crate) patterns: u64,
}

/// What each back end does with the instructions of its processor.
pub(crate) trait Backend: Copy {
    /// As [`crc::umts`](crate::crc::umts).
    fn umts(self, bytes: &[u8]) -> u16;

    /// Examines a packet in pieces. `None` if a pattern begins before its tail, the tail is longer
    /// than a window, or this back end is no faster with pieces than with the whole packet.
    fn look(self, pieces: Pieces<'_>) -> Option<Looked>;

    /// Whether the last two of the last `len` bytes of the window are the CRC-16/UMTS of the
    /// others, low byte first. `len` is at least two.
    fn ends_in_crc(self, window: &[u8; WINDOW], len: usize) -> bool;

    /// The patterns that are wholly in the window, and stuffing.
    fn places(self, window: &[u8; WINDOW]) -> Places;

    /// The places at which patterns may begin; these may be the places of FF FF if that is faster.
    fn pairs(self, window: &[u8; WINDOW]) -> u64;
}

/// Zeros, then as many ones: a mask for the end of a window.
static KEEP: [[u8; WINDOW]; 2] = [[0; WINDOW], [0xFF; WINDOW]];

/// Ones in the last `len` bytes of a window, zeros before.
#[inline]
fn keep_last(len: usize) -> &'static [u8; WINDOW] {
    let kept = KEEP.as_flattened().get(len..).and_then(<[u8]>::first_chunk);
    kept.unwrap_or(&[0xFF; WINDOW]) // a window has no more
}

/// The features of this machine's processor, detected once.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Processor {
    Portable,
    #[cfg(target_arch = "aarch64")]
    Pmull(Pmull),
    #[cfg(target_arch = "x86_64")]
    Narrow(Narrow),
    #[cfg(target_arch = "x86_64")]
    Wide(Wide),
}

impl Processor {
    /// The fastest back end of this machine.
    #[inline]
    pub(crate) fn new() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            x86_64::fastest()
        }
        #[cfg(target_arch = "aarch64")]
        {
            aarch64::fastest()
        }
        #[cfg(not(any(target_arch = "aarch64", target_arch = "x86_64")))]
        {
            Self::Portable
        }
    }

    /// All back ends that this machine supports, [`Processor::Portable`] first.
    pub(crate) fn all() -> impl Iterator<Item = Self> {
        #[cfg(target_arch = "x86_64")]
        let special = [
            Narrow::new().map(Self::Narrow),
            Wide::new().map(Self::Wide),
            Wide::widest().map(Self::Wide),
        ];
        #[cfg(target_arch = "aarch64")]
        let special = [Pmull::new().map(Self::Pmull)];
        #[cfg(not(any(target_arch = "aarch64", target_arch = "x86_64")))]
        let special: [Option<Self>; 0] = [];
        [Self::Portable].into_iter().chain(special.into_iter().flatten())
    }

    /// Runs the task for this processor.
    #[inline]
    pub(crate) fn run<T: Task>(self, task: T) -> T::Output {
        match self {
            Self::Portable => portable(task),
            #[cfg(target_arch = "aarch64")]
            Self::Pmull(pmull) => pmull.run(task),
            #[cfg(target_arch = "x86_64")]
            Self::Narrow(narrow) => narrow.run(task),
            #[cfg(target_arch = "x86_64")]
            Self::Wide(wide) => wide.run(task),
        }
    }
}

/// Runs the task with the fastest back end of this machine.
#[inline]
pub(crate) fn run<T: Task>(task: T) -> T::Output {
    Processor::new().run(task)
}

/// A separate function, as for the other back ends.
#[inline(never)]
fn portable<T: Task>(task: T) -> T::Output {
    task.run(Portable)
}
