//! Lines that begin with an offset: xxd, `hexdump -C`, hexdump, od and Wireshark.

use std::sync::LazyLock;

use regex::Regex;

use super::other::forgotten;
use super::up_to_error;
use crate::capture::source::{Lines, Sampled};
use crate::capture::{Form, Piece, Pieces, Unreadable};

/// The most bytes that a line stands for, with the lines that a `*` leaves out.
const MOST: u64 = 1 << 20;

static ROW: LazyLock<Regex> = LazyLock::new(|| {
    #[allow(clippy::expect_used)] // a test uses it
    Regex::new(r"^\s*(?P<offset>[0-9a-fA-F]{3,16})(?P<colon>:)?(?:\s|$)")
        .expect("a pattern of this file")
});

/// What stands around the characters.
const MARKS: [char; 3] = ['|', '>', '<'];

/// A line of a dump.
#[derive(Clone, Debug)]
struct Row {
    offset: String,
    colon: bool,
    rest: String,
}

impl Row {
    fn of(line: &str) -> Option<Self> {
        let found = ROW.captures(line)?;
        let offset = found.name("offset")?.as_str().to_owned();
        let colon = found.name("colon").is_some();
        // Every character before the end of a byte is ASCII then.
        let wide = |c: char| c.is_whitespace() && !c.is_ascii();
        let rest = line.get(found.get_match().end()..)?.trim_start().replace(wide, " ");
        Some(Self { offset, colon, rest })
    }

    fn offset(&self, radix: u32) -> Option<u64> {
        u64::from_str_radix(&self.offset, radix).ok()
    }

    /// The bytes of the groups at the beginning, and where each byte ends in the text. What follows a
    /// gap that is wider than the one in the middle of some lines are characters.
    fn groups(&self) -> Vec<(u8, usize)> {
        let numbers = self.has_numbers();
        let mut bytes = Vec::new();
        let mut at = 0;
        for word in self.rest.split_inclusive(char::is_whitespace) {
            let digits = word.trim_end();
            if self.rest.get(..at).is_some_and(|before| before.ends_with("   ")) {
                break;
            }
            let hex = digits.bytes().all(|digit| digit.is_ascii_hexdigit());
            if !hex || !digits.len().is_multiple_of(2) {
                break;
            }
            let pairs = digits.as_bytes().chunks(2).enumerate().filter_map(|(index, pair)| {
                let pair = std::str::from_utf8(pair).ok()?;
                Some((u8::from_str_radix(pair, 16).ok()?, at + 2 * index + 2))
            });
            let group: Vec<_> = pairs.collect();
            // hexdump without -C prints numbers whose low byte comes first.
            if let ([(low, _), (high, end)], true) = (group.as_slice(), numbers) {
                bytes.extend([(*high, *end), (*low, *end)]);
            } else {
                bytes.extend(group);
            }
            at += word.len();
        }
        bytes
    }

    fn has_numbers(&self) -> bool {
        let words = || self.rest.split_whitespace();
        self.offset.len() == 7 && !self.colon && words().all(|word| word.len() == 4)
    }

    /// The numbers of bytes that the line may have: those after which the rest is as many characters.
    fn sizes(&self, bytes: &[(u8, usize)]) -> Vec<usize> {
        let all = self.rest.trim_end().trim_end_matches(MARKS).chars().count();
        let fits = |(index, (_, end)): (usize, &(u8, usize))| {
            let rest = self.rest.get(*end..)?;
            let column = rest.trim_start().trim_start_matches(MARKS);
            let column = all.saturating_sub(self.rest.len() - column.len());
            let size = index + 1;
            // Spaces at the end may be lost, and Wireshark has one in the middle.
            let column_fits = rest.starts_with("  ") || rest.trim_start().starts_with(MARKS);
            let last = size == bytes.len() && column == 0;
            (last || column_fits && column > 0 && column <= size + 1 && column + 8 > size)
                .then_some(size)
        };
        bytes.iter().enumerate().filter_map(fits).collect()
    }

    /// The number of bytes of the last line, which no offset tells.
    fn size(&self, bytes: &[(u8, usize)]) -> Option<usize> {
        // Characters may look like bytes. They are as many as the bytes, and after a wider gap than
        // the one in the middle of some lines.
        let all = self.rest.chars().count();
        let exact = |(index, (_, end)): (usize, &(u8, usize))| {
            let rest = self.rest.get(*end..)?;
            let size = index + 1;
            let gap = rest.len() - rest.trim_start().len();
            let fits = all - end - gap == size && gap > 1 && (gap > 2 || size != 8);
            fits.then_some(size)
        };
        let exact = bytes.iter().enumerate().find_map(exact);
        exact.or_else(|| self.sizes(bytes).last().copied()).or(Some(bytes.len()).filter(|n| *n > 0))
    }

    /// The bytes, if the next line says that there are `size`.
    fn bytes(&self, size: Option<u64>) -> Option<Vec<u8>> {
        let bytes = self.groups();
        let take = |count: usize| bytes.iter().take(count).map(|(byte, _)| *byte).collect();
        let size = size.and_then(|size| usize::try_from(size).ok());
        match size {
            Some(size) if size <= bytes.len() => Some(take(size)),
            // hexdump pads the last number.
            Some(_) => None,
            None => self.size(&bytes).map(take),
        }
    }
}

