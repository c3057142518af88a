//! Text in lines, each with bytes in one notation, and perhaps with a time, a direction and words.

use std::collections::VecDeque;

use actucheck_spec::wire::Direction;

use super::other::{forgotten, instead};
use super::up_to_error;
use crate::capture::line::{self, Marked};
use crate::capture::source::{Lines, Sampled};
use crate::capture::{Form, Piece, Pieces, Unreadable};

/// How bytes are written within a line.
pub(in crate::capture) trait Notation {
    /// What stands before the bytes, and the bytes with what follows them. Times and directions are
    /// looked for in the first part only.
    fn split<'a>(&self, line: &'a str) -> (&'a str, &'a str) {
        (line, "")
    }

    /// The bytes in a part of a line, without its time and direction.
    ///
    /// # Errors
    /// What is wrong with the text.
    fn bytes(&self, text: &str) -> Result<Vec<u8>, String>;
}

/// The pieces of a text in a form, which has this notation.
pub(super) fn pieces(input: Sampled, form: Form, notation: impl Notation + 'static) -> Pieces {
    let lines = input.into_lines();
    let mut text = Text { lines, form, notation, standing: None, ready: VecDeque::new() };
    up_to_error(move || {
        while text.ready.is_empty() && text.line()? {}
        Ok(text.ready.pop_front())
    })
}

struct Text<N> {
    lines: Lines,
    form: Form,
    notation: N,
    /// The direction in a line of its own, which is that of the lines after it.
    standing: Option<Direction>,
    ready: VecDeque<Piece>,
}

impl<N: Notation> Text<N> {
    /// Reads a line; `false` at the end of the text.
    fn line(&mut self) -> Result<bool, Unreadable> {
        let Some(line) = self.lines.next()? else { return Ok(false) };
        let number = self.lines.number;
        let wrong = |what| Unreadable::Line { line: number, what };
        let fault = |what| wrong(instead(self.form, &line).unwrap_or(what));
        let (before, payload) = self.notation.split(&line);
        let (time, marked) = line::read(before, payload);
        let mut found = false;
        let mut unmarked = None;
        for Marked { direction, text } in marked {
            let bytes = match self.notation.bytes(&text) {
                Ok(bytes) => bytes,
                // Words before a direction are no bytes.
                Err(what) if direction.is_none() && unmarked.is_none() => {
                    unmarked = Some(Err(what));
                    continue;
                }
                Err(what) => return Err(fault(what)),
            };
            if direction.is_none() {
                unmarked = Some(Ok(bytes));
            } else if bytes.is_empty() {
                self.standing = direction;
            } else {
                found = true;
                self.standing = None;
                let line = Some(number);
                self.ready.push_back(Piece { bytes, direction, time, line, ..Piece::default() });
            }
        }
        // What stands before a direction is a name or a number, unless no bytes follow.
        if !found && let Some(bytes) = unmarked {
            let bytes = bytes.map_err(fault)?;
            if !bytes.is_empty() {
                let (direction, line) = (self.standing, Some(number));
                self.ready.push_back(Piece { bytes, direction, time, line, ..Piece::default() });
            } else if let Some(what) = forgotten(self.form, &line) {
                return Err(wrong(what));
            }
        }
        Ok(true)
    }
}

/// What a token is in a notation.
pub(super) enum Token {
    /// One byte or more.
    Bytes,
    /// A number that is no byte.
    Wrong,
    /// Something else.
    Word,
}

/// The bytes of a text whose tokens `token` reads. Words may stand before and after the bytes.
pub(super) fn tokens(
    text: &str,
    hint: &str,
    token: impl Fn(&str, &mut Vec<u8>) -> Token,
) -> Result<Vec<u8>, String> {
    let mut bytes = Vec::new();
    let mut wrong = None;
    let mut words = 0_usize;
    let mut after = None;
    let separator = |c: char| !c.is_alphanumeric() && !"._$-".contains(c);
    // The path ./ has one dot.
    let is_word = |word: &&str| !["", "."].contains(word);
    for word in text.split(separator).flat_map(parts).filter(is_word) {
        match token(word, &mut bytes) {
            Token::Bytes => {
                if let Some(word) = after {
                    return Err(format!("`{word}` between bytes is no byte; {hint}"));
                }
            }
            Token::Wrong => wrong = wrong.or(Some(word)),
            Token::Word => {
                words += 1;
                if !line::is_plain_word(word) {
                    wrong = wrong.or(Some(word));
                } else if !bytes.is_empty() {
                    after = Some(word);
                }
            }
        }
    }
    match wrong {
        Some(word) if !bytes.is_empty() || words == 0 || text.split_whitespace().count() == 1 => {
            Err(format!("`{}` is no byte; {hint}", line::shortened(word)))
        }
        _ => Ok(bytes),
    }
}

/// A hyphen parts bytes, unless it is a sign.
fn parts(word: &str) -> impl Iterator<Item = &str> {
    let signed = word.strip_prefix('-').is_some_and(|rest| !rest.is_empty() && !rest.contains('-'));
    let separator = if signed { None } else { Some('-') };
    word.split(move |c| Some(c) == separator)
}
