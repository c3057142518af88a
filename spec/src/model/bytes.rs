#[cfg(feature = "exports")]
use std::borrow::Cow;
use std::fmt;
use std::ops::Deref;

#[cfg(feature = "exports")]
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};

/// Bytes as hex digits in a text: `FF FF FD 00` or `fffffd00`. They are written in the second form.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(try_from = "String", into = "String")]
pub struct HexBytes(pub Vec<u8>);

/// Why a text is not bytes in hex.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum HexError {
    /// A character that is neither a hex digit nor white space, and its position from 0.
    Digit(char, usize),
    /// A byte with a single digit.
    OddDigits,
}

impl fmt::Display for HexError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Digit(found, at) => write!(
                f,
                "`{found}` at position {at} is no hex digit; bytes are written as `FF FF FD 00`"
            ),
            Self::OddDigits => {
                f.write_str("an odd number of hex digits; every byte is written with two")
            }
        }
    }
}

impl std::error::Error for HexError {}

impl HexBytes {
    /// Reads pairs of hex digits; white space between them is ignored.
    ///
    /// # Errors
    /// On any other character, or an odd number of digits.
    pub fn parse(text: &str) -> Result<Self, HexError> {
        let mut bytes = Vec::with_capacity(text.len() / 2);
        let mut high = None;
        for (at, character) in text.chars().enumerate() {
            if character.is_whitespace() {
                continue;
            }
            let digit = character
                .to_digit(16)
                .and_then(|digit| u8::try_from(digit).ok())
                .ok_or(HexError::Digit(character, at))?;
            match high.take() {
                None => high = Some(digit),
                Some(high) => bytes.push(high << 4 | digit),
            }
        }
        if high.is_some() { Err(HexError::OddDigits) } else { Ok(Self(bytes)) }
    }

    /// Two digits a byte, for which a formatter takes longer: requests to adapters are full of them.
    fn digits(&self) -> String {
        let halves = self.0.iter().flat_map(|byte| [byte >> 4, byte & 0xF]);
        let mut text = String::with_capacity(2 * self.0.len());
        text.extend(halves.filter_map(|half| char::from_digit(half.into(), 16)));
        text
    }
}

#[cfg(feature = "exports")]
impl JsonSchema for HexBytes {
    fn schema_name() -> Cow<'static, str> {
        "HexBytes".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let (pattern, example) = if generator.contract().is_serialize() {
            ("^([0-9a-f]{2})*$", "`fffffd00`")
        } else {
            (r"^(\s*[0-9A-Fa-f]\s*[0-9A-Fa-f])*\s*$", "`FF FF FD 00` or `fffffd00`")
        };
        let description = format!("Bytes as hex digits: {example}.");
        json_schema!({ "description": description, "type": "string", "pattern": pattern })
    }
}

impl Deref for HexBytes {
    type Target = [u8];
    fn deref(&self) -> &[u8] {
        &self.0
    }
}

impl From<Vec<u8>> for HexBytes {
    fn from(bytes: Vec<u8>) -> Self {
        Self(bytes)
    }
}

impl TryFrom<String> for HexBytes {
    type Error = HexError;
    fn try_from(text: String) -> Result<Self, HexError> {
        Self::parse(&text)
    }
}

impl From<HexBytes> for String {
    fn from(bytes: HexBytes) -> Self {
        bytes.digits()
    }
}

impl fmt::Display for HexBytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.digits())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_are_read_and_the_short_one_is_written() {
        let bytes = HexBytes::parse("FF fd\n00").unwrap();
        assert_eq!(*bytes, [0xFF, 0xFD, 0x00]);
        assert_eq!(bytes.to_string(), "fffd00");
        assert_eq!(HexBytes::parse("fffd00"), Ok(bytes));
    }

    #[test]
    fn what_is_no_hex_is_named() {
        assert_eq!(HexBytes::parse("FF 0G"), Err(HexError::Digit('G', 4)));
        assert_eq!(HexBytes::parse("FFF"), Err(HexError::OddDigits));
    }
}