/// Whether a text is a dump: its offsets count its bytes, or it is one line with a mark of a dump.
pub(in crate::capture) fn is_dump(text: &str) -> bool {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let Some(first) = lines.next().and_then(Row::of) else { return false };
    let begins = first.offset.bytes().all(|digit| digit == b'0') && !first.rest.is_empty();
    let next = lines.next().and_then(Row::of);
    let groups = first.groups();
    let sizes = first.sizes(&groups);
    let follows = |next: &Row, radix: u32| {
        let (Some(from), Some(to)) = (first.offset(radix), next.offset(radix)) else {
            return false;
        };
        // After the bytes there may be characters that look like bytes.
        let fits = |size: usize| to - from <= size as u64 && to - from + 1 >= size as u64;
        to > from && (fits(groups.len()) || sizes.iter().copied().any(fits))
    };
    if let Some(next) = next {
        return [16, 8].into_iter().any(|radix| follows(&next, radix));
    }
    let mut ends = sizes.iter().filter_map(|size| groups.get(size - 1));
    let column = ends.any(|(_, end)| *end < first.rest.trim_end().len());
    begins && (first.colon || column) && !groups.is_empty()
}

/// The bytes of a line that is a dump by itself.
pub(super) fn bytes(line: &str) -> Option<Vec<u8>> {
    Row::of(line).filter(|_| is_dump(line))?.bytes(None)
}

/// The pieces of a dump.
pub(super) fn pieces(input: Sampled) -> Pieces {
    let radix = if is_octal(&input.text()) { 8 } else { 16 };
    let lines = input.into_lines();
    let mut dump = Dump { lines, radix, held: None, repeated: false };
    let mut wrong = None;
    up_to_error(move || {
        if let Some(error) = wrong.take() {
            return Err(error);
        }
        // The row that is held comes before what is wrong with a later line.
        dump.next().or_else(|error| match dump.held(None)? {
            None => Err(error),
            held => {
                wrong = Some(error);
                Ok(held)
            }
        })
    })
}

/// od counts in octal: the second offset is 20 where others have 10.
fn is_octal(text: &str) -> bool {
    let mut rows = text.lines().filter_map(Row::of);
    let (Some(first), Some(second)) = (rows.next(), rows.next()) else { return false };
    let count = first.groups().len() as u64;
    let step = |radix| second.offset(radix)?.checked_sub(first.offset(radix)?);
    step(16) != Some(count) && step(8).is_some_and(|step| step == count)
}

struct Dump {
    lines: Lines,
    radix: u32,
    /// The row whose size the next offset tells, and its line.
    held: Option<(Row, u64)>,
    /// A `*` came after it.
    repeated: bool,
}

impl Dump {
    fn next(&mut self) -> Result<Option<Piece>, Unreadable> {
        while let Some(line) = self.lines.next()? {
            if line.trim() == "*" {
                self.repeated = self.held.is_some();
                continue;
            }
            // What is no row are words between two dumps, such as the name of a file.
            let row = Row::of(&line);
            if row.is_none()
                && let Some(what) = forgotten(Form::Dump, &line)
            {
                return Err(Unreadable::Line { line: self.lines.number, what });
            }
            let piece = self.held(row.as_ref().and_then(|row| row.offset(self.radix)))?;
            let number = self.lines.number;
            self.held = row.filter(|row| !row.rest.is_empty()).map(|row| (row, number));
            if piece.is_some() {
                return Ok(piece);
            }
        }
        self.held(None)
    }

    /// The bytes of the row that is held, before a row at `next`.
    fn held(&mut self, next: Option<u64>) -> Result<Option<Piece>, Unreadable> {
        let Some((row, line)) = self.held.take() else { return Ok(None) };
        let wrong = |what: String| Unreadable::Line { line, what };
        let start = row.offset(self.radix);
        let start = start.ok_or_else(|| wrong(format!("`{}` is no offset", row.offset)))?;
        let repeated = std::mem::take(&mut self.repeated);
        // A lower offset begins another dump.
        let size = next.and_then(|next| next.checked_sub(start)).filter(|size| *size > 0);
        let row_size = if repeated { None } else { size };
        let mut bytes = row.bytes(row_size).filter(|bytes| !bytes.is_empty()).ok_or_else(|| {
            let size = row_size.map_or_else(|| "some".to_owned(), |size| size.to_string());
            wrong(format!("the next offset asks for {size} bytes in this line, which it has not"))
        })?;
        if let (true, Some(size)) = (repeated, size) {
            let whole = usize::try_from(size).ok().filter(|_| size <= MOST);
            let whole = whole.ok_or_else(|| {
                wrong(
                    "a * after this line leaves out more than 1 MiB; print all lines (-v)"
                        .to_owned(),
                )
            })?;
            bytes = bytes.iter().copied().cycle().take(whole).collect();
        }
        let ends = size.is_none();
        Ok(Some(Piece { bytes, line: Some(line), ends, ..Piece::default() }))
    }
}
