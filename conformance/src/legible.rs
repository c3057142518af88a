//! Texts from outside, such as an adapter's, made fit for a terminal and a report.

use std::fmt::Write as _;

/// The limit of a sentence, in characters.
pub const LONGEST_TEXT: usize = 1000;

/// A text from outside on one line. Characters that would control a terminal or change the
/// direction of the script are escaped, and a long text is cut.
#[must_use]
pub fn legible(text: &str, longest: usize) -> String {
    let mut clean = String::with_capacity(text.len().min(longest));
    for (count, (at, character)) in text.char_indices().enumerate() {
        if count == longest {
            // Writing to a string can't fail.
            let _ = write!(clean, "… ({} bytes more)", text.len() - at);
            break;
        }
        let turns = matches!(
            character,
            '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
        );
        if character.is_control() || turns {
            clean.extend(character.escape_default());
        } else {
            clean.push(character);
        }
    }
    clean
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_from_outside_is_one_short_line() {
        assert_eq!(legible("모두 \u{1b}[31mred\r\n\0", 99), "모두 \\u{1b}[31mred\\r\\n\\u{0}");
        assert_eq!(legible("a\u{202e}b", 99), "a\\u{202e}b");
        assert_eq!(legible("abcdé", 4), "abcd… (2 bytes more)");
        assert_eq!(legible("abcd", 4), "abcd");
    }
}
