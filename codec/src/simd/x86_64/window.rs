//! Windows of 64 bytes: the CRC and the patterns of a short packet, from the same registers.
#![expect(clippy::inline_always, reason = "parts of a `Task`")]

use core::arch::x86_64::{
    __m128i, __m256i, _mm_and_si128, _mm_cmpeq_epi8, _mm_movemask_epi8, _mm_set_epi8,
    _mm_set1_epi8, _mm_setzero_si128, _mm_shuffle_epi8, _mm256_and_si256, _mm256_cmpeq_epi8,
    _mm256_movemask_epi8, _mm256_set_m128i, _mm256_set1_epi8, _mm256_shuffle_epi8,
};

use super::super::{Backend, Looked, Pieces, Places, WINDOW, keep_last};
use super::{Narrow, Wide, load128, load256, narrow, wide};
use crate::crc::factors::factors;
use crate::crc::order::Msb;
use crate::dynamixel2::{STUFFING_BYTE, STUFFING_PATTERN};

// One comparison finds the pattern's first two bytes, another its third and the stuffing.
pub(super) const FIRST: i8 = STUFFING_PATTERN[0].cast_signed();
pub(super) const THIRD: i8 = STUFFING_PATTERN[2].cast_signed();
const _: () = assert!(STUFFING_PATTERN[0] == STUFFING_PATTERN[1]);
const _: () = assert!(STUFFING_PATTERN[2] == STUFFING_BYTE);

impl Backend for Narrow {
    #[inline]
    fn umts(self, bytes: &[u8]) -> u16 {
        self.update::<Msb>(0, bytes)
    }

    #[inline(always)]
    fn look(self, pieces: Pieces<'_>) -> Option<Looked> {
        self.look_at(pieces)
    }

    #[inline(always)]
    fn ends_in_crc(self, window: &[u8; WINDOW], len: usize) -> bool {
        // SAFETY: a `Narrow` is made only where the features that the function needs were found.
        unsafe { ends_in_crc_narrow(window, len) }
    }

    #[inline(always)]
    fn places(self, window: &[u8; WINDOW]) -> Places {
        let find = |byte| {
            let blocks = window.as_chunks().0.iter().rev();
            blocks.fold(0, |bits, block| bits << 16 | u64::from(find128(load128(block), byte)))
        };
        places(find(FIRST), find(THIRD))
    }

    #[inline(always)]
    fn pairs(self, window: &[u8; WINDOW]) -> u64 {
        let mut ff = 0;
        for (index, block) in window.as_chunks().0.iter().enumerate() {
            ff |= u64::from(find128(load128(block), FIRST)) << (16 * index);
        }
        pairs(ff)
    }
}

impl Backend for Wide {
    #[inline]
    fn umts(self, bytes: &[u8]) -> u16 {
        self.update::<Msb>(0, bytes)
    }

    #[inline(always)]
    fn look(self, pieces: Pieces<'_>) -> Option<Looked> {
        self.look_at(pieces)
    }

    #[inline(always)]
    fn ends_in_crc(self, window: &[u8; WINDOW], len: usize) -> bool {
        // SAFETY: a `Wide` is made only where the features that the function needs were found.
        unsafe { ends_in_crc_wide(window, len) }
    }

    #[inline(always)]
    fn places(self, window: &[u8; WINDOW]) -> Places {
        // SAFETY: a `Wide` is made only where the features that the function needs were found.
        unsafe { places_wide(window) }
    }

    #[inline(always)]
    fn pairs(self, window: &[u8; WINDOW]) -> u64 {
        // SAFETY: a `Wide` is made only where the features that the function needs were found.
        unsafe { pairs_wide(window) }
    }
}

/// From the places of FF.
#[inline]
const fn pairs(ff: u64) -> u64 {
    ff & ff >> 1
}

/// From the places of FF and FD.
#[inline]
const fn places(ff: u64, fd: u64) -> Places {
    Places { patterns: ff & ff >> 1 & fd >> 2, stuffing: fd }
}

