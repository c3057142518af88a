//! Decimal numbers, and hex ones after 0x, as in the arrays of programs.

use super::text::{Notation, Token, tokens};

/// `[255, 255, 253, 0]`, `{0xFF, 0xFF, 0xFD, 0}`; a negative number is a byte of a language whose
/// bytes have a sign.
pub(super) struct Decimal;

impl Notation for Decimal {
    fn bytes(&self, text: &str) -> Result<Vec<u8>, String> {
        tokens(text, "bytes are written as `[255, 0xFF]`", token)
    }
}

fn token(word: &str, bytes: &mut Vec<u8>) -> Token {
    let lower = word.to_ascii_lowercase();
    let number = match lower.strip_prefix("0x") {
        Some(digits) => u8::from_str_radix(digits, 16).ok(),
        None if lower.starts_with('-') => lower.parse::<i8>().ok().map(i8::cast_unsigned),
        None => lower.parse().ok(),
    };
    match number {
        Some(byte) => {
            bytes.push(byte);
            Token::Bytes
        }
        None if lower.bytes().all(|c| c.is_ascii_hexdigit() || c == b'x' || c == b'-') => {
            Token::Wrong
        }
        None => Token::Word,
    }
}
