//! A packet that is still in pieces: its CRC, and whether it needs stuffing, out of the registers
//! and the memory that its bytes are in.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use core::arch::x86_64::{
    __m128i, __m256i, _mm_and_si128, _mm_cmpeq_epi8, _mm_movemask_epi8, _mm_set1_epi8,
    _mm_setzero_si128, _mm256_and_si256, _mm256_castsi256_si128, _mm256_cmpeq_epi8,
    _mm256_extracti128_si256, _mm256_movemask_epi8, _mm256_set_m128i, _mm256_set1_epi8,
};

use super::super::backend::{Backend, Looked, Pieces, WINDOW, keep_last};
use super::super::order::Msb;
use super::super::shift::{ORDER, power_of_x};
use super::super::short;
use super::window::{FIRST, THIRD};
use super::{Narrow, Wide, load128, load256, narrow, wide};

const BLOCK: usize = 16;
const WORD: usize = 8;

/// As [`constants`](super::constants) has them, but for a block at any place: the factors of one
/// that ends n - 8 bytes before the end. Below eight, all that it has behind the end is zeros.
/// 1168 bytes.
static FACTORS: [[u8; BLOCK]; WORD + WINDOW + 1] = {
    let mut factors = [[0; BLOCK]; WORD + WINDOW + 1];
    let mut n = 0;
    while n < factors.len() {
        let high = power_of_x(8 * n as u64 + 16) as u128;
        let low = power_of_x(8 * n as u64 + 16 + ORDER - 64) as u128;
        factors[n] = (high << 112 | low << 48).to_le_bytes();
        n += 1;
    }
    factors
};

// Functions that both back ends use have the back end as a parameter, so that each has a copy of
// its own, which becomes part of it.

/// What is known of some bytes.
#[derive(Clone, Copy)]
struct Seen {
    /// Their words times their factors, to be added up.
    products: __m128i,
    places: Places,
}

/// Where FF and FD stand; bit i stands for byte i.
#[derive(Clone, Copy)]
struct Places {
    ff: u64,
    fd: u64,
}

impl Places {
    const NONE: Self = Self { ff: 0, fd: 0 };

    /// These, and the others from `place` on.
    #[inline]
    fn and(self, others: Self, place: usize) -> Self {
        Self { ff: self.ff | others.ff << place, fd: self.fd | others.fd << place }
    }

    /// Without the first `gone` bytes.
    #[inline]
    fn behind(self, gone: usize) -> Self {
        Self { ff: self.ff >> gone, fd: self.fd >> gone }
    }

    /// Where the pattern begins.
    #[inline]
    fn patterns(self) -> u64 {
        self.ff & self.ff >> 1 & self.fd >> 2
    }
}

/// As [`Backend::look`].
#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
pub(super) fn look_narrow(pieces: Pieces<'_>) -> Option<Looked> {
    let tail = pieces.tail;
    let front = Seen::front::<Narrow>(pieces)?;
    let behind = if tail.len() < BLOCK { short::<Narrow>(tail) } else { blocks(tail)? };
    front.crc::<Narrow>(pieces, behind)
}

/// The same.
#[inline]
#[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3")]
pub(super) fn look_wide(pieces: Pieces<'_>) -> Option<Looked> {
    let tail = pieces.tail;
    let front = Seen::front::<Wide>(pieces)?;
    let behind = match tail.len() {
        0..BLOCK => short::<Wide>(tail),
        BLOCK..32 => two_blocks::<Wide>(tail)?,
        _ => two_double_blocks(tail)?,
    };
    front.crc::<Wide>(pieces, behind)
}

impl Seen {
    /// What is in front of the tail.
    #[inline]
    #[target_feature(enable = "pclmulqdq,ssse3")]
    fn front<B: Backend>(Pieces { prefix, lead, lead_len, tail }: Pieces<'_>) -> Option<Self> {
        if tail.len() > WINDOW {
            return None;
        }
        // To the left, so that the body begins at the same place in front of every lead.
        let left = if lead_len == 0 { 0 } else { lead << (64 - 8 * lead_len) };
        let words = narrow::pair::<Msb>(prefix, left);
        let factors = load128(FACTORS.get(lead_len + tail.len())?);
        let products = narrow::multiply(words, factors);
        Some(Self { products, places: find128(narrow::arrange::<Msb>(words)) })
    }

