//! Eight neighbouring bytes as one `u64`, the first in its lowest byte.

/// The byte in every place.
pub(super) const fn everywhere(byte: u8) -> u64 {
    u64::from_ne_bytes([byte; size_of::<u64>()])
}

/// The highest bit of every byte that is zero, no other.
#[inline]
pub(super) const fn zero_bytes(word: u64) -> u64 {
    const LOW_BITS: u64 = everywhere(0x7F);
    // The sum carries into a byte's highest bit if a lower bit is set, and never out of it.
    !(((word & LOW_BITS) + LOW_BITS) | word | LOW_BITS)
}
