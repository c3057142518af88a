//! A reader of frames that shares no line with the crate: a value at a time, CRC by the bit.

use actucheck_spec::model::{Fault, FrameKind};

/// Address, command and data.
pub(crate) type Fields = (u8, u8, Vec<u8>);

/// CRC-16/MODBUS.
pub(crate) fn crc(data: &[u8]) -> u16 {
    let mut crc = 0xFFFF;
    for byte in data {
        crc ^= u16::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 { crc >> 1 ^ 0xA001 } else { crc >> 1 };
        }
    }
    crc
}

/// Reads one whole frame.
pub(crate) fn read(kind: FrameKind, bytes: &[u8]) -> Result<Fields, Fault> {
    if bytes.first().is_some_and(|byte| *byte != 0xEE) {
        return Err(Fault::Header);
    }
    let Some([_, address, command, high, low]) = bytes.first_chunk() else {
        return Err(Fault::Truncated);
    };
    let length = usize::from(*high) << 8 | usize::from(*low);
    let checked = match kind {
        FrameKind::Request => length > 0,
        FrameKind::Reply => length > 1,
    };
    let sum = if checked { 2 } else { 0 };
    let end = 5 + length + sum;
    let Some(tail) = bytes.get(end) else {
        return Err(Fault::Truncated);
    };
    if *tail != 0xED {
        return Err(Fault::Tail);
    }
    if bytes.len() > end + 1 {
        return Err(Fault::Trailing);
    }
    let data = &bytes[5..5 + length];
    if checked && bytes[5 + length..end] != crc(data).to_le_bytes() {
        return Err(Fault::Crc);
    }
    Ok((*address, *command, data.to_vec()))
}
