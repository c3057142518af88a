//! The factors and the inverse of P, computed at compile time.
//!
//! A product of two reflected words is the reflected product divided by x. The constants of the
//! reflected order make up for it: they are one power of x lower.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

use crate::crc::order::Order;
use crate::crc::shift::power_of_x;

/// What the multiplications need, for one bit order: 1 KiB.
#[repr(C, align(32))]
pub(super) struct Constants {
    /// For each 16-byte block of a message, the last block last, the factors of its two words,
    /// as they lie in a register beside the block. They carry a factor x^48, which puts the
    /// quotient's part of the sum into one half of the register.
    pub(super) factors: [[u8; 16]; BLOCKS],
    /// The 64 bits below the highest of the quotient of x^80 by P.
    pub(super) inverse: u64,
}

/// The constants for the bit order.
#[inline]
pub(super) fn constants<O: Order>() -> &'static Constants {
    if O::REFLECTED { &LSB } else { &MSB }
}

/// How many blocks the factors are for.
pub(super) const BLOCKS: usize = 64;

static MSB: Constants = Constants { factors: factors(false), inverse: quotient_of_x80() };

static LSB: Constants = Constants {
    factors: factors(true),
    // The lowest bit goes, for the power of x; nothing that is used depends on it.
    inverse: (1 << 63 | quotient_of_x80() >> 1).reverse_bits(),
};

const fn factors(reflected: bool) -> [[u8; 16]; BLOCKS] {
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
