//! Messages of four to 16 bytes as one or two words, without a loop over the bytes.
//!
//! The words are *right-aligned*: the last byte of the message is the lowest, so that the same
//! constants serve every length. Two loads that may overlap fetch the bytes; neither reads outside
//! the slice.

use super::order::Order;

/// Four to eight bytes, with `state` added to the first two, as a word.
#[inline]
pub(crate) fn word<O: Order>(state: u16, bytes: &[u8]) -> u64 {
    let (Some(&first), Some(&last)) = (bytes.first_chunk(), bytes.last_chunk()) else {
        return 0; // never: callers see to the length
    };
    let spare = spare_bits(bytes);
    // Where the two overlap they have the same bytes, so "or" is right.
    let word = O::lower(half::<O>(first), spare) | O::lower(half::<O>(last), 32);
    word ^ O::lower(O::top(state), spare)
}

/// Nine to 16 bytes, with `state` added to the first two, as (high word, low word).
#[inline]
pub(crate) fn pair<O: Order>(state: u16, bytes: &[u8]) -> (u64, u64) {
    let (Some(&first), Some(&last)) = (bytes.first_chunk(), bytes.last_chunk()) else {
        return (0, 0); // never: callers see to the length
    };
    let (top, spare) = (O::top(state), spare_bits(bytes));
    // `lower` drops the bytes that `last` has too. Of a message of nine bytes it drops all but one,
    // and with them the state's second byte, which is added to `low` instead.
    let high = O::lower(O::load(first) ^ top, spare);
    let low = O::load(last) ^ O::raise(O::raise(top, 56 - spare), 8);
    (high, low)
}

/// How many bits the message leaves unused in its highest word, at most 56.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "masked")]
pub(crate) fn spare_bits(bytes: &[u8]) -> u32 {
    (bytes.len().wrapping_neg() & 7) as u32 * 8
}

/// Four bytes as the upper half of a word.
#[inline]
fn half<O: Order>([a, b, c, d]: [u8; 4]) -> u64 {
    O::load([a, b, c, d, 0, 0, 0, 0])
}
