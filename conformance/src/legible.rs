//! Texts from outside, such as an adapter's, made fit for a terminal and a report.

use std::fmt::Write as _;

use serde_json::Value;

/// The limit of a sentence, in characters.
pub const LONGEST_TEXT: usize = 1000;

/// The limit of a name, in characters.
pub const LONGEST_NAME: usize = 100;

/// Room for the note that a text was cut, in characters.
const NOTE: usize = 36;

/// A text from outside on one line, `longest` characters at most. Characters that control a
/// terminal, break a line, change the direction of the script or are invisible are escaped. A long
/// text is cut, and ends with the number of bytes that are missing. What is legible stays as it is.
#[must_use]
pub fn legible(text: &str, longest: usize) -> String {
    let mut clean = String::with_capacity(text.len().min(longest));
    let mut size = 0;
    // Where the text is cut if it is too long: the places in it and in the clean one.
    let mut cut = (0, 0);
    for (at, character) in text.char_indices() {
        if size <= longest.saturating_sub(NOTE) {
            cut = (at, clean.len());
        }
        if is_seen(character) {
            clean.push(character);
            size += 1;
        } else {
            let escaped = character.escape_default();
            size += escaped.len();
            clean.extend(escaped);
        }
        if size > longest {
            let (from, to) = cut;
            clean.truncate(to);
            // Writing to a string can't fail.
            let _ = write!(clean, "… ({} bytes more)", text.len() - from);
            break;
        }
    }
    clean
}

/// The first text in a value that is not [`legible`] as it is, made so.
pub(crate) fn first_hidden(value: &Value, longest: usize) -> Option<String> {
    match value {
        Value::String(text) => Some(legible(text, longest)).filter(|clean| clean != text),
        Value::Array(items) => items.iter().find_map(|item| first_hidden(item, longest)),
        Value::Object(fields) => fields.values().find_map(|field| first_hidden(field, longest)),
        _ => None,
    }
}

/// Whether a character shows as what it is, and moves nothing else.
fn is_seen(character: char) -> bool {
    let hidden = matches!(
        character,
        '\u{ad}'                            // a hyphen that shows at the end of a line only
            | '\u{61c}'                     // marks of direction
            | '\u{200e}'..='\u{200f}'
            | '\u{202a}'..='\u{202e}'
            | '\u{2066}'..='\u{2069}'
            | '\u{180e}'                    // characters without a width
            | '\u{200b}'..='\u{200d}'
            | '\u{2060}'..='\u{2065}'
            | '\u{206a}'..='\u{206f}'
            | '\u{feff}'
            | '\u{2028}'..='\u{2029}'       // ends of lines and of paragraphs
            | '\u{fff9}'..='\u{fffb}'       // annotations
            | '\u{fffe}'..='\u{ffff}'       // no characters, and XML refuses them
            | '\u{e0000}'..='\u{e0fff}'     // tags
    );
    !hidden && !character.is_control()
}

/// The limits of the beginning and of the end that [`excerpt`] keeps, in characters. The longest line
/// fits into either.
const HEAD: usize = 1500;
const TAIL: usize = 2500;

/// The beginning and the end of an error output, made legible line by line: the first lines say
/// what happened, and the last ones sum it up.
#[must_use]
pub fn excerpt(log: &str) -> String {
    let lines: Vec<_> = log.lines().map(|line| legible(line, LONGEST_TEXT)).collect();
    let end_of = |limit: usize, lines: &mut dyn Iterator<Item = &String>| {
        let mut left = limit;
        let fits = |line: &&String| {
            left.checked_sub(line.chars().count() + 1).is_some_and(|less| {
                left = less;
                true
            })
        };
        lines.take_while(fits).count()
    };
    let tail = end_of(TAIL, &mut lines.iter().rev());
    let (front, tail) = lines.split_at_checked(lines.len() - tail).unwrap_or_default();
    let head = front.get(..end_of(HEAD, &mut front.iter())).unwrap_or_default();
    let left_out = front.len() - head.len();
    let gap = (left_out > 0).then(|| format!("… ({left_out} lines more)"));
    head.iter().chain(&gap).chain(tail).map(String::as_str).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_text_from_outside_is_one_line() {
        let text = "모두 \u{1b}[31mred\r\n\0 \u{9b}";
        assert_eq!(legible(text, 99), "모두 \\u{1b}[31mred\\r\\n\\u{0} \\u{9b}");
        assert_eq!(legible("a\u{202e}b\u{2028}c\u{200b}", 99), "a\\u{202e}b\\u{2028}c\\u{200b}");
    }

    #[test]
    fn an_error_output_keeps_its_beginning_and_its_end() {
        assert_eq!(excerpt("one\n    two\n\u{7}"), "one\n    two\n\\u{7}");
        // A line of any script fits.
        let long = "말".repeat(999);
        assert_eq!(excerpt(&long), long);
        let line = "x".repeat(999);
        let nine = [line.as_str(); 9].join("\n");
        assert_eq!(excerpt(&nine), format!("{line}\n… (6 lines more)\n{line}\n{line}"));
    }

    #[test]
    fn a_long_text_is_cut_to_the_limit_once() {
        assert_eq!(legible("abcd", 4), "abcd");
        let cut = legible(&"é".repeat(7_000_000), 50);
        assert_eq!(cut, format!("{}… (13999972 bytes more)", "é".repeat(14)));
        let cut = legible(&"\u{1b}".repeat(7_000_000), 50);
        assert_eq!(cut, "\\u{1b}\\u{1b}… (6999998 bytes more)");
        assert_eq!(legible(&cut, 50), cut);
    }
}
