//! CRC-16/UMTS, the CRC of DYNAMIXEL Protocol 2.0 and the JA actuators (JA40 document, §1.4.7).

use crate::dynamixel2::{CRC_INITIAL, CRC_POLYNOMIAL};

/// The CRC of each value of a byte; 512 bytes.
static TABLE: [u16; 256] = table();

const fn table() -> [u16; 256] {
    let mut table = [0; 256];
    let mut index = 0_u16;
    while index < 256 {
        let mut crc = index << 8;
        let mut bit = 0;
        while bit < 8 {
            crc = if crc & 0x8000 == 0 { crc << 1 } else { (crc << 1) ^ CRC_POLYNOMIAL };
            bit += 1;
        }
        // Const evaluation would stop the build on a bad index.
        #[allow(clippy::indexing_slicing)]
        {
            table[index as usize] = crc;
        }
        index += 1;
    }
    table
}

/// The CRC of `bytes`.
///
/// ```
/// assert_eq!(actucheck_codec::crc::of(b"123456789"), 0xFEE8);
/// ```
#[must_use]
pub fn of(bytes: &[u8]) -> u16 {
    update(CRC_INITIAL, bytes)
}

/// The CRC of what `crc` is the CRC of with `bytes` behind it.
///
/// ```
/// use actucheck_codec::crc;
/// assert_eq!(crc::update(crc::of(b"1234"), b"56789"), crc::of(b"123456789"));
/// ```
#[must_use]
pub fn update(crc: u16, bytes: &[u8]) -> u16 {
    bytes.iter().fold(crc, |crc, byte| {
        let [high, low] = crc.to_be_bytes();
        // A byte is always within a table of 256.
        #[allow(clippy::indexing_slicing)]
        let entry = TABLE[usize::from(high ^ byte)];
        u16::from_be_bytes([low, 0]) ^ entry
    })
}
