//! Fits texts into the width of a terminal.

use textwrap::core::display_width;
use textwrap::{Options, WordSplitter, wrap};

/// A text on one line: what is too long is cut at the end, or on both sides of the place `at`, in
/// characters, which remains in view.
pub(super) fn cut(text: &str, width: usize, at: usize) -> String {
    if display_width(text) <= width {
        return text.to_owned();
    }
    // A third of the line is before the place, unless the whole beginning fits.
    let start = if at < width * 2 / 3 { 0 } else { at - width / 3 };
    let mut line = if start > 0 { "…".to_owned() } else { String::new() };
    let mut left = width.saturating_sub(display_width(&line) + 1);
    for character in text.chars().skip(start) {
        let wide = display_width(character.encode_utf8(&mut [0; 4]));
        if wide > left {
            line.push('…');
            return line;
        }
        left -= wide;
        line.push(character);
    }
    line
}

/// A text on at most `most` lines of this width.
pub(super) fn lines(text: &str, width: usize, most: usize) -> Vec<String> {
    let options = Options::new(width).word_splitter(WordSplitter::NoHyphenation);
    let mut lines: Vec<_> = wrap(text, options).into_iter().map(String::from).collect();
    if lines.len() > most {
        lines.truncate(most);
        if let Some(last) = lines.last_mut() {
            *last = cut(&format!("{last} …"), width, 0);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_line_is_cut_around_what_matters() {
        assert_eq!(cut("0123456789", 10, 9), "0123456789");
        assert_eq!(cut("0123456789", 9, 0), "01234567…");
        assert_eq!(cut("0123456789ABCDEFGHIJ", 9, 12), "…9ABCDEF…");
        assert_eq!(cut("0123456789ABCDEFGHIJ", 9, 18), "…FGHIJ");
        assert_eq!(cut("처리처리", 6, 0), "처리…");
        assert_eq!(cut("0123", 0, 0), "…");
    }

    #[test]
    fn a_long_text_takes_few_lines() {
        assert_eq!(lines("one two three", 7, 2), ["one two", "three"]);
        assert_eq!(lines("one two three", 7, 1), ["one tw…"]);
        assert_eq!(lines("", 7, 1), [""]);
    }
}
