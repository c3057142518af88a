//! CRCs by 16-bit and 32-bit arithmetic: little code and no table. Used for messages of a few bytes
//! on every processor, and for all messages on a processor without 64-bit registers.
//!
//! [`portable`](super::portable) explains how a quotient is found.

use super::order::Order;

/// The state after `bytes`, four at a time.
pub(crate) fn update<O: Order>(state: u16, bytes: &[u8]) -> u16 {
    let (words, rest) = bytes.as_chunks();
    let state = words.iter().copied().fold(state, step4::<O>);
    rest.iter().copied().fold(state, step::<O>)
}

/// The state after one byte.
///
/// With b the byte plus the eight highest terms of the state, and p the sum of the terms of b, the
/// quotient q of b x^16 by P satisfies q (x + 1) = b x + p. Then q P, without its terms above x^15,
/// is b x + b x^2 + p (x^15 + x + 1).
#[inline]
pub(crate) fn step<O: Order>(state: u16, byte: u8) -> u16 {
    let [high, low] = state.to_be_bytes();
    if O::REFLECTED {
        let b = u16::from(low ^ byte);
        u16::from(high) ^ b << 7 ^ b << 6 ^ if_odd(b, 0xC001)
    } else {
        let b = u16::from(high ^ byte);
        u16::from(low) << 8 ^ b << 1 ^ b << 2 ^ if_odd(b, 0x8003)
    }
}

/// `value` if the byte `b` has an odd number of ones, and 0 otherwise, without a branch.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "a byte, and its ones")]
fn if_odd(b: u16, value: u16) -> u16 {
    ((b as u8).count_ones() as u16 & 1).wrapping_neg() & value
}

/// The state after four bytes: eight additions of a shifted word, each of them one instruction
/// on an ARM core, where a table takes four loads that wait for one another.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the remainder is 16 bits")]
fn step4<O: Order>(state: u16, bytes: [u8; 4]) -> u16 {
    let lower = |word: u32, by| if O::REFLECTED { word << by } else { word >> by };
    let mut quotient = if O::REFLECTED {
        u32::from_le_bytes(bytes) ^ u32::from(state)
    } else {
        u32::from_be_bytes(bytes) ^ u32::from(state) << 16
    };
    quotient ^= lower(quotient, 1) ^ lower(quotient, 14) ^ lower(quotient, 16);
    quotient ^= lower(quotient, 2) ^ lower(quotient, 28);
    quotient ^= lower(quotient, 4);
    quotient ^= lower(quotient, 8);
    quotient ^= lower(quotient, 16);
    if O::REFLECTED {
        ((quotient ^ quotient >> 2 ^ quotient >> 15) >> 16) as u16
    } else {
        (quotient ^ quotient << 2 ^ quotient << 15) as u16
    }
}
