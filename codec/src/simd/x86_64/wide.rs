//! 256-bit registers: any processor with VPCLMULQDQ and AVX2.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use core::arch::x86_64::{
    __m256i, _mm256_castsi256_si128, _mm256_clmulepi64_epi128, _mm256_extracti128_si256,
    _mm256_set_epi8, _mm256_set_m128i, _mm256_setzero_si256, _mm256_shuffle_epi8, _mm256_xor_si256,
};

use super::constants::{BLOCKS, constants};
use super::{load128, load256, narrow};
use crate::crc::compact;
use crate::crc::order::Order;

/// How many 32-byte blocks the factors are for.
const FACTORS: usize = BLOCKS / 2;

/// The state after `bytes`.
#[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3")]
pub(super) fn update<O: Order>(state: u16, bytes: &[u8]) -> u16 {
    if bytes.len() <= 16 {
        return narrow::update_short::<O>(state, bytes);
    }
    let (state, bytes) = match bytes {
        // The head would be one byte and hold but one byte of the state: deal with it apart.
        [first, rest @ ..] if rest.len() % 32 == 0 => (compact::step::<O>(state, *first), rest),
        _ => (state, bytes),
    };
    let used = (bytes.len() + 31) % 32 + 1;
    let (_, body) = bytes.split_at_checked(used).unwrap_or_default();
    let (blocks, _) = body.as_chunks();
    let head = head::<O>(state, bytes, used);
    if blocks.len() < 31 { medium::<O>(head, blocks) } else { long::<O>(head, blocks) }
}

/// The first `used` bytes of a message of more than 16, 2 to 32 of them, with zeros before them
/// and `state` added to the first two.
#[inline]
#[target_feature(enable = "avx2,ssse3")]
fn head<O: Order>(state: u16, bytes: &[u8], used: usize) -> __m256i {
    // The upper half ends where the used bytes end, unless there are fewer than 16.
    let split = used.max(16) - 16;
    let (Some(low), Some(high)) =
        (bytes.first_chunk(), bytes.get(split..).and_then(<[u8]>::first_chunk))
    else {
        return _mm256_setzero_si256(); // never: shorter messages go elsewhere
    };
    let low = narrow::add(load128(low), narrow::state_vector::<O>(state, 0));
    let high = narrow::add(load128(high), narrow::state_vector::<O>(state, split));
    _mm256_set_m128i(narrow::shift_up(high, 16 - used.min(16)), narrow::shift_up(low, 16 - split))
}

/// Blocks after the head, no more than there are factors for.
#[inline]
#[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3")]
fn medium<O: Order>(head: __m256i, blocks: &[[u8; 32]]) -> u16 {
    let factors = factors::<O>();
    let Some([factor, factors @ ..]) = factors.get((FACTORS - 1).wrapping_sub(blocks.len())..)
    else {
        return 0; // never: `long` takes more
    };
    let mut sum = multiply(arrange::<O>(head), load256(factor));
    for (block, factor) in blocks.iter().zip(factors) {
        sum = add(sum, multiply(arrange::<O>(load256(block)), load256(factor)));
    }
    finish::<O>(sum)
}

/// At least 15 blocks after the head. As in [`fold`](crate::crc::fold), but with y = x^256 and
/// P^256: while 16 blocks are left, the highest go. What remains, up to 31 blocks, is multiplied.
#[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3")]
fn long<O: Order>(head: __m256i, blocks: &[[u8; 32]]) -> u16 {
    let Some((first, rest)) = blocks.split_first_chunk::<15>() else {
        return 0; // never: `medium` takes fewer
    };
    let mut sum = [head; 16];
    for i in 0..15 {
        sum[i + 1] = load256(&first[i]);
    }
    let (turns, rest) = rest.as_chunks::<16>();
    for blocks in turns {
        // When it is processed, `sum[i]` is the highest block; the new block replaces it.
        macro_rules! step { ($($i:literal)*) => { $(
            let highest = sum[$i];
            sum[($i + 1) % 16] = add(sum[($i + 1) % 16], highest);
            sum[($i + 14) % 16] = add(sum[($i + 14) % 16], highest);
            sum[$i] = add(highest, load256(&blocks[$i]));
        )* } }
        step!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15);
    }
    let factors = factors::<O>();
    let Some((factors, last)) = factors.split_at_checked(FACTORS.wrapping_sub(rest.len())) else {
        return 0; // never
    };
    let Some(factors) = factors.last_chunk::<16>() else {
        return 0; // never
    };
    let mut total = _mm256_setzero_si256();
    for i in 0..16 {
        total = add(total, multiply(arrange::<O>(sum[i]), load256(&factors[i])));
    }
    for (block, factor) in rest.iter().zip(last) {
        total = add(total, multiply(arrange::<O>(load256(block)), load256(factor)));
    }
    finish::<O>(total)
}

/// The factors of a 32-byte block, the last block last.
#[inline]
pub(super) fn factors<O: Order>() -> &'static [[u8; 32]] {
    constants::<O>().factors.as_flattened().as_chunks().0
}

/// A block in memory order as four words in a register.
#[inline]
#[target_feature(enable = "avx2")]
pub(super) fn arrange<O: Order>(block: __m256i) -> __m256i {
    if O::REFLECTED {
        block
    } else {
        _mm256_shuffle_epi8(
            block,
            _mm256_set_epi8(
                0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9,
                10, 11, 12, 13, 14, 15,
            ),
        )
    }
}

/// The sum of the words times their factors, in two halves.
#[inline]
#[target_feature(enable = "vpclmulqdq,avx2")]
pub(super) fn multiply(words: __m256i, factors: __m256i) -> __m256i {
    add(
        _mm256_clmulepi64_epi128::<0x00>(words, factors),
        _mm256_clmulepi64_epi128::<0x11>(words, factors),
    )
}

#[inline]
#[target_feature(enable = "avx2")]
pub(super) fn add(a: __m256i, b: __m256i) -> __m256i {
    _mm256_xor_si256(a, b)
}

#[inline]
#[target_feature(enable = "avx2,pclmulqdq")]
pub(super) fn finish<O: Order>(sum: __m256i) -> u16 {
    narrow::finish::<O>(narrow::add(
        _mm256_castsi256_si128(sum),
        _mm256_extracti128_si256::<1>(sum),
    ))
}
