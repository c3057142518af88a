//! 256-bit registers: any processor with VPCLMULQDQ and AVX2.
use core::arch::x86_64::{
    __m256i, _mm256_castsi256_si128, _mm256_clmulepi64_epi128, _mm256_extracti128_si256,
    _mm256_set_epi8, _mm256_set_m128i, _mm256_setzero_si256, _mm256_shuffle_epi8, _mm256_xor_si256,
};

use super::{Wide, load128, load256, narrow, widest};
use crate::crc::order::Order;
use crate::crc::product;

/// From this many bytes on, folding is faster.
const LONG: usize = 1025;

/// The state after `bytes`.
#[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3")]
pub(super) fn update<O: Order>(state: u16, bytes: &[u8], wide: Wide) -> u16 {
    if bytes.len() <= 16 {
        narrow::update_short::<O>(state, bytes)
    } else if bytes.len() < widest::LEAST {
        product::medium::<O, _, 32>(wide, state, bytes)
    } else {
        longer::<O>(state, bytes, wide)
    }
}

/// The state after at least [`widest::LEAST`] bytes.
#[inline(never)]
#[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3")]
fn longer<O: Order>(state: u16, bytes: &[u8], wide: Wide) -> u16 {
    if let Some(widest) = wide.widest {
        return widest.update::<O>(state, bytes);
    }
    if bytes.len() < LONG {
        return product::medium::<O, _, 32>(wide, state, bytes);
    }
    let (state, tail) = product::long::<O, _, 32>(wide, state, bytes);
    if tail.is_empty() { state } else { update::<O>(state, tail, wide) }
}

/// As [`Multiplies::head`](product::Multiplies::head); more than 16 bytes are enough.
#[inline]
#[target_feature(enable = "avx2,ssse3")]
pub(super) fn head<O: Order>(state: u16, bytes: &[u8], used: usize) -> __m256i {
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

#[inline]
#[target_feature(enable = "avx")]
pub(super) fn zero() -> __m256i {
    _mm256_setzero_si256()
}

/// Whether the block has an odd number of ones.
#[inline]
#[target_feature(enable = "avx2")]
pub(super) fn odd(block: __m256i) -> bool {
    narrow::odd(narrow::add(_mm256_castsi256_si128(block), _mm256_extracti128_si256::<1>(block)))
}

/// The bytes as a block, in memory order.
#[inline]
#[target_feature(enable = "avx")]
pub(super) fn load(bytes: &[u8; 32]) -> __m256i {
    load256(bytes)
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
