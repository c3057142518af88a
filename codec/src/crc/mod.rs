//! The CRCs of the two wires.
//!
//! Both divide by P = x^16 + x^15 + x^2 + 1 (0x8005) and differ in bit order and initial state:
//!
//! | | bits | initial | of `123456789` | used by |
//! |---|---|---|---|---|
//! | CRC-16/UMTS | as they are | 0 | 0xFEE8 | DYNAMIXEL 2.0: JA40 document, §1.4.7 |
//! | CRC-16/MODBUS | reflected | 0xFFFF | 0x4B37 | INNFOS document, "CRC check code calculation method" |
//!
//! Neither CRC inverts its result, so *the state is the CRC of the bytes read so far*, a plain
//! [`u16`], and there is no final step. The module therefore has functions over `u16` instead of a
//! digest object: a state can be stored, compared, and computed for any part of a stream.
//!
//! * [`umts`], [`modbus`]: one call, one CRC.
//! * [`umts_update`], [`modbus_update`]: a message that comes in parts.
//! * [`umts_shift`], [`modbus_shift`]: a state moved over zero bytes. As a CRC is linear, this
//!   gives the CRC of any range of a stream from states kept along it.
//! * [`Engine`]: the same, with the choice of processor instructions made once. It is for loops
//!   over many short packets, and for tests that want one particular back end.

pub(crate) mod compact;
mod engine;
#[cfg(any(test, target_arch = "aarch64", target_arch = "x86_64"))]
pub(crate) mod factors;
pub(crate) mod fold;
pub(crate) mod order;
pub(crate) mod portable;
#[cfg(any(test, target_arch = "aarch64", target_arch = "x86_64"))]
pub(crate) mod product;
pub(crate) mod shift;
pub(crate) mod short;
#[cfg(test)]
pub(crate) mod tests;

use crate::{dynamixel2, innfos};

pub use engine::Engine;

// The back ends support one polynomial, two bit orders and no inversion. If the YAML differs, this
// stops the build.
const _: () = {
    use {dynamixel2 as umts, innfos as modbus};
    assert!(umts::CRC_POLYNOMIAL == 0x8005 && modbus::CRC_POLYNOMIAL == 0x8005);
    assert!(!umts::CRC_REFLECTED && modbus::CRC_REFLECTED);
    assert!(umts::CRC_FINAL_XOR == 0 && modbus::CRC_FINAL_XOR == 0);
};

/// The state of CRC-16/UMTS before the first byte (JA40 document, §1.4.7).
pub const UMTS_INIT: u16 = dynamixel2::CRC_INITIAL;

/// The state of CRC-16/MODBUS before the first byte (INNFOS document, "CRC check code
/// calculation method": both halves start as 0xFF).
pub const MODBUS_INIT: u16 = innfos::CRC_INITIAL;

/// The CRC-16/UMTS of `bytes`, of any length.
///
/// DYNAMIXEL 2.0 sends it low byte first, after a packet; it covers everything from the header
/// to the last parameter (JA40 document, §1.4.7).
///
/// ```
/// use actucheck_codec::crc;
///
/// let read = [0xFF, 0xFF, 0xFD, 0x00, 0x01, 0x07, 0x00, 0x02, 0x00, 0x00, 0x02, 0x00];
/// assert_eq!(crc::umts(&read).to_le_bytes(), [0x21, 0x51]);
/// assert_eq!(crc::umts(b"123456789"), 0xFEE8);
/// ```
#[must_use]
#[inline]
pub fn umts(bytes: &[u8]) -> u16 {
    umts_update(UMTS_INIT, bytes)
}

/// The CRC-16/UMTS state after `bytes`, of any length, from `state` before them.
///
/// `state` is [`UMTS_INIT`] or the CRC of what came before (JA40 document, §1.4.7:
/// `crc_accum`).
///
/// ```
/// use actucheck_codec::crc;
///
/// let state = crc::umts_update(crc::UMTS_INIT, b"1234");
/// assert_eq!(crc::umts_update(state, b"56789"), 0xFEE8);
/// ```
#[must_use]
#[inline]
pub fn umts_update(state: u16, bytes: &[u8]) -> u16 {
    Engine::new().umts_update(state, bytes)
}

/// The CRC-16/UMTS state after `count` zero bytes: `state` x^(8 `count`) mod P.
///
/// The time does not depend on `count` beyond its first 15 bits. For the states `a` and `b` at
/// two places of one stream, `count` bytes apart, the CRC of the bytes between them is
/// `b ^ umts_shift(a, count)`; and the CRC of two messages, one after the other, is
/// `umts_shift(first, count) ^ second`, the second being `count` bytes long.
///
/// ```
/// use actucheck_codec::crc;
///
/// let (a, b) = (crc::umts(b"12345"), crc::umts(b"123456789"));
/// assert_eq!(b ^ crc::umts_shift(a, 4), crc::umts(b"6789"));
/// assert_eq!(crc::umts_shift(a, 4) ^ crc::umts(b"6789"), b);
/// ```
#[must_use]
#[inline]
pub fn umts_shift(state: u16, count: u64) -> u16 {
    shift::shift(state, count)
}

/// The CRC-16/MODBUS of `bytes`, of any length.
///
/// INNFOS sends it low byte first; it covers the data field alone (INNFOS Ethernet protocol,
/// "CRC check code calculation method"). The document's `CRC16_1` returns the two bytes as they
/// are sent, the first as the high one: 0x7E80 for the byte 01, where this is 0x807E.
///
/// ```
/// use actucheck_codec::crc;
///
/// assert_eq!(crc::modbus(&[0x01]).to_le_bytes(), [0x7E, 0x80]);
/// assert_eq!(crc::modbus(b"123456789"), 0x4B37);
/// ```
#[must_use]
#[inline]
pub fn modbus(bytes: &[u8]) -> u16 {
    modbus_update(MODBUS_INIT, bytes)
}

/// The CRC-16/MODBUS state after `bytes`, of any length, from `state` before them.
///
/// `state` is [`MODBUS_INIT`] or the CRC of what came before (INNFOS document, "CRC
/// check code calculation method").
///
/// ```
/// use actucheck_codec::crc;
///
/// let state = crc::modbus_update(crc::MODBUS_INIT, b"1234");
/// assert_eq!(crc::modbus_update(state, b"56789"), 0x4B37);
/// ```
#[must_use]
#[inline]
pub fn modbus_update(state: u16, bytes: &[u8]) -> u16 {
    Engine::new().modbus_update(state, bytes)
}

/// The CRC-16/MODBUS state after `count` zero bytes: `state` x^(8 `count`) mod P, reflected.
///
/// The time does not depend on `count` beyond its first 15 bits. As the initial state is not
/// zero it must be taken out by hand: for the states `a` and `b` at two places of one stream,
/// `count` bytes apart, the CRC of the bytes between them is
/// `b ^ modbus_shift(a ^ MODBUS_INIT, count)`; and the CRC of two messages, one after the other,
/// is `modbus_shift(first ^ MODBUS_INIT, count) ^ second`, the second being `count` bytes long.
///
/// ```
/// use actucheck_codec::crc;
///
/// let (a, b) = (crc::modbus(b"12345"), crc::modbus(b"123456789"));
/// let gap = crc::modbus_shift(a ^ crc::MODBUS_INIT, 4);
/// assert_eq!(b ^ gap, crc::modbus(b"6789"));
/// assert_eq!(gap ^ crc::modbus(b"6789"), b);
/// ```
#[must_use]
#[inline]
pub fn modbus_shift(state: u16, count: u64) -> u16 {
    shift::shift(state.reverse_bits(), count).reverse_bits()
}
