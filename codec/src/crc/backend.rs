//! Work on windows of 64 bytes, for code that is compiled once for each back end.
//!
//! A call into code for a particular processor is never inlined into code for any processor. So
//! it is the caller's whole inner loop, a [`Task`], that goes into
//! [`Engine::run`](super::Engine::run), and there the back end's functions become part of it.

use super::{Engine, UMTS_INIT};
use crate::dynamixel2::{STUFFING_BYTE, STUFFING_PATTERN};

/// Bytes of a window.
pub(crate) const WINDOW: usize = 64;

/// Work to be compiled for a back end's processor features. Its `run` has to be `inline(always)`:
/// what stays a function of its own is compiled for any processor.
pub(crate) trait Task {
    type Output;
    fn run(self, backend: impl Backend) -> Self::Output;
}

/// What stands where in a window; bit i of a set stands for byte i.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Places {
    /// Where FF FF FD begins.
    pub(crate) patterns: u64,
    /// Where the byte of stuffing, FD, stands. Only those that can be behind a pattern matter.
    pub(crate) stuffing: u64,
}

/// A packet, up to its CRC, that is not in one piece yet.
///
/// The prefix and the lead are not neighbours: a processor waits when it loads at once what it has
/// just stored in two pieces.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub(crate) struct Pieces<'a> {
    /// Header, ID, length and instruction, the first byte lowest.
    pub(crate) prefix: u64,
    /// How many parameters the lead has, less than eight.
    pub(crate) lead_len: usize,
    /// The first parameters, the first of them lowest, with zeros behind.
    pub(crate) lead: u64,
    /// The other parameters.
    pub(crate) tail: &'a [u8],
}

/// The task to look at it.
impl Task for Pieces<'_> {
    type Output = Option<Looked>;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> Option<Looked> {
        backend.look(self)
    }
}

/// What is known of a packet in pieces in which no pattern begins before the tail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Looked {
    /// Its CRC-16/UMTS, as it is without stuffing.
    pub(crate) crc: u16,
    /// Where in the tail FF FF FD begins; bit i stands for byte i.
    pub(crate) patterns: u64,
}

/// What a processor does best its own way.
pub(crate) trait Backend: Copy {
    /// As [`umts`](super::umts).
    fn umts(self, bytes: &[u8]) -> u16;

    /// What a packet needs. `None` if a pattern begins before its tail, the tail is longer than a
    /// window, or this back end is no faster with pieces than with the whole.
    fn look(self, pieces: Pieces<'_>) -> Option<Looked>;

    /// Whether the last `len` bytes of the window, at least two, end in the CRC-16/UMTS of those
    /// before, low byte first.
    fn ends_in_crc(self, window: &[u8; WINDOW], len: usize) -> bool;

    /// The patterns that are wholly in the window, and stuffing.
    fn places(self, window: &[u8; WINDOW]) -> Places;

    /// Where patterns may begin: if it is faster to tell, where FF FF does.
    fn pairs(self, window: &[u8; WINDOW]) -> u64;
}

/// Zeros, then as many ones: what to keep of a window's end.
static KEEP: [[u8; WINDOW]; 2] = [[0; WINDOW], [0xFF; WINDOW]];

/// Ones in the last `len` bytes of a window, zeros before.
#[inline]
pub(super) fn keep_last(len: usize) -> &'static [u8; WINDOW] {
    let kept = KEEP.as_flattened().get(len..).and_then(<[u8]>::first_chunk);
    kept.unwrap_or(&[0xFF; WINDOW]) // a window has no more
}

/// Any processor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Portable;

impl Backend for Portable {
    #[inline]
    fn umts(self, bytes: &[u8]) -> u16 {
        Engine::portable().umts(bytes)
    }

    #[inline]
    fn look(self, Pieces { prefix, lead, lead_len, tail }: Pieces<'_>) -> Option<Looked> {
        if !tail.is_empty() {
            return None;
        }
        const { assert!(UMTS_INIT == 0, "zeros in front must not change a CRC") }
        let packet = u128::from(lead) << 64 | u128::from(prefix);
        let zeros_in_front = packet << (64 - 8 * lead_len);
        (!may_have_pattern(packet >> 56))
            .then(|| Looked { crc: self.umts(&zeros_in_front.to_le_bytes()), patterns: 0 })
    }

