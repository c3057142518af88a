//! The factors and the inverse of P, computed at compile time.
//!
//! A product of two reflected words is the reflected product divided by x. The constants of the
//! reflected order make up for it: they are one power of x lower.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use super::fold::{GROUP, LEFT};
use super::order::Order;
use super::shift::power_of_x;

/// What the multiplications need, for one bit order: 2 KiB.
#[repr(C, align(64))]
struct Constants {
    /// For each 16-byte block of a message, the last block last, the factors of its two words,
    /// as they lie in a register beside the block. They carry a factor x^48, which puts the
    /// quotient's part of the sum into one half of the register.
    factors: [[u8; 16]; BLOCKS],
    /// The 64 bits below the highest of the quotient of x^80 by P.
    inverse: u64,
}

/// The factors of all blocks of `N` bytes, a power of two from 16 to 64, the last block last.
#[inline]
pub(crate) fn factors<O: Order, const N: usize>() -> &'static [[u8; N]] {
    constants::<O>().factors.as_flattened().as_chunks().0
}

/// The 64 bits below the highest of the quotient of x^80 by P.
#[inline]
#[cfg_attr(
    not(any(target_arch = "aarch64", target_arch = "x86_64")),
    expect(dead_code, reason = "the tests need the factors alone")
)]
pub(crate) fn inverse<O: Order>() -> u64 {
    constants::<O>().inverse
}

#[inline]
fn constants<O: Order>() -> &'static Constants {
    if O::REFLECTED { &LSB } else { &MSB }
}

/// How many blocks of 16 bytes the factors are for: 32 of 64 bytes, which is enough for what is left
/// of a folded message, and for the blocks behind it that are no whole group.
const BLOCKS: usize = 128;
const _: () = assert!(4 * (LEFT + GROUP - 1) <= BLOCKS);

static MSB: Constants = Constants { factors: all_factors(false), inverse: quotient_of_x80() };

static LSB: Constants = Constants {
    factors: all_factors(true),
    // The lowest bit goes, for the power of x; nothing that is used depends on it.
    inverse: (1 << 63 | quotient_of_x80() >> 1).reverse_bits(),
};

const fn all_factors(reflected: bool) -> [[u8; 16]; BLOCKS] {
    let mut factors = [[0; 16]; BLOCKS];
    let mut i = 0;
    while i < BLOCKS {
        let low = 128 * (BLOCKS - 1 - i) as u64 + 16;
        let high = low + 64;
        // The register's lower half holds the block's first word if reflected.
        let register = if reflected {
            factor(low - 1).reverse_bits() as u128 * (1 << 64)
                + factor(high - 1).reverse_bits() as u128
        } else {
            factor(high) as u128 * (1 << 64) + factor(low) as u128
        };
        factors[i] = register.to_le_bytes();
        i += 1;
    }
    factors
}

const fn factor(exponent: u64) -> u64 {
    (power_of_x(exponent) as u64) << 48
}

/// x^80 divided by P, without its highest term, x^64.
#[expect(clippy::cast_possible_truncation, reason = "the highest term is left out")]
const fn quotient_of_x80() -> u64 {
    const P: u128 = 0x1_8005;
    let (mut rest, mut quotient) = (1_u128 << 80, 0_u128);
    let mut i = 65;
    while i > 0 {
        i -= 1;
        if rest >> (i + 16) & 1 == 1 {
            rest ^= P << i;
            quotient |= 1 << i;
        }
    }
    quotient as u64
}
