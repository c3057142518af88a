//! Hex digits with any separators. White space parts bytes, so a single digit is a byte.

use super::text::{Notation, Token, tokens};

/// `FF FF FD 00`, `0xFF,0xFF`, `ff:ff`, `FFh`, `$FF`, `fffffd00`.
pub(super) struct Hex;

impl Notation for Hex {
    fn bytes(&self, text: &str) -> Result<Vec<u8>, String> {
        // A new number begins at 0x, also without a separator.
        let text = text.replace("0X", "0x").replace("0x", " 0x");
        tokens(&text, "bytes are written as `FF FF FD 00`", token)
    }
}

fn token(word: &str, bytes: &mut Vec<u8>) -> Token {
    let digits = word.strip_prefix("0x").or(word.strip_prefix('$')).unwrap_or(word);
    let short = |digits: &&str| (1..=2).contains(&digits.len());
    let digits = digits.strip_suffix(['h', 'H']).filter(short).unwrap_or(digits);
    if !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) || digits.is_empty() {
        return if word.starts_with("0x") { Token::Wrong } else { Token::Word };
    }
    if digits.len() > 1 && digits.len() % 2 == 1 {
        return Token::Wrong;
    }
    for pair in digits.as_bytes().chunks(2) {
        let digit = |digit: &u8| char::from(*digit).to_digit(16).and_then(|d| u8::try_from(d).ok());
        bytes.push(pair.iter().filter_map(digit).fold(0, |byte, digit| byte << 4 | digit));
    }
    Token::Bytes
}