/// The bits of the bytes that are `byte`.
#[inline]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "16 bits are set")]
fn find128(block: __m128i, byte: i8) -> u16 {
    // SAFETY: SSE2 is part of x86-64.
    unsafe { _mm_movemask_epi8(_mm_cmpeq_epi8(block, _mm_set1_epi8(byte))) as u16 }
}

#[inline]
#[target_feature(enable = "avx2")]
fn places_wide(window: &[u8; WINDOW]) -> Places {
    let [low, high] = halves(window);
    let find = |byte| find256(high, byte) << 32 | find256(low, byte);
    places(find(FIRST), find(THIRD))
}

#[inline]
#[target_feature(enable = "avx2")]
fn pairs_wide(window: &[u8; WINDOW]) -> u64 {
    let [low, high] = halves(window);
    pairs(find256(high, FIRST) << 32 | find256(low, FIRST))
}

#[inline]
#[target_feature(enable = "avx2")]
fn find256(block: __m256i, byte: i8) -> u64 {
    let found = _mm256_movemask_epi8(_mm256_cmpeq_epi8(block, _mm256_set1_epi8(byte)));
    u64::from(found.cast_unsigned())
}

#[inline]
#[target_feature(enable = "avx2")]
fn halves(window: &[u8; WINDOW]) -> [__m256i; 2] {
    let (halves, _) = window.as_chunks();
    let [low, high] = halves else {
        return [_mm256_set1_epi8(0); 2]; // never
    };
    [load256(low), load256(high)]
}

// A packet is right if it is a multiple of P with its CRC's high byte first. Zeros in front change
// nothing, and neither does the factor x^16 that the constants carry.

#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
fn ends_in_crc_narrow(window: &[u8; WINDOW], len: usize) -> bool {
    let blocks = window.as_chunks().0.iter().zip(keep_last(len).as_chunks().0);
    let factors = factors::<Msb, 16>();
    let factors = factors.iter().skip(factors.len() - WINDOW / 16);
    let mut sum = _mm_setzero_si128();
    for (index, ((block, keep), factor)) in blocks.zip(factors).enumerate() {
        let block = _mm_and_si128(load128(block), load128(keep));
        let last = index == WINDOW / 16 - 1;
        let words = if last { arrange_last(block) } else { narrow::arrange::<Msb>(block) };
        sum = narrow::add(sum, narrow::multiply(words, load128(factor)));
    }
    narrow::finish::<Msb>(sum) == 0
}

#[inline]
#[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3")]
fn ends_in_crc_wide(window: &[u8; WINDOW], len: usize) -> bool {
    let ([low, high], [keep_low, keep_high]) = (halves(window), halves(keep_last(len)));
    let Some([low_factors, high_factors]) = factors::<Msb, 32>().last_chunk() else {
        return false; // never
    };
    let high = _mm256_shuffle_epi8(_mm256_and_si256(high, keep_high), last_order());
    let mut sum = wide::multiply(high, load256(high_factors));
    // Even if it is all zeros: with varying lengths, a branch would cost more.
    let low = wide::arrange::<Msb>(_mm256_and_si256(low, keep_low));
    sum = wide::add(sum, wide::multiply(low, load256(low_factors)));
    wide::finish::<Msb>(sum) == 0
}

/// The last block of a packet, as two words in a register, with the CRC's bytes swapped.
#[inline]
#[target_feature(enable = "ssse3")]
fn arrange_last(block: __m128i) -> __m128i {
    _mm_shuffle_epi8(block, _mm_set_epi8(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 15, 14))
}

/// The same for 32 bytes, as the order in which to take them.
#[inline]
#[target_feature(enable = "avx2")]
fn last_order() -> __m256i {
    _mm256_set_m128i(
        _mm_set_epi8(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 15, 14),
        _mm_set_epi8(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15),
    )
}
