//! The parts of an explanation of a frame.

use super::diff::spaced;

/// The meaning of a frame's bytes, one row per field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// The whole frame in a sentence.
    pub title: String,
    /// The fields in the order of their bytes.
    pub rows: Vec<Row>,
}

/// One field of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// Its offset in the frame.
    pub offset: usize,
    /// Its bytes; bytes that byte stuffing added are in parentheses.
    pub bytes: String,
    /// Its name.
    pub field: String,
    /// Its meaning.
    pub meaning: String,
}

/// The rows of an explanation while they are being found.
pub(super) struct Table<'a> {
    frame: &'a [u8],
    pub(super) rows: Vec<Row>,
    next: usize,
}

impl<'a> Table<'a> {
    pub(super) fn new(frame: &'a [u8]) -> Self {
        Self { frame, rows: Vec::new(), next: 0 }
    }

    /// Adds a field at any place.
    pub(super) fn push(&mut self, offset: usize, bytes: String, field: &str, meaning: &str) {
        let (field, meaning) = (field.to_owned(), meaning.to_owned());
        self.rows.push(Row { offset, bytes, field, meaning });
    }

    /// Adds the next bytes of the frame as a field.
    pub(super) fn take(&mut self, size: usize, field: &str, meaning: impl Fn(&[u8]) -> String) {
        let bytes = self.frame.get(self.next..self.next + size).unwrap_or_default();
        self.push(self.next, spaced(bytes), field, &meaning(bytes));
        self.next += size;
    }

    /// Adds the frame's last bytes as a field.
    pub(super) fn take_last(
        &mut self,
        size: usize,
        field: &str,
        meaning: impl Fn(&[u8]) -> String,
    ) {
        self.next = self.frame.len().saturating_sub(size);
        self.take(size, field, meaning);
    }
}

/// The rows of `frame` for bytes that differ from it, or end before it or after it.
pub(super) fn received(rows: Vec<Row>, frame: &[u8], bytes: &[u8]) -> Vec<Row> {
    let ends: Vec<_> = rows.iter().skip(1).map(|row| row.offset).chain([frame.len()]).collect();
    let mut kept = Vec::new();
    for (mut row, end) in rows.into_iter().zip(ends) {
        if row.offset >= bytes.len() {
            break;
        }
        let part = |all: &[u8]| all.get(row.offset..end.min(all.len())).map(spaced);
        let found = part(bytes).unwrap_or_default();
        if end > bytes.len() {
            (row.bytes, row.meaning) = (found, "the rest is missing".to_owned());
        } else if let Some(right) = part(frame).filter(|right| *right != found) {
            (row.bytes, row.meaning) = (found, format!("{} is expected", right.to_uppercase()));
        }
        kept.push(row);
    }
    if let Some(after) = bytes.get(frame.len()..).filter(|after| !after.is_empty()) {
        let (offset, field) = (frame.len(), "after it".to_owned());
        let meaning = "not counted in the length".to_owned();
        kept.push(Row { offset, bytes: spaced(after), field, meaning });
    }
    kept
}

/// A number whose low byte comes first.
pub(super) fn low_first(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |value, byte| value << 8 | u64::from(*byte))
}

/// At most six decimals, without zeros at the end.
pub(super) fn rounded(value: f64) -> String {
    let text = format!("{value:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
