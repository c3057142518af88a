//! A packet that is still in pieces: computes its CRC, and finds the patterns that need stuffing,
//! before the pieces are put together.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use core::arch::x86_64::{
    __m128i, __m256i, _mm_and_si128, _mm_cmpeq_epi8, _mm_movemask_epi8, _mm_set_epi64x,
    _mm_set1_epi8, _mm256_and_si256, _mm256_castsi256_si128, _mm256_cmpeq_epi8,
    _mm256_extracti128_si256, _mm256_movemask_epi8, _mm256_set_m128i, _mm256_set1_epi8,
};

use super::super::{Backend, Looked, Pieces, WINDOW, keep_last};
use super::window::{FIRST, THIRD};
use super::{Narrow, Wide, load128, load256, narrow, wide};
use crate::crc::order::Msb;
use crate::crc::shift::{ORDER, power_of_x};
use crate::crc::short;

const BLOCK: usize = 16;
const WORD: usize = 8;

/// As [`factors`](crate::crc::factors) has them, but for a block at any place: the factors of one
/// that ends n - 8 bytes before the end. Below eight, it has only zeros after the end. 1168 bytes.
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

// A function that both back ends use has the back end as a type parameter: then each back end has a
// copy of its own, which can be inlined into it.

/// The results for some bytes.
#[derive(Clone, Copy)]
struct Seen {
    /// The products of their words with their factors, to be added.
    products: __m128i,
    places: Places,
}

/// What is looked for: patterns, or only FF FF, which is faster and is absent from most packets.
const PATTERNS: bool = true;
const PAIRS: bool = false;

/// The places of FF and, for patterns, FD; bit i is byte i.
#[derive(Clone, Copy)]
struct Places {
    ff: u64,
    fd: u64,
}

impl Places {
    const NONE: Self = Self { ff: 0, fd: 0 };

    /// These places, and the others shifted by `place`.
    #[inline]
    fn and(self, others: Self, place: usize) -> Self {
        Self { ff: self.ff | others.ff << place, fd: self.fd | others.fd << place }
    }

    /// Without the first `gone` bytes.
    #[inline]
    fn behind(self, gone: usize) -> Self {
        Self { ff: self.ff >> gone, fd: self.fd >> gone }
    }

    /// The places at which a match begins.
    #[inline]
    fn found<const WHAT: bool>(self) -> u64 {
        let pairs = self.ff & self.ff >> 1;
        if WHAT == PAIRS { pairs } else { pairs & self.fd >> 2 }
    }
}

/// Implements `look_at` for a back end, from its functions for tails of each length.
macro_rules! look {
    ($proof:ident, $features:literal, $what:ident, $tail:ident, $($len:pat => $seen:expr,)*) => {
        impl $proof {
            /// As [`Backend::look`].
            #[inline(always)]
            pub(super) fn look_at(self, pieces: Pieces<'_>) -> Option<Looked> {
                let mut looked = self.look_for::<PAIRS>(pieces)?;
                if looked.patterns != 0 {
                    let Pieces { prefix, lead_len, lead, tail } = pieces;
                    looked.patterns = self.patterns(prefix, lead_len, lead, tail)?;
                }
                Some(looked)
            }

            /// The pieces come one by one, so that the caller can keep them in registers.
            #[cold]
            #[inline(never)]
            fn patterns(self, prefix: u64, lead_len: usize, lead: u64, tail: &[u8]) -> Option<u64> {
                #[target_feature(enable = $features)]
                fn patterns(proof: $proof, pieces: Pieces<'_>) -> Option<u64> {
                    proof.look_for::<PATTERNS>(pieces).map(|looked| looked.patterns)
                }
                // SAFETY: the value is the proof that the processor has the features.
                unsafe { patterns(self, Pieces { prefix, lead_len, lead, tail }) }
            }

            #[inline(always)]
            fn look_for<const $what: bool>(self, pieces: Pieces<'_>) -> Option<Looked> {
                let $tail = pieces.tail;
                // SAFETY: the value is the proof that the processor has the features.
                unsafe {
                    let front = Seen::front::<Self, $what>(pieces)?;
                    let behind = match $tail.len() {
                        0 => return front.alone::<Self, $what>(),
                        $($len => $seen,)*
                    };
                    front.crc::<Self, $what>(pieces, behind)
                }
            }
        }
    };
}

