//! The instructions: NEON, and PMULL.

use core::arch::aarch64::{
    uint8x16_t, vandq_u8, vcombine_u64, vcreate_u64, vdupq_n_u8, veorq_u8, vextq_u8,
    vgetq_lane_u64, vmull_high_p64, vmull_p64, vqtbl1q_u8, vreinterpretq_p64_u8,
    vreinterpretq_u8_p128, vreinterpretq_u8_u64, vreinterpretq_u64_u8, vrev64q_u8,
};

use super::super::{WINDOW, keep_last};
use super::Pmull;
use crate::crc::factors::{factors, inverse};
use crate::crc::order::{Msb, Order};
use crate::crc::product;
use crate::crc::{compact, short};

pub(super) use super::load;

/// From this many bytes on, folding is faster on x86-64; not measured here.
const LONG: usize = 513;

/// The state after `bytes`.
#[target_feature(enable = "neon,aes")]
pub(super) fn update<O: Order>(state: u16, bytes: &[u8], pmull: Pmull) -> u16 {
    if bytes.len() <= 16 {
        return update_short::<O>(state, bytes);
    }
    if bytes.len() < LONG {
        return product::medium::<O, _, 16>(pmull, state, bytes);
    }
    let (state, tail) = product::long::<O, _, 16>(pmull, state, bytes);
    if tail.is_empty() { state } else { update_short::<O>(state, tail) }
}

/// At most 16 bytes.
#[inline]
#[target_feature(enable = "neon,aes")]
fn update_short<O: Order>(state: u16, bytes: &[u8]) -> u16 {
    match bytes.len() {
        0..=3 => compact::update::<O>(state, bytes),
        // A single word times x^16 needs no factor.
        4..=8 => finish::<O>(pair::<O>(short::word::<O>(state, bytes), 0)),
        _ => {
            let (high, low) = short::pair::<O>(state, bytes);
            // There are some.
            let factors = factors::<O, 16>().last().unwrap_or(&[0; 16]);
            finish::<O>(multiply(pair::<O>(high, low), load(factors)))
        }
    }
}

/// As [`Backend::ends_in_crc`](super::super::Backend::ends_in_crc): a packet is right if it is a multiple of P with
/// its CRC's high byte first. Zeros in front change nothing, and neither does the factor that the constants carry.
#[inline]
#[target_feature(enable = "neon,aes")]
pub(super) fn ends_in_crc(window: &[u8; WINDOW], len: usize) -> bool {
    let blocks = window.as_chunks().0.iter().zip(keep_last(len).as_chunks().0);
    let factors = factors::<Msb, 16>();
    let factors = factors.iter().skip(factors.len() - WINDOW / 16);
    let mut sum = zero();
    for (index, ((block, keep), factor)) in blocks.zip(factors).enumerate() {
        let mut words = arrange::<Msb>(vandq_u8(load(block), load(keep)));
        if index == WINDOW / 16 - 1 {
            words = vqtbl1q_u8(words, load(&LAST_SWAPPED));
        }
        sum = add(sum, multiply(words, load(factor)));
    }
    finish::<Msb>(sum) == 0
}

/// The last two bytes of a block, which are the first ones of its words, change places.
static LAST_SWAPPED: [u8; 16] = [1, 0, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

#[inline]
#[target_feature(enable = "neon")]
pub(super) fn zero() -> uint8x16_t {
    vdupq_n_u8(0)
}

#[inline]
#[target_feature(enable = "neon")]
pub(super) fn add(a: uint8x16_t, b: uint8x16_t) -> uint8x16_t {
    veorq_u8(a, b)
}

/// Whether the block has an odd number of ones.
#[inline]
#[target_feature(enable = "neon")]
pub(super) fn odd(block: uint8x16_t) -> bool {
    let (high, low) = halves(block);
    (high ^ low).count_ones() % 2 == 1
}

/// As [`Multiplies::head`](product::Multiplies::head).
#[inline]
#[target_feature(enable = "neon")]
pub(super) fn head<O: Order>(state: u16, bytes: &[u8], used: usize) -> uint8x16_t {
    /// From place 16 - n on, this says what to take for every place: nothing n times (an index that
    /// is too large), then bytes 0, 1, …
    static INDICES: [u8; 32] = {
        let mut indices = [0x80; 32];
        let (_, taken) = indices.split_at_mut(16);
        let mut i = 0_u8;
        while i < 16 {
            taken[i as usize] = i;
            i += 1;
        }
        indices
    };
    let indices = INDICES.get(used..).and_then(<[u8]>::first_chunk);
    let (Some(first), Some(indices)) = (bytes.first_chunk(), indices) else {
        return zero(); // never: shorter messages go elsewhere
    };
    let state = if O::REFLECTED { state } else { state.swap_bytes() };
    let state = vreinterpretq_u8_u64(vcombine_u64(vcreate_u64(state.into()), vcreate_u64(0)));
    vqtbl1q_u8(add(load(first), state), load(indices))
}

/// A block in memory order as two words in a register.
#[inline]
#[target_feature(enable = "neon")]
pub(super) fn arrange<O: Order>(block: uint8x16_t) -> uint8x16_t {
    if O::REFLECTED {
        return block;
    }
    let words = vrev64q_u8(block);
    vextq_u8::<8>(words, words)
}

/// Two words in a register as [`arrange`] would have them.
#[inline]
#[target_feature(enable = "neon")]
fn pair<O: Order>(high: u64, low: u64) -> uint8x16_t {
    let (first, second) = if O::REFLECTED { (high, low) } else { (low, high) };
    vreinterpretq_u8_u64(vcombine_u64(vcreate_u64(first), vcreate_u64(second)))
}

/// The sum of the words times their factors.
#[inline]
#[target_feature(enable = "neon,aes")]
pub(super) fn multiply(words: uint8x16_t, factors: uint8x16_t) -> uint8x16_t {
    let ((_, low), (_, factor)) = (halves(words), halves(factors));
    let high = vmull_high_p64(vreinterpretq_p64_u8(words), vreinterpretq_p64_u8(factors));
    add(product_of(low, factor), vreinterpretq_u8_p128(high))
}

/// The remainder by P of a sum of products that carries a factor x^48.
#[inline]
#[target_feature(enable = "neon,aes")]
#[expect(clippy::cast_possible_truncation, reason = "16 bits are wanted")]
pub(super) fn finish<O: Order>(sum: uint8x16_t) -> u16 {
    let (high, low) = halves(sum);
    // Half of the sum is above x^16; the quotient is what is above x^64 in that times the inverse.
    if O::REFLECTED {
        let quotient = (halves(product_of(low, inverse::<O>())).1 >> 48) as u16;
        high as u16 ^ quotient ^ quotient >> 2 ^ quotient >> 15
    } else {
        // The inverse's highest term, which did not fit, adds the sum itself.
        let quotient = (halves(product_of(high, inverse::<O>())).0 ^ high) as u16;
        (low >> 48) as u16 ^ quotient ^ quotient << 2 ^ quotient << 15
    }
}

#[inline]
#[target_feature(enable = "neon,aes")]
fn product_of(a: u64, b: u64) -> uint8x16_t {
    vreinterpretq_u8_p128(vmull_p64(a, b))
}

/// The upper and the lower word of a register.
#[inline]
#[target_feature(enable = "neon")]
fn halves(register: uint8x16_t) -> (u64, u64) {
    let words = vreinterpretq_u64_u8(register);
    (vgetq_lane_u64::<1>(words), vgetq_lane_u64::<0>(words))
}
