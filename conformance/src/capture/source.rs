//! The input: a sample of its beginning, and its lines.

use std::borrow::Cow;
use std::io::{self, BufRead, Cursor, Read, Write as _};

use anstream::adapter::{StripBytes, strip_str};

use super::Unreadable;

/// Bytes at the beginning that the form is found from.
const SAMPLE: usize = 64 << 10;
/// The longest line. Nothing that people paste is as long, and memory stays bounded.
pub(super) const LONGEST_LINE: usize = 1 << 20;

/// An input whose beginning is known.
pub(super) struct Sampled {
    sample: Vec<u8>,
    /// Whether the sample is all.
    whole: bool,
    rest: Box<dyn BufRead + Send>,
}

impl Sampled {
    pub(super) fn new(mut input: impl BufRead + Send + 'static) -> io::Result<Self> {
        let mut sample = Vec::new();
        input.by_ref().take(SAMPLE as u64).read_to_end(&mut sample)?;
        let whole = sample.len() < SAMPLE;
        Ok(Self { sample, whole, rest: Box::new(input) })
    }

    pub(super) fn sample(&self) -> &[u8] {
        &self.sample
    }

    /// The sample as text. If it is not all, it has no last line, or no last word of a single line.
    pub(super) fn text(&self) -> String {
        let text = String::from_utf8_lossy(&self.sample);
        let text = plain(&text);
        if self.whole {
            return text.into_owned();
        }
        let end = text.rfind('\n').or_else(|| text.rfind(|c: char| !c.is_alphanumeric()));
        text.get(..end.unwrap_or(text.len() & !1)).unwrap_or(&text).to_owned()
    }

    /// All of it.
    pub(super) fn into_bytes(self) -> impl BufRead + Send {
        Cursor::new(self.sample).chain(self.rest)
    }

    pub(super) fn into_lines(self) -> Lines {
        Lines { input: Box::new(self.into_bytes()), number: 0 }
    }
}

/// A text without colours, read a part at a time.
pub(super) struct Plain<R> {
    input: R,
    strip: StripBytes,
}

impl<R: BufRead> Plain<R> {
    pub(super) fn new(input: R) -> Self {
        Self { input, strip: StripBytes::new() }
    }
}

impl<R: BufRead> Read for Plain<R> {
    fn read(&mut self, mut out: &mut [u8]) -> io::Result<usize> {
        loop {
            let bytes = self.input.fill_buf()?;
            let bytes = bytes.get(..out.len()).unwrap_or(bytes);
            let (taken, room) = (bytes.len(), out.len());
            self.strip.strip_next(bytes).try_for_each(|part| out.write_all(part))?;
            self.input.consume(taken);
            let written = room - out.len();
            // Nothing written is the end of the text, but a part of it may be all colour.
            if written > 0 || taken == 0 {
                return Ok(written);
            }
        }
    }
}

/// The lines of a text, with their numbers.
pub(super) struct Lines {
    input: Box<dyn BufRead + Send>,
    pub(super) number: u64,
}

impl Lines {
    /// The next line without its end; `None` at the end of the text.
    pub(super) fn next(&mut self) -> Result<Option<String>, Unreadable> {
        let mut bytes = Vec::new();
        self.input.by_ref().take(LONGEST_LINE as u64 + 1).read_until(b'\n', &mut bytes)?;
        if bytes.is_empty() {
            return Ok(None);
        }
        self.number += 1;
        let wrong = |what: &str| Unreadable::Line { line: self.number, what: what.to_owned() };
        if !is_text(&bytes) {
            return Err(wrong("this is no text; for a file of plain bytes give --input raw"));
        }
        if bytes.len() > LONGEST_LINE {
            return Err(wrong("longer than 1 MiB; break it into lines"));
        }
        let text = String::from_utf8_lossy(&bytes);
        Ok(Some(plain(text.trim_end_matches(['\r', '\n'])).into_owned()))
    }
}

/// A text without its byte order mark and without colours.
fn plain(text: &str) -> Cow<'_, str> {
    let text = text.trim_start_matches('\u{feff}');
    if text.contains('\x1B') { strip_str(text).to_string().into() } else { text.into() }
}

/// Whether bytes can be text: no control characters, except white space and colours.
pub(super) fn is_text(bytes: &[u8]) -> bool {
    let control = |byte: &u8| *byte < b' ' && !b"\t\n\r\x0B\x0C\x1B".contains(byte);
    let readable = match std::str::from_utf8(bytes) {
        Ok(_) => true,
        // A character may be cut at the end of a sample.
        Err(error) => error.valid_up_to() + 4 > bytes.len() && error.error_len().is_none(),
    };
    readable && !bytes.iter().any(control)
}