look!(
    Narrow, "pclmulqdq,ssse3", WHAT, tail,
    1..BLOCK => short::<Self, WHAT>(tail),
    _ => blocks::<WHAT>(tail)?,
);

look!(
    Wide, "vpclmulqdq,avx2,pclmulqdq,ssse3", WHAT, tail,
    1..BLOCK => short::<Self, WHAT>(tail),
    BLOCK..32 => two_blocks::<Self, WHAT>(tail)?,
    _ => two_double_blocks::<WHAT>(tail)?,
);

impl Seen {
    /// The bytes before the tail.
    #[inline]
    #[target_feature(enable = "pclmulqdq,ssse3")]
    fn front<B: Backend, const WHAT: bool>(
        Pieces { prefix, lead_len, lead, tail }: Pieces<'_>,
    ) -> Option<Self> {
        if tail.len() > WINDOW {
            return None;
        }
        let block = _mm_set_epi64x(lead.cast_signed(), prefix.cast_signed());
        let factors = load128(FACTORS.get(lead_len + tail.len())?);
        let products = narrow::multiply(narrow::arrange::<Msb>(block), factors);
        Some(Self { products, places: find128::<WHAT>(block) })
    }

    /// [`Looked`] of a packet without a tail.
    #[inline]
    #[target_feature(enable = "pclmulqdq,ssse3")]
    fn alone<B: Backend, const WHAT: bool>(self) -> Option<Looked> {
        let patterns = self.places.behind(WORD - 1).found::<WHAT>();
        let crc = narrow::finish::<Msb>(self.products);
        (patterns == 0 || WHAT == PAIRS).then_some(Looked { crc, patterns })
    }

    /// [`Looked`] of the whole packet.
    #[inline]
    #[target_feature(enable = "pclmulqdq,ssse3")]
    fn crc<B: Backend, const WHAT: bool>(self, pieces: Pieces<'_>, tail: Self) -> Option<Looked> {
        // The body begins with the instruction, the prefix's last byte. The last places of a long
        // tail are shifted out.
        let body = self.places.and(tail.places, WORD + pieces.lead_len).behind(WORD - 1);
        let crc = narrow::finish::<Msb>(narrow::add(self.products, tail.products));
        let patterns = tail.places.found::<WHAT>();
        if WHAT == PAIRS {
            return Some(Looked { crc, patterns: patterns | body.found::<WHAT>() });
        }
        let before_tail = body.found::<WHAT>() << (WORD - 1 - pieces.lead_len) & 0xFF;
        (before_tail == 0).then_some(Looked { crc, patterns })
    }
}

/// Less than a block, but not empty.
#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
fn short<B: Backend, const WHAT: bool>(tail: &[u8]) -> Seen {
    let (high, low) = match tail.len() {
        0..4 => (0, tail.iter().fold(0, |word, byte| word << 8 | u64::from(*byte))),
        4..=8 => (0, short::word::<Msb>(0, tail)),
        _ => short::pair::<Msb>(0, tail),
    };
    let words = narrow::pair::<Msb>(high, low);
    Seen {
        products: narrow::multiply(words, load128(&FACTORS[WORD])),
        places: find128::<WHAT>(narrow::arrange::<Msb>(words)).behind(BLOCK - tail.len()),
    }
}