    /// What [`Looked`] tells of the whole packet.
    #[inline]
    #[target_feature(enable = "pclmulqdq,ssse3")]
    fn crc<B: Backend>(self, pieces: Pieces<'_>, tail: Self) -> Option<Looked> {
        // The body begins with the instruction, the prefix's last byte. Of a long tail's places the
        // last fall off.
        let body = self.places.and(tail.places, WORD + pieces.lead_len).behind(WORD - 1);
        let before_tail = body.patterns() << (WORD - 1 - pieces.lead_len) & 0xFF;
        let crc = narrow::finish::<Msb>(narrow::add(self.products, tail.products));
        (before_tail == 0).then_some(Looked { crc, patterns: tail.places.patterns() })
    }
}

/// Less than a block.
#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
fn short<B: Backend>(tail: &[u8]) -> Seen {
    let (high, low) = match tail.len() {
        0 => return Seen { products: _mm_setzero_si128(), places: Places::NONE },
        1..4 => (0, tail.iter().fold(0, |word, byte| word << 8 | u64::from(*byte))),
        4..=8 => (0, short::word::<Msb>(0, tail)),
        _ => short::pair::<Msb>(0, tail),
    };
    let words = narrow::pair::<Msb>(high, low);
    Seen {
        products: narrow::multiply(words, load128(&FACTORS[WORD])),
        places: find128(narrow::arrange::<Msb>(words)).behind(BLOCK - tail.len()),
    }
}

/// A block or more, one after the other.
#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
fn blocks(tail: &[u8]) -> Option<Seen> {
    let whole = tail.len() / BLOCK * BLOCK;
    let mut seen = two_blocks::<Narrow>(tail.get(whole - BLOCK..)?)?;
    seen.places = Places::NONE.and(seen.places, whole - BLOCK);
    for (index, block) in tail.get(..whole - BLOCK)?.as_chunks().0.iter().enumerate() {
        let (block, at) = (load128(block), BLOCK * index);
        seen.places = seen.places.and(find128(block), at);
        let factors = load128(FACTORS.get(WORD + tail.len() - BLOCK - at)?);
        let products = narrow::multiply(narrow::arrange::<Msb>(block), factors);
        seen.products = narrow::add(seen.products, products);
    }
    Some(seen)
}

/// A block or two, as two that may overlap: what they share counts in the first.
#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
fn two_blocks<B: Backend>(tail: &[u8]) -> Option<Seen> {
    let behind = tail.len() - BLOCK;
    let (first, last) = (load128(tail.first_chunk()?), load128(tail.last_chunk()?));
    let places = find128(first).and(find128(last), behind);
    let last = _mm_and_si128(last, load128(keep_last(behind).last_chunk()?));
    let products = narrow::add(
        narrow::multiply(narrow::arrange::<Msb>(first), load128(FACTORS.get(behind + WORD)?)),
        narrow::multiply(narrow::arrange::<Msb>(last), load128(&FACTORS[WORD])),
    );
    Some(Seen { products, places })
}

/// The same for blocks of twice the size.
#[inline]
#[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3")]
fn two_double_blocks(tail: &[u8]) -> Option<Seen> {
    let behind = tail.len() - 2 * BLOCK;
    let (first, last) = (load256(tail.first_chunk()?), load256(tail.last_chunk()?));
    let places = find256(first).and(find256(last), behind);
    let last = _mm256_and_si256(last, load256(keep_last(behind).last_chunk()?));
    let products = wide::add(
        wide::multiply(wide::arrange::<Msb>(first), factors256(behind)?),
        wide::multiply(wide::arrange::<Msb>(last), factors256(0)?),
    );
    let halves = (_mm256_castsi256_si128(products), _mm256_extracti128_si256::<1>(products));
    Some(Seen { products: narrow::add(halves.0, halves.1), places })
}

/// The factors of 32 bytes that end so many bytes before the end.
#[inline]
#[target_feature(enable = "avx2")]
fn factors256(behind: usize) -> Option<__m256i> {
    let (first, last) = (FACTORS.get(behind + BLOCK + WORD)?, FACTORS.get(behind + WORD)?);
    Some(_mm256_set_m128i(load128(last), load128(first)))
}

#[inline]
#[target_feature(enable = "sse2")]
fn find128(block: __m128i) -> Places {
    let find = |byte| {
        let found = _mm_movemask_epi8(_mm_cmpeq_epi8(block, _mm_set1_epi8(byte)));
        u64::from(found.cast_unsigned())
    };
    Places { ff: find(FIRST), fd: find(THIRD) }
}

#[inline]
#[target_feature(enable = "avx2")]
fn find256(block: __m256i) -> Places {
    let find = |byte| {
        let found = _mm256_movemask_epi8(_mm256_cmpeq_epi8(block, _mm256_set1_epi8(byte)));
        u64::from(found.cast_unsigned())
    };
    Places { ff: find(FIRST), fd: find(THIRD) }
}
