//! Packets of up to 16 bytes before their CRC, put together in a register.
//!
//! To read back bytes that were just written in smaller pieces takes a processor longer than
//! everything else about such a packet.

use super::{CRC, PREFIX};
use crate::crc;
use crate::dynamixel2::{HEADER, STUFFING_PATTERN};

/// The longest body.
const LONGEST: usize = size_of::<u128>() - PREFIX;

/// Writes the packet to `buffer`; returns how long it is. `None` if it is not tiny, may need
/// stuffing, or does not fit.
#[inline]
pub(super) fn encode(id: u8, code: u8, params: &[&[u8]], buffer: &mut [u8]) -> Option<usize> {
    let params_len: usize = params.iter().map(|part| part.len()).sum();
    if params_len >= LONGEST {
        return None;
    }
    let mut body = u128::from(code);
    for part in params {
        body = part.iter().fold(body, |body, byte| body << 8 | u128::from(*byte));
    }
    if may_have_pattern(body) {
        return None;
    }
    let [first, second, third, fourth] = HEADER;
    let length = 1 + params_len + CRC;
    let [low, high, ..] = length.to_le_bytes();
    let prefix = u64::from_be_bytes([0, first, second, third, fourth, id, low, high]);
    // Zeros in front do not change a CRC that begins with zero.
    const { assert!(crc::UMTS_INIT == 0) }
    let packet = u128::from(prefix) << (8 * (length - CRC)) | body;
    let crc = crc::umts(&packet.to_be_bytes());

    let len = PREFIX + length;
    let target = buffer.get_mut(..len)?;
    let (before_crc, slots) = target.split_last_chunk_mut::<CRC>()?;
    before_crc.copy_from_slice(packet.to_be_bytes().get(size_of::<u128>() + CRC - len..)?);
    *slots = crc.to_le_bytes();
    Some(len)
}

/// Whether the pattern is among the bytes; perhaps also when it is not.
#[inline]
fn may_have_pattern(bytes: u128) -> bool {
    const fn everywhere(byte: u8) -> u128 {
        u128::from_ne_bytes([byte; size_of::<u128>()])
    }
    let [first, second, third] = STUFFING_PATTERN.map(everywhere);
    // Zero in the bytes where the pattern begins.
    let others = (bytes ^ first) | (bytes ^ second) << 8 | (bytes ^ third) << 16;
    others.wrapping_sub(everywhere(1)) & !others & everywhere(0x80) != 0
}