/// A block or more, one after the other.
#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
fn blocks<const WHAT: bool>(tail: &[u8]) -> Option<Seen> {
    let whole = tail.len() / BLOCK * BLOCK;
    let mut seen = two_blocks::<Narrow, WHAT>(tail.get(whole - BLOCK..)?)?;
    seen.places = Places::NONE.and(seen.places, whole - BLOCK);
    for (index, block) in tail.get(..whole - BLOCK)?.as_chunks().0.iter().enumerate() {
        let (block, at) = (load128(block), BLOCK * index);
        seen.places = seen.places.and(find128::<WHAT>(block), at);
        let factors = load128(FACTORS.get(WORD + tail.len() - BLOCK - at)?);
        let products = narrow::multiply(narrow::arrange::<Msb>(block), factors);
        seen.products = narrow::add(seen.products, products);
    }
    Some(seen)
}

/// One or two blocks, as two that may overlap: shared bytes count in the first.
#[inline]
#[target_feature(enable = "pclmulqdq,ssse3")]
fn two_blocks<B: Backend, const WHAT: bool>(tail: &[u8]) -> Option<Seen> {
    let behind = tail.len() - BLOCK;
    let (first, last) = (load128(tail.first_chunk()?), load128(tail.last_chunk()?));
    let places = find128::<WHAT>(first).and(find128::<WHAT>(last), behind);
    let last = _mm_and_si128(last, load128(&keep_last(behind).as_chunks().0[WINDOW / BLOCK - 1]));
    let products = narrow::add(
        narrow::multiply(narrow::arrange::<Msb>(first), load128(&FACTORS[behind + WORD])),
        narrow::multiply(narrow::arrange::<Msb>(last), load128(&FACTORS[WORD])),
    );
    Some(Seen { products, places })
}

/// The same for blocks of twice the size.
#[inline]
#[target_feature(enable = "vpclmulqdq,avx2,pclmulqdq,ssse3")]
fn two_double_blocks<const WHAT: bool>(tail: &[u8]) -> Option<Seen> {
    let behind = tail.len() - 2 * BLOCK;
    let (first, last) = (load256(tail.first_chunk()?), load256(tail.last_chunk()?));
    let places = find256::<WHAT>(first).and(find256::<WHAT>(last), behind);
    let last = _mm256_and_si256(last, load256(keep_last(behind).last_chunk()?));
    let products = wide::add(
        wide::multiply(wide::arrange::<Msb>(first), factors256(behind)?),
        wide::multiply(wide::arrange::<Msb>(last), factors256(0)?),
    );
    let halves = (_mm256_castsi256_si128(products), _mm256_extracti128_si256::<1>(products));
    Some(Seen { products: narrow::add(halves.0, halves.1), places })
}

/// The factors of 32 bytes that end this many bytes before the end.
#[inline]
#[target_feature(enable = "avx2")]
fn factors256(behind: usize) -> Option<__m256i> {
    let (first, last) = (FACTORS.get(behind + BLOCK + WORD)?, FACTORS.get(behind + WORD)?);
    Some(_mm256_set_m128i(load128(last), load128(first)))
}

#[inline]
#[target_feature(enable = "sse2")]
fn find128<const WHAT: bool>(block: __m128i) -> Places {
    let find = |byte| {
        let found = _mm_movemask_epi8(_mm_cmpeq_epi8(block, _mm_set1_epi8(byte)));
        u64::from(found.cast_unsigned())
    };
    Places { ff: find(FIRST), fd: if WHAT == PAIRS { 0 } else { find(THIRD) } }
}

#[inline]
#[target_feature(enable = "avx2")]
fn find256<const WHAT: bool>(block: __m256i) -> Places {
    let find = |byte| {
        let found = _mm256_movemask_epi8(_mm256_cmpeq_epi8(block, _mm256_set1_epi8(byte)));
        u64::from(found.cast_unsigned())
    };
    Places { ff: find(FIRST), fd: if WHAT == PAIRS { 0 } else { find(THIRD) } }
}
