//! Windows on any processor, eight bytes at a time in general registers.

use super::words::{everywhere, zero_bytes};
use super::{Backend, Looked, Pieces, Places, WINDOW, keep_last};
use crate::crc::order::Msb;
use crate::crc::{UMTS_INIT, portable};
use crate::dynamixel2::{STUFFING_BYTE, STUFFING_PATTERN};

/// Any processor.
#[derive(Clone, Copy, Debug)]
pub(super) struct Portable;

impl Backend for Portable {
    #[inline]
    fn umts(self, bytes: &[u8]) -> u16 {
        portable::update::<Msb>(UMTS_INIT, bytes)
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
        // All 64 bytes, whatever the length: the end of a loop over `len` bytes is hard to predict.
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

    /// Eight neighbouring places are one `u64`; the words that begin one and two bytes later have
    /// the following bytes of each place. A byte of the combined word is zero where all bytes
    /// match.
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
        // Patterns are rare; without one, the places of stuffing are not needed.
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

/// Whether the bytes may have the pattern, the first byte lowest. May return true without a
/// pattern.
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

/// Some bit if some byte is zero, no bit otherwise.
#[inline]
const fn some_zero(word: u64) -> u64 {
    word.wrapping_sub(everywhere(1)) & !word & everywhere(0x80)
}

/// One bit for each zero byte of the words; the lowest bit is the lowest byte of the first word.
#[inline]
fn zeros(words: impl DoubleEndedIterator<Item = u64>) -> u64 {
    words.rev().fold(0, |bits, word| {
        // The product collects the eight bits, 7 apart, in the highest byte.
        bits << 8 | (zero_bytes(word) >> 7).wrapping_mul(0x0102_0408_1020_4080) >> 56
    })
}
