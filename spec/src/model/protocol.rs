use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Citation, HexBytes, NamedValue};

/// A file of `protocols/`: the wire and its instructions.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Protocol {
    /// Id, which the adapter protocol calls `wire`.
    pub protocol: String,
    /// Its name.
    pub title: String,
    /// What a packet begins with.
    pub framing: Framing,
    /// What a packet ends with.
    pub crc: Crc,
    /// What keeps the header out of bodies.
    pub stuffing: Stuffing,
    /// What devices answer.
    pub status: StatusFormat,
    /// What hosts may ask, by rising code.
    pub instructions: Vec<Instruction>,
}

/// Header, ID and length.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Framing {
    /// The first bytes, the reserved one included.
    pub header: Vec<u8>,
    /// The IDs that packets may have.
    pub id: Id,
    /// The length field.
    pub length: Length,
    /// Where this stands.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// The IDs that packets may have.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
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
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ByteOrder {
    /// The low one.
    Little,
    /// The high one.
    Big,
}

/// A 16-bit CRC by its parameters.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
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
    /// What the last value is xored with.
    pub final_xor: u16,
    /// The CRC of the nine ASCII characters `123456789`.
    pub check: u16,
    /// Order of its bytes on the wire.
    pub byte_order: ByteOrder,
    /// What it runs over, in words.
    pub covers: String,
    /// Where this stands.
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

/// Byte stuffing.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Stuffing {
    /// The bytes that must not stand in a body alone.
    pub pattern: Vec<u8>,
    /// The byte that is put behind them.
    pub insert: u8,
    /// Where the pattern is looked for, in words.
    pub covers: String,
    /// Where this stands.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// The status packet.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StatusFormat {
    /// Its instruction.
    pub instruction: u8,
    /// The bit of the error byte that tells of a hardware error.
    pub alert_bit: u8,
    /// The values of the error byte's other bits.
    pub errors: Vec<ErrorNumber>,
    /// Where this stands.
    pub source: Vec<Citation>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// A number that the error byte may hold.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ErrorNumber {
    /// The number, alert bit aside.
    pub number: u8,
    /// Its name.
    pub name: String,
    /// What it means.
    pub summary: String,
}

/// What a host may ask.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Instruction {
    /// Its name in the documents.
    pub name: String,
    /// Its code.
    pub code: u8,
    /// What it does.
    pub summary: String,
    /// The sections that describe it.
    pub source: Vec<Citation>,
    /// Whether it may go to the broadcast ID only.
    #[serde(default)]
    pub broadcast_only: bool,
    /// Whether devices answer it when it goes to the broadcast ID.
    #[serde(default)]
    pub answers_broadcast: bool,
    /// Whether a device answers it whatever its Status Return Level is.
    #[serde(default)]
    pub always_answered: bool,
    /// Layout of its parameters.
    #[serde(default)]
    pub parameters: Vec<Field>,
    /// Layout of the status packets' parameters, if a device answers with one of its own.
    pub status: Option<Vec<Field>>,
    /// Layout of one device's block, if the devices answer with one status packet together.
    pub fast_status: Option<Vec<Field>>,
    /// Ids of the errata that it depends on.
    #[serde(default)]
    pub errata: Vec<String>,
}

/// A field of a layout: of `size`, or `each` for a group that repeats to the end.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Field {
    /// Its name.
    pub name: String,
    /// How many bytes it has.
    pub size: Option<Size>,
    /// The fields that repeat for each device.
    #[serde(default)]
    pub each: Vec<Field>,
    /// Whether the layout may end before it.
    #[serde(default)]
    pub optional: bool,
    /// The bytes that it always has, if the document gives them.
    pub fixed: Option<HexBytes>,
    /// Values with a name.
    #[serde(default)]
    pub values: Vec<NamedValue>,
}

/// How many bytes a field has.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "a size is a number of bytes, the name of an earlier field that holds it, or `rest`"
)]
pub enum Size {
    /// So many.
    Bytes(u8),
    /// As many as an earlier field says, or the `rest`.
    Named(String),
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
