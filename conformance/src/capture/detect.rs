//! Finds the form of an input.
//!
//! Each form says whether the beginning of the input can be in it. A form with a mark of its own,
//! such as `\x`, is sure. If none is and two remain that give different bytes, that is an error.

use super::form::{is_csv, is_dump, is_escaped, is_pcap};
use super::source::{Sampled, is_text};
use super::{Form, Unreadable};

/// The form of an input.
///
/// # Errors
/// If there is none, or more than one.
pub(super) fn form(input: &Sampled) -> Result<Form, Unreadable> {
    let sample = input.sample();
    if sample.iter().all(u8::is_ascii_whitespace) {
        return Err(Unreadable::Empty);
    }
    if is_pcap(sample) {
        return Ok(Form::Pcap);
    }
    if !is_text(sample) {
        return Ok(Form::Raw);
    }
    let text = &input.text();
    if is_dump(text) {
        return Ok(Form::Dump);
    }
    if is_csv(text) {
        return Ok(Form::Csv);
    }
    if is_escaped(text) {
        return Ok(Form::Escaped);
    }
    notation(text)
}

/// Hex or decimal.
fn notation(text: &str) -> Result<Form, Unreadable> {
    let hex = bytes(Form::Hex, text);
    let decimal = bytes(Form::Decimal, text);
    match (hex, decimal) {
        (Ok(hex), Ok(decimal)) if hex != decimal => {
            // In an array of a program a number without 0x is decimal.
            let program =
                text.contains("0x") && text.contains(',') && text.contains(['{', '[', '(']);
            if program {
                return Ok(Form::Decimal);
            }
            Err(Unreadable::Ambiguous(vec![(Form::Hex, hex), (Form::Decimal, decimal)]))
        }
        (Ok(_), _) => Ok(Form::Hex),
        (Err(_), Ok(_)) => Ok(Form::Decimal),
        (Err(hex), Err(decimal)) => {
            // The form that gets farther is the one that is meant; in one line, that of more words.
            let far = |form, error: &Unreadable| match error {
                Unreadable::Line { line, .. } => (*line, words(form, text, *line)),
                _ => (0, 0),
            };
            let decimal_is_meant = far(Form::Decimal, &decimal) > far(Form::Hex, &hex);
            Err(if decimal_is_meant { decimal } else { hex })
        }
    }
}

/// How many words of a line, from 1, are bytes by themselves. The first ones tell enough.
fn words(form: Form, text: &str, line: u64) -> usize {
    const MOST: usize = 1000;
    let line = (1..).zip(text.lines()).find(|(number, _)| *number == line);
    let words = line.map_or("", |(_, text)| text).split([' ', '\t', ',', ';']).take(MOST);
    words.filter(|word| bytes(form, word).is_ok()).count()
}

fn bytes(form: Form, text: &str) -> Result<Vec<u8>, Unreadable> {
    let text = Sampled::new(std::io::Cursor::new(text.as_bytes().to_vec()))?;
    let mut bytes = Vec::new();
    for piece in form.pieces(text) {
        bytes.extend(piece?.bytes);
    }
    if bytes.is_empty() { Err(Unreadable::Empty) } else { Ok(bytes) }
}
