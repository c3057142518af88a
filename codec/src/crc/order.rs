//! The bit order: the only difference between the two CRCs in the arithmetic.
//!
//! Everything below treats a 64-bit word as a polynomial over GF(2) of degree at most 63, the
//! first message bit being the highest term. [`Msb`] keeps that term in bit 63, [`Lsb`] in
//! bit 0, so that bits never have to be reversed. `raise` multiplies by x^n, `lower` divides by it.

/// A bit order, which determines how a word represents a polynomial.
pub(crate) trait Order {
    /// Whether bit 0 of a word is its highest term.
    const REFLECTED: bool;
    /// The eight bytes as a polynomial, the first byte being the highest.
    fn load(bytes: [u8; 8]) -> u64;
    /// A word in memory order as a polynomial: what [`load`](Self::load) does to a word that was
    /// read without regard to the order.
    fn from_native(word: u64) -> u64;
    /// A polynomial as a word in memory order, the inverse of [`from_native`](Self::from_native).
    fn to_native(word: u64) -> u64;
    /// Times x^`by`, terms above x^63 dropped; `by` is at most 63.
    fn raise(word: u64, by: u32) -> u64;
    /// Divided by x^`by`, the remainder dropped; `by` is at most 63.
    fn lower(word: u64, by: u32) -> u64;
    /// A CRC state times x^48: above the first 16 bits of a word.
    fn top(state: u16) -> u64;
    /// The 16 lowest terms, as a CRC state.
    fn bottom(word: u64) -> u16;
}

/// Most significant bit first: CRC-16/UMTS.
pub(crate) struct Msb;

/// Least significant bit first ("reflected"): CRC-16/MODBUS.
pub(crate) struct Lsb;

impl Order for Msb {
    const REFLECTED: bool = false;

    #[inline]
    fn load(bytes: [u8; 8]) -> u64 {
        u64::from_be_bytes(bytes)
    }
    #[inline]
    fn from_native(word: u64) -> u64 {
        u64::from_be(word)
    }
    #[inline]
    fn to_native(word: u64) -> u64 {
        word.to_be()
    }
    #[inline]
    fn raise(word: u64, by: u32) -> u64 {
        word << by
    }
    #[inline]
    fn lower(word: u64, by: u32) -> u64 {
        word >> by
    }
    #[inline]
    fn top(state: u16) -> u64 {
        u64::from(state) << 48
    }
    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "the low 16 bits are what is asked for")]
    fn bottom(word: u64) -> u16 {
        word as u16
    }
}

impl Order for Lsb {
    const REFLECTED: bool = true;

    #[inline]
    fn load(bytes: [u8; 8]) -> u64 {
        u64::from_le_bytes(bytes)
    }
    #[inline]
    fn from_native(word: u64) -> u64 {
        u64::from_le(word)
    }
    #[inline]
    fn to_native(word: u64) -> u64 {
        word.to_le()
    }
    #[inline]
    fn raise(word: u64, by: u32) -> u64 {
        word >> by
    }
    #[inline]
    fn lower(word: u64, by: u32) -> u64 {
        word << by
    }
    #[inline]
    fn top(state: u16) -> u64 {
        u64::from(state)
    }
    #[inline]
    fn bottom(word: u64) -> u16 {
        (word >> 48) as u16
    }
}
