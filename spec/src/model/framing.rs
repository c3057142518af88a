//! What the framing of several wires is made of.

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

use super::Citation;

/// The IDs that packets may have.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Id {
    /// Smallest ID of a device.
    pub min: u8,
    /// Largest ID of a device.
    pub max: u8,
    /// The ID that every device obeys.
    pub broadcast: u8,
}

/// The length field.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Length {
    /// Bytes of the field.
    pub size: u8,
    /// Order of its bytes.
    pub byte_order: ByteOrder,
    /// What it counts, in words.
    pub covers: String,
    /// The smallest length that a packet may have.
    pub minimum: u16,
}

/// Which byte comes first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum ByteOrder {
    /// The low one.
    Little,
    /// The high one.
    Big,
}

impl ByteOrder {
    /// The two bytes of a number in this order.
    #[must_use]
    pub const fn bytes(self, number: u16) -> [u8; 2] {
        match self {
            Self::Little => number.to_le_bytes(),
            Self::Big => number.to_be_bytes(),
        }
    }
}

/// A 16-bit CRC by its parameters.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Crc {
    /// Its name in catalogues of CRCs.
    pub name: String,
    /// Bits; 16.
    pub width: u8,
    /// The polynomial without its highest term, highest power in the highest bit.
    pub polynomial: u16,
    /// The value before the first byte.
    pub initial: u16,
    /// Whether bits are taken and given lowest first.
    pub reflected: bool,
    /// The value that is xored with the last value.
    pub final_xor: u16,
    /// The CRC of the nine ASCII characters `123456789`.
    pub check: u16,
    /// Order of its bytes on the wire.
    pub byte_order: ByteOrder,
    /// The bytes that it covers, in words.
    pub covers: String,
    /// The sections that say so.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

impl Crc {
    /// The CRC of `bytes`, one bit at a time.
    #[must_use]
    pub fn compute(&self, bytes: &[u8]) -> u16 {
        let mut crc = self.initial;
        for byte in bytes {
            let byte = if self.reflected { byte.reverse_bits() } else { *byte };
            for bit in (0..8).rev() {
                let feedback = (crc >> 15) ^ u16::from(byte >> bit & 1);
                crc <<= 1;
                if feedback == 1 {
                    crc ^= self.polynomial;
                }
            }
        }
        (if self.reflected { crc.reverse_bits() } else { crc }) ^ self.final_xor
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bitwise_crc_meets_published_check_values() {
        let crc = |initial, reflected| Crc {
            name: String::new(),
            width: 16,
            polynomial: 0x8005,
            initial,
            reflected,
            final_xor: 0,
            check: 0,
            byte_order: ByteOrder::Little,
            covers: String::new(),
            source: Vec::new(),
            errata: Vec::new(),
        };
        assert_eq!(crc(0, false).compute(b"123456789"), 0xFEE8, "CRC-16/UMTS");
        assert_eq!(crc(0xFFFF, true).compute(b"123456789"), 0x4B37, "CRC-16/MODBUS");
    }
}
