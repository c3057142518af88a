//! Text with `\xFF`, in quotes or without, as Python and C have it.

use super::other::forgotten;
use super::text::Notation;
use crate::capture::Form;
use crate::capture::line::{comment, is_comment};

/// `b'\xff\xff\xfd\x00\x01\x03\x00\x01\x19N'`.
pub(super) struct Escaped;

impl Notation for Escaped {
    fn split<'a>(&self, line: &'a str) -> (&'a str, &'a str) {
        let start = line.find(['\'', '"', '\\']).unwrap_or(line.len());
        if is_comment(line, start) {
            return (line, "");
        }
        let before = line.get(..start).unwrap_or_default();
        // The b of Python's literals.
        let bare = before.strip_suffix(['b', 'B']).unwrap_or(before);
        let parted = bare.chars().next_back().is_none_or(|last| !last.is_alphanumeric());
        line.split_at(if parted { bare.len() } else { start })
    }

    fn bytes(&self, text: &str) -> Result<Vec<u8>, String> {
        let is_bytes = text.starts_with(['b', 'B']) || text.contains('\\');
        let Some(start) = text.find(['\'', '"', '\\']).filter(|_| is_bytes) else {
            return Ok(Vec::new());
        };
        let (before, mut rest) = text.split_at(start);
        let mut outside = before.to_owned();
        let mut bytes = Vec::new();
        while let Some(first) = rest.chars().next() {
            if first == '\\' {
                // Without quotes, up to white space.
                let (word, after) =
                    rest.split_at(rest.find(char::is_whitespace).unwrap_or(rest.len()));
                literal(word, None, &mut bytes)?;
                rest = after;
            } else if first == '\'' || first == '"' {
                let inner = rest.get(1..).unwrap_or_default();
                let used = literal(inner, Some(first), &mut bytes)?;
                rest = inner.get(used..).unwrap_or_default();
            } else {
                let comment = comment(rest);
                if comment == 0 {
                    outside.push(first);
                }
                rest = rest.get(comment.max(first.len_utf8())..).unwrap_or_default();
            }
        }
        match forgotten(Form::Escaped, &outside) {
            Some(what) => Err(what),
            None => Ok(bytes),
        }
    }
}

/// Whether a text has `\x`, or bytes as Python prints them: a b that no word ends with, and a quote.
pub(in crate::capture) fn is_escaped(text: &str) -> bool {
    text.lines().any(|line| {
        let (_, payload) = Escaped.split(line);
        let begins = |(at, _)| {
            !payload.get(..at).is_some_and(|before| before.ends_with(char::is_alphanumeric))
        };
        payload.contains("\\x")
            || ["b'", "b\""].iter().any(|start| payload.match_indices(start).any(begins))
    })
}

/// Reads a literal up to its quote; returns how much of the text it is.
fn literal(text: &str, quote: Option<char>, bytes: &mut Vec<u8>) -> Result<usize, String> {
    let mut characters = text.char_indices().peekable();
    while let Some((at, character)) = characters.next() {
        if Some(character) == quote {
            return Ok(at + 1);
        }
        if character != '\\' {
            let mut buffer = [0; 4];
            bytes.extend_from_slice(character.encode_utf8(&mut buffer).as_bytes());
            continue;
        }
        let Some((_, kind)) = characters.next() else { break };
        let mut digits = |radix, most| {
            let mut value = None;
            for _ in 0..most {
                let digit = characters.peek().and_then(|(_, digit)| digit.to_digit(radix));
                let Some(digit) = digit else { break };
                value = Some(value.unwrap_or(0) * radix + digit);
                characters.next();
            }
            value
        };
        let value = match kind {
            'x' => digits(16, 2),
            '0'..='7' => {
                let first = kind.to_digit(8).unwrap_or_default();
                let more = text.get(at + 2..).unwrap_or_default();
                let count = more.bytes().take(2).take_while(|d| (b'0'..b'8').contains(d)).count();
                let rest = digits(8, count);
                Some(rest.map_or(first, |rest| {
                    first * 8_u32.pow(u32::try_from(count).unwrap_or(0)) + rest
                }))
            }
            'n' => Some(10),
            'r' => Some(13),
            't' => Some(9),
            'a' => Some(7),
            'b' => Some(8),
            'f' => Some(12),
            'v' => Some(11),
            '\\' | '\'' | '"' => Some(u32::from(kind)),
            _ => None,
        };
        let byte = value.and_then(|value| u8::try_from(value).ok());
        bytes.push(byte.ok_or_else(|| {
            format!("`\\{kind}` is no byte; bytes are written as `\\xff\\xff\\xfd\\x00`")
        })?);
    }
    match quote {
        Some(quote) => Err(format!("the quote {quote} is not closed")),
        None => Ok(text.len()),
    }
}
