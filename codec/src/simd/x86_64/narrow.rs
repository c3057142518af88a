//! 128-bit registers: any processor with PCLMULQDQ.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use core::arch::x86_64::{
    __m128i, _mm_clmulepi64_si128, _mm_cvtsi32_si128, _mm_cvtsi128_si64, _mm_extract_epi16,
    _mm_set_epi8, _mm_set_epi64x, _mm_setzero_si128, _mm_shuffle_epi8, _mm_unpackhi_epi64,
    _mm_xor_si128,
};

use super::{Narrow, load128};
use crate::crc::factors::{factors, inverse};
use crate::crc::order::Order;
use crate::crc::product;
use crate::crc::{compact, short};

/// From this many bytes on, folding is faster.
const LONG: usize = 513;

/// The state after `bytes`.
#[target_feature(enable = "pclmulqdq,ssse3")]
pub(super) fn update<O: Order>(narrow: Narrow, state: u16, bytes: &[u8]) -> u16 {
    if bytes.len() <= 16 {
        return update_short::<O>(state, bytes);
    }
    if bytes.len() < LONG {
        product::medium::<O, _, 16>(narrow, state, bytes)
    } else {
        long::<O>(narrow, state, bytes)
    }
}

#[inline(never)]
#[target_feature(enable = "pclmulqdq,ssse3")]
fn long<O: Order>(narrow: Narrow, state: u16, bytes: &[u8]) -> u16 {
    let (state, tail) = product::long::<O, _, 16>(narrow, state, bytes);
    if tail.is_empty() { state } else { update_short::<O>(state, tail) }
}

/// At most 16 bytes, by general registers.
#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
pub(super) fn update_short<O: Order>(state: u16, bytes: &[u8]) -> u16 {
    match bytes.len() {
        0..=3 => compact::update::<O>(state, bytes),
        // A single word times x^16 needs no factor.
        4..=8 => finish::<O>(pair::<O>(short::word::<O>(state, bytes), 0)),
        _ => {
            let (high, low) = short::pair::<O>(state, bytes);
            let factors = last_factors::<O>();
            finish::<O>(multiply(pair::<O>(high, low), load128(factors)))
        }
    }
}

/// The factors of the last 16 bytes.
#[inline]
fn last_factors<O: Order>() -> &'static [u8; 16] {
    factors::<O, 16>().last().unwrap_or(&[0; 16]) // there are some
}

/// As [`Multiplies::head`](product::Multiplies::head).
#[inline]
#[target_feature(enable = "ssse3")]
pub(super) fn head<O: Order>(state: u16, bytes: &[u8], used: usize) -> __m128i {
    let Some(first) = bytes.first_chunk() else {
        return _mm_setzero_si128(); // never: shorter messages go elsewhere
    };
    shift_up(add(load128(first), state_vector::<O>(state, 0)), 16 - used)
}

/// `state` as the first two bytes in memory order, less the first `gone` of them.
#[inline]
#[target_feature(enable = "sse2")]
pub(super) fn state_vector<O: Order>(state: u16, gone: usize) -> __m128i {
    let bytes = if O::REFLECTED { state } else { state.swap_bytes() };
    _mm_cvtsi32_si128(i32::from(bytes) >> (8 * gone.min(2)))
}

/// The bytes moved up by `by` places, at most 16, with zeros below.
#[inline]
#[target_feature(enable = "ssse3")]
pub(super) fn shift_up(bytes: __m128i, by: usize) -> __m128i {
    /// From place 16 - n on, this says what to take for every place: nothing n times (a negative
    /// index), then bytes 0, 1, …
    static INDICES: [u8; 32] = {
        let mut indices = [0x80; 32];
        let mut i = 0_u8;
        while i < 16 {
            indices[16 + i as usize] = i;
            i += 1;
        }
        indices
    };
    let indices = INDICES.get(16_usize.wrapping_sub(by)..).and_then(<[u8]>::first_chunk);
    match indices {
        Some(indices) => _mm_shuffle_epi8(bytes, load128(indices)),
        None => _mm_setzero_si128(), // never
    }
}

#[inline]
#[target_feature(enable = "sse2")]
pub(super) fn zero() -> __m128i {
    _mm_setzero_si128()
}

/// Whether the block has an odd number of ones.
#[inline]
#[target_feature(enable = "sse2")]
pub(super) fn odd(block: __m128i) -> bool {
    let halves = _mm_xor_si128(block, _mm_unpackhi_epi64(block, block));
    _mm_cvtsi128_si64(halves).count_ones() % 2 == 1
}

/// The bytes as a block, in memory order.
#[inline]
#[target_feature(enable = "sse2")]
pub(super) fn load(bytes: &[u8; 16]) -> __m128i {
    load128(bytes)
}

/// A block in memory order as two words in a register.
#[inline]
#[target_feature(enable = "ssse3")]
pub(super) fn arrange<O: Order>(block: __m128i) -> __m128i {
    if O::REFLECTED {
        block
    } else {
        _mm_shuffle_epi8(block, _mm_set_epi8(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15))
    }
}

/// Two words in a register as [`arrange`] would have them.
#[inline]
#[target_feature(enable = "sse2")]
pub(super) fn pair<O: Order>(high: u64, low: u64) -> __m128i {
    let (high, low) = (high.cast_signed(), low.cast_signed());
    if O::REFLECTED { _mm_set_epi64x(low, high) } else { _mm_set_epi64x(high, low) }
}

/// The sum of the words times their factors.
#[inline]
#[target_feature(enable = "pclmulqdq")]
pub(super) fn multiply(words: __m128i, factors: __m128i) -> __m128i {
    add(_mm_clmulepi64_si128::<0x00>(words, factors), _mm_clmulepi64_si128::<0x11>(words, factors))
}

#[inline]
#[target_feature(enable = "sse2")]
pub(super) fn add(a: __m128i, b: __m128i) -> __m128i {
    _mm_xor_si128(a, b)
}

/// The remainder by P of a sum of products that carries a factor x^48.
#[inline]
#[target_feature(enable = "pclmulqdq")]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "16 bits were extracted"
)]
pub(super) fn finish<O: Order>(sum: __m128i) -> u16 {
    let inverse = _mm_set_epi64x(0, inverse::<O>().cast_signed());
    // Half of the sum is above x^16; the quotient is what is above x^64 in that times the inverse.
    if O::REFLECTED {
        let product = _mm_clmulepi64_si128::<0x00>(sum, inverse);
        let quotient = _mm_extract_epi16::<3>(product) as u16;
        _mm_extract_epi16::<4>(sum) as u16 ^ quotient ^ quotient >> 2 ^ quotient >> 15
    } else {
        // The inverse's highest term, which did not fit, adds the sum itself.
        let product = add(_mm_clmulepi64_si128::<0x01>(sum, inverse), sum);
        let quotient = _mm_extract_epi16::<4>(product) as u16;
        _mm_extract_epi16::<3>(sum) as u16 ^ quotient ^ quotient << 2 ^ quotient << 15
    }
}
