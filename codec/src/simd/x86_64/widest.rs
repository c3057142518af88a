//! 512-bit registers: any processor with VPCLMULQDQ, AVX-512 and its permutation of bytes.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use core::arch::x86_64::{
    __m512i, _mm512_castsi512_si256, _mm512_clmulepi64_epi128, _mm512_extracti64x4_epi64,
    _mm512_maskz_permutexvar_epi8, _mm512_set1_epi8, _mm512_setzero_si512, _mm512_shuffle_epi8,
    _mm512_sub_epi8, _mm512_xor_si512, _mm512_zextsi128_si512,
};

use super::{Wide, Widest, load512, narrow, wide};
use crate::crc::order::Order;
use crate::crc::product;

/// From this many bytes on, it is faster than [`wide`].
pub(super) const LEAST: usize = 256;

/// From this many bytes on, folding is faster.
const LONG: usize = 1537;

/// The places of the bytes of a block.
static PLACES: [u8; 64] = {
    let mut places = [0; 64];
    let mut i = 0;
    while i < 64 {
        places[i as usize] = i;
        i += 1;
    }
    places
};

/// For each 16 bytes, their places backwards.
static BACKWARDS: [u8; 64] = {
    let mut places = [0; 64];
    let mut i = 0;
    while i < 64 {
        places[i as usize] = 15 - i % 16;
        i += 1;
    }
    places
};

/// The state after `bytes`, at least [`LEAST`].
#[target_feature(enable = "avx512f,avx512bw,avx512vbmi,vpclmulqdq,avx2,pclmulqdq,ssse3")]
pub(super) fn update<O: Order>(widest: Widest, state: u16, bytes: &[u8]) -> u16 {
    if bytes.len() < LONG {
        product::medium::<O, _, 64>(widest, state, bytes)
    } else {
        long::<O>(widest, state, bytes)
    }
}

#[inline(never)]
#[target_feature(enable = "avx512f,avx512bw,avx512vbmi,vpclmulqdq,avx2,pclmulqdq,ssse3")]
fn long<O: Order>(widest: Widest, state: u16, bytes: &[u8]) -> u16 {
    let (state, tail) = product::long::<O, _, 64>(widest, state, bytes);
    if tail.is_empty() { state } else { wide::update::<O>(state, tail, Wide { widest: None }) }
}

/// As [`Multiplies::head`](product::Multiplies::head).
#[inline]
#[target_feature(enable = "avx512f,avx512bw,avx512vbmi,ssse3")]
pub(super) fn head<O: Order>(state: u16, bytes: &[u8], used: usize) -> __m512i {
    let (Some(first), Ok(free)) = (bytes.first_chunk(), u8::try_from(64_usize.wrapping_sub(used)))
    else {
        return _mm512_setzero_si512(); // never: shorter messages go elsewhere
    };
    let state = _mm512_zextsi128_si512(narrow::state_vector::<O>(state, 0));
    let from = _mm512_sub_epi8(load512(&PLACES), _mm512_set1_epi8(free.cast_signed()));
    let used = u64::MAX.checked_shl(free.into()).unwrap_or(0);
    _mm512_maskz_permutexvar_epi8(used, from, add(load512(first), state))
}

#[inline]
#[target_feature(enable = "avx512f")]
pub(super) fn zero() -> __m512i {
    _mm512_setzero_si512()
}

/// Whether the block has an odd number of ones.
#[inline]
#[target_feature(enable = "avx512f,avx2")]
pub(super) fn odd(block: __m512i) -> bool {
    wide::odd(wide::add(_mm512_castsi512_si256(block), _mm512_extracti64x4_epi64::<1>(block)))
}

/// The bytes as a block, in memory order.
#[inline]
#[target_feature(enable = "avx512f")]
pub(super) fn load(bytes: &[u8; 64]) -> __m512i {
    load512(bytes)
}

/// A block in memory order as eight words in a register.
#[inline]
#[target_feature(enable = "avx512f,avx512bw")]
pub(super) fn arrange<O: Order>(block: __m512i) -> __m512i {
    if O::REFLECTED { block } else { _mm512_shuffle_epi8(block, load512(&BACKWARDS)) }
}

/// The sum of the words times their factors, in four parts.
#[inline]
#[target_feature(enable = "vpclmulqdq,avx512f")]
pub(super) fn multiply(words: __m512i, factors: __m512i) -> __m512i {
    add(
        _mm512_clmulepi64_epi128::<0x00>(words, factors),
        _mm512_clmulepi64_epi128::<0x11>(words, factors),
    )
}

#[inline]
#[target_feature(enable = "avx512f")]
pub(super) fn add(a: __m512i, b: __m512i) -> __m512i {
    _mm512_xor_si512(a, b)
}

#[inline]
#[target_feature(enable = "avx512f,avx2,pclmulqdq")]
pub(super) fn finish<O: Order>(sum: __m512i) -> u16 {
    wide::finish::<O>(wide::add(_mm512_castsi512_si256(sum), _mm512_extracti64x4_epi64::<1>(sum)))
}
