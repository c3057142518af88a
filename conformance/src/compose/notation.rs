//! Bytes as programs and people write them.

use std::fmt::Write as _;

/// A way to write bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Notation {
    /// `FF FF FD 00`.
    Hex,
    /// An array of C, `{0xFF, 0xFF, 0xFD, 0x00}`.
    C,
    /// A bytes literal of Python, `b"\xff\xff\xfd\x00"`.
    Python,
}

impl Notation {
    /// The bytes as text on one line.
    #[must_use]
    pub fn text(self, bytes: &[u8]) -> String {
        let each = |prefix: &str, between: &str| {
            let bytes: Vec<_> = bytes.iter().map(|byte| format!("{prefix}{byte:02X}")).collect();
            bytes.join(between)
        };
        match self {
            Self::Hex => each("", " "),
            Self::C => format!("{{{}}}", each("0x", ", ")),
            Self::Python => {
                let mut text = "b\"".to_owned();
                for byte in bytes {
                    // Writing to a string can't fail.
                    let _ = write!(text, "\\x{byte:02x}");
                }
                text + "\""
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_written_as_each_language_has_them() {
        let bytes = [0xFF, 0x00, 0x5C];
        assert_eq!(Notation::Hex.text(&bytes), "FF 00 5C");
        assert_eq!(Notation::C.text(&bytes), "{0xFF, 0x00, 0x5C}");
        assert_eq!(Notation::Python.text(&bytes), "b\"\\xff\\x00\\x5c\"");
        assert_eq!(Notation::C.text(&[]), "{}");
    }
}
