//! Arithmetic modulo P: powers of x, and with them a state moved over zero bytes.
//!
//! Everything here is in the plain bit order (bit i is x^i). The caller reverses the bits of a
//! reflected state before and after.
#![expect(clippy::indexing_slicing, reason = "arrays of a fixed size, indices below it")]

/// The order of x modulo P = (x + 1)(x^15 + x + 1): x^32767 = 1.
pub(crate) const ORDER: u64 = 32_767;

/// Row d holds x^(8 i 32^d) mod P for i from 0 to 31, a row for each five bits of a byte count
/// below [`ORDER`]. 192 bytes.
static POWERS: [[u16; 32]; 3] = {
    let mut rows = [[1; 32]; 3];
    let mut row = 0;
    let mut step = 8;
    while row < 3 {
        let factor = power_of_x(step);
        let mut i = 1;
        while i < 32 {
            rows[row][i] = multiply(rows[row][i - 1], factor);
            i += 1;
        }
        step *= 32;
        row += 1;
    }
    rows
};

/// `state` x^(8 `count`) mod P: the state after `count` zero bytes.
pub(crate) fn shift(state: u16, count: u64) -> u16 {
    // 8 and the order have no common factor, so byte counts repeat after as many as exponents do.
    let mut count = count % ORDER;
    let mut state = state;
    for row in &POWERS {
        if count == 0 {
            break;
        }
        state = multiply(state, row[(count % 32) as usize]);
        count /= 32;
    }
    state
}

/// x^`exponent` mod P.
pub(crate) const fn power_of_x(exponent: u64) -> u16 {
    let mut exponent = exponent % ORDER;
    let mut square = 0b10;
    let mut power = 1;
    while exponent > 0 {
        if exponent & 1 == 1 {
            power = multiply(power, square);
        }
        square = multiply(square, square);
        exponent >>= 1;
    }
    power
}

/// `a` times `b` mod P.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "the low half is what is meant")]
const fn multiply(a: u16, b: u16) -> u16 {
    let mut product = 0;
    let mut i = 0;
    while i < 16 {
        // All ones if b has x^i; this avoids a branch that could be mispredicted.
        let mask = (b as u32 >> i & 1).wrapping_neg();
        product ^= (a as u32) << i & mask;
        i += 1;
    }
    // The quotient by P of the 15 terms above x^15, as `portable` finds it.
    let mut quotient = product >> 16;
    quotient ^= quotient >> 1 ^ quotient >> 14;
    quotient ^= quotient >> 2;
    quotient ^= quotient >> 4;
    quotient ^= quotient >> 8;
    (product ^ quotient ^ quotient << 2 ^ quotient << 15) as u16
}
