//! 128-bit registers: any processor with PCLMULQDQ.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use core::arch::x86_64::{
    __m128i, _mm_clmulepi64_si128, _mm_cvtsi32_si128, _mm_extract_epi16, _mm_set_epi8,
    _mm_set_epi64x, _mm_setzero_si128, _mm_shuffle_epi8, _mm_xor_si128,
};

use super::constants::{BLOCKS, constants};
use super::load128;
use crate::crc::order::Order;
use crate::crc::{compact, fold, short};

/// The state after `bytes`.
#[target_feature(enable = "pclmulqdq,ssse3")]
pub(super) fn update<O: Order>(state: u16, bytes: &[u8]) -> u16 {
    match bytes.len() {
        0..=16 => update_short::<O>(state, bytes),
        17..=512 => update_medium::<O>(state, bytes),
        _ => {
            let (head, body) = bytes.split_at(bytes.len() % fold::BYTES);
            let state = update::<O>(state, head);
            let words = fold::fold::<O>(state, body.as_chunks().0);
            let mut sum = _mm_setzero_si128();
            let factors = &constants::<O>().factors[BLOCKS - 16..];
            for (&[high, low], factor) in words.as_chunks().0.iter().zip(factors) {
                sum = add(sum, multiply(pair::<O>(high, low), load128(factor)));
            }
            finish::<O>(sum)
        }
    }
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
            let factors = &constants::<O>().factors[BLOCKS - 1];
            finish::<O>(multiply(pair::<O>(high, low), load128(factors)))
        }
    }
}

/// 17 to 512 bytes: a head of 1 to 16 bytes, then whole blocks.
#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
fn update_medium<O: Order>(state: u16, bytes: &[u8]) -> u16 {
    let (state, bytes) = match bytes {
        // The head would be one byte and hold but one byte of the state: deal with it apart.
        [first, rest @ ..] if rest.len() % 16 == 0 => (compact::step::<O>(state, *first), rest),
        _ => (state, bytes),
    };
    let used = (bytes.len() + 15) % 16 + 1;
    let (_, body) = bytes.split_at_checked(used).unwrap_or_default();
    let (blocks, _) = body.as_chunks();
    let factors = &constants::<O>().factors;
    let factors = factors.get((BLOCKS - 1).wrapping_sub(blocks.len())..);
    let (Some(head), Some([factor, factors @ ..])) = (bytes.first_chunk(), factors) else {
        return state; // never: other lengths go elsewhere
    };
    let head = add(load128(head), state_vector::<O>(state, 0));
    let head = shift_up(head, 16 - used);
    let mut sum = multiply(arrange::<O>(head), load128(factor));
    for (block, factor) in blocks.iter().zip(factors) {
        sum = add(sum, multiply(arrange::<O>(load128(block)), load128(factor)));
    }
    finish::<O>(sum)
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
    let inverse = _mm_set_epi64x(0, constants::<O>().inverse.cast_signed());
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