    #[inline]
    fn ends_in_crc(self, window: &[u8; WINDOW], len: usize) -> bool {
        const { assert!(UMTS_INIT == 0, "zeros in front must not change a CRC") }
        // Of a fixed size, as a loop over a packet would end where no processor expects it.
        let mut bytes = *window;
        let words = bytes.as_chunks_mut().0.iter_mut().zip(keep_last(len).as_chunks().0);
        for (word, keep) in words {
            *word = (u64::from_ne_bytes(*word) & u64::from_ne_bytes(*keep)).to_ne_bytes();
        }
        let (half, all) = (bytes.last_chunk::<{ WINDOW / 2 + 2 }>(), bytes.split_last_chunk());
        let Some((before, found)) = all else {
            return false; // never: a window has two bytes
        };
        let before =
            half.filter(|_| len <= WINDOW / 2 + 2).map_or(before, |half| &half[..WINDOW / 2]);
        self.umts(before) == u16::from_le_bytes(*found)
    }

    /// Eight neighbouring places are one `u64`; the words that begin one and two bytes later hold
    /// what stands behind each. A byte of the combined word is zero where everything matches.
    #[inline]
    fn places(self, window: &[u8; WINDOW]) -> Places {
        let [first, second, third] = STUFFING_PATTERN.map(everywhere);
        let words = window.as_chunks::<8>().0;
        let mut mismatches = [u64::MAX; WINDOW / 8];
        let mut some = 0;
        for (index, mismatches) in mismatches.iter_mut().enumerate() {
            let word = words.get(index).copied().map_or(0, u64::from_le_bytes);
            let next = words.get(index + 1).copied().map_or(0, u64::from_le_bytes);
            let (one_on, two_on) = (word >> 8 | next << 56, word >> 16 | next << 48);
            *mismatches = (word ^ first) | (one_on ^ second) | (two_on ^ third);
            some |= some_zero(*mismatches);
        }
        // Patterns are rare, and where there is none nobody asks for stuffing.
        if some == 0 {
            return Places { patterns: 0, stuffing: 0 };
        }
        let stuffing =
            words.iter().map(|word| u64::from_le_bytes(*word) ^ everywhere(STUFFING_BYTE));
        Places { patterns: zeros(mismatches.into_iter()), stuffing: zeros(stuffing) }
    }

    #[inline]
    fn pairs(self, window: &[u8; WINDOW]) -> u64 {
        self.places(window).patterns
    }
}

/// Whether the pattern is among the bytes, the first of them lowest; perhaps also when it is not.
#[inline]
fn may_have_pattern(bytes: u128) -> bool {
    const fn everywhere(byte: u8) -> u128 {
        u128::from_ne_bytes([byte; size_of::<u128>()])
    }
    let [first, second, third] = STUFFING_PATTERN.map(everywhere);
    // Zero in the bytes where the pattern begins.
    let others = (bytes ^ first) | (bytes >> 8 ^ second) | (bytes >> 16 ^ third);
    others.wrapping_sub(everywhere(1)) & !others & everywhere(0x80) != 0
}

/// The byte in every place.
const fn everywhere(byte: u8) -> u64 {
    u64::from_ne_bytes([byte; 8])
}

/// Some bit if some byte is zero, no bit otherwise.
#[inline]
const fn some_zero(word: u64) -> u64 {
    word.wrapping_sub(everywhere(1)) & !word & everywhere(0x80)
}

/// A bit for each byte of the words that is zero, that of the first word's lowest byte the lowest.
#[inline]
fn zeros(words: impl DoubleEndedIterator<Item = u64>) -> u64 {
    const LOW_BITS: u64 = everywhere(0x7F);
    words.rev().fold(0, |bits, word| {
        // The sum carries into a byte's highest bit if a lower bit is set, and never out of it.
        let zeros = !(((word & LOW_BITS) + LOW_BITS) | word | LOW_BITS);
        // The product collects the eight bits, 7 apart, in the highest byte.
        bits << 8 | (zeros >> 7).wrapping_mul(0x0102_0408_1020_4080) >> 56
    })
}
