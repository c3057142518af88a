//! Compares two byte sequences and puts brackets around the differences.

use std::fmt;

use actucheck_spec::model::HexBytes;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use similar::{Algorithm, DiffOp, capture_diff_slices};

/// The expected and the actual bytes, split where they differ.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Diff {
    /// The expected bytes; those that differ are missing in the actual ones.
    pub expected: Row,
    /// The actual bytes; those that differ are wrong.
    pub actual: Row,
    /// Index of the first byte that differs, from 0; `None` if they are equal.
    pub first: Option<usize>,
}

/// Bytes in their order.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Row(pub Vec<Segment>);

/// A part of a row.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Segment {
    /// Bytes that both rows have.
    Same(HexBytes),
    /// Bytes that only this row has.
    Differs(HexBytes),
    /// A number of omitted bytes: in the middle of a long part that both rows have, or at the end of a
    /// long part that differs.
    LeftOut(usize),
}

/// Longest part that differs: one that is longer is cut, and not searched for bytes that both rows have.
const LONGEST: usize = 512;

/// Compares two byte sequences. Long parts are cut, so that a row is short and quick to make.
///
/// ```
/// let diff = actucheck::explain::diff::bytes(&[1, 0xFD, 0xFD], &[1, 0xFD]);
/// assert_eq!(diff.expected.to_string(), "01 fd [fd]");
/// assert_eq!(diff.actual.to_string(), "01 fd");
/// assert_eq!(diff.first, Some(2));
/// ```
#[must_use]
pub fn bytes(expected: &[u8], actual: &[u8]) -> Diff {
    let agree =
        |pairs: &mut dyn Iterator<Item = (&u8, &u8)>| pairs.take_while(|(a, b)| a == b).count();
    let head = agree(&mut expected.iter().zip(actual));
    let (same_head, old) = expected.split_at_checked(head).unwrap_or_default();
    let (_, new) = actual.split_at_checked(head).unwrap_or_default();
    let tail = agree(&mut old.iter().rev().zip(new.iter().rev()));
    let (old, same_tail) = old.split_at_checked(old.len() - tail).unwrap_or_default();
    let (new, _) = new.split_at_checked(new.len() - tail).unwrap_or_default();

    let (mut left, mut right) = (same(same_head), same(same_head));
    if old.len().max(new.len()) > LONGEST {
        left.extend(differs(old));
        right.extend(differs(new));
    } else {
        for op in capture_diff_slices(Algorithm::Myers, old, new) {
            let old = old.get(op.old_range()).unwrap_or_default();
            let new = new.get(op.new_range()).unwrap_or_default();
            if matches!(op, DiffOp::Equal { .. }) {
                left.extend(same(old));
                right.extend(same(new));
            } else {
                left.extend(differs(old));
                right.extend(differs(new));
            }
        }
    }
    left.extend(same(same_tail));
    right.extend(same(same_tail));
    let first = (expected != actual).then_some(head);
    Diff { expected: Row(left), actual: Row(right), first }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let segments: Vec<_> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&segments.join(" "))
    }
}

/// Differences are in brackets.
impl fmt::Display for Segment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Same(bytes) => f.write_str(&spaced(bytes)),
            Self::Differs(bytes) => write!(f, "[{}]", spaced(bytes)),
            Self::LeftOut(bytes) => write!(f, "(… {bytes} bytes …)"),
        }
    }
}

/// Bytes in hex with spaces between.
#[must_use]
pub fn spaced(bytes: &[u8]) -> String {
    let bytes: Vec<_> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    bytes.join(" ")
}

fn differs(bytes: &[u8]) -> Vec<Segment> {
    let (shown, rest) = bytes.split_at_checked(LONGEST).unwrap_or((bytes, &[]));
    let mut segments = Vec::new();
    if !shown.is_empty() {
        segments.push(Segment::Differs(shown.to_vec().into()));
    }
    if !rest.is_empty() {
        segments.push(Segment::LeftOut(rest.len()));
    }
    segments
}

/// Only the ends of a long part matter.
fn same(bytes: &[u8]) -> Vec<Segment> {
    const ENDS: usize = 12;
    let whole = |bytes: &[u8]| Segment::Same(bytes.to_vec().into());
    match (bytes.get(..ENDS), bytes.len().checked_sub(ENDS).and_then(|at| bytes.get(at..))) {
        (Some(head), Some(tail)) if bytes.len() > 3 * ENDS => {
            vec![whole(head), Segment::LeftOut(bytes.len() - 2 * ENDS), whole(tail)]
        }
        _ if bytes.is_empty() => Vec::new(),
        _ => vec![whole(bytes)],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_and_what_is_wrong_stand_in_brackets() {
        let diff = bytes(&[9, 0, 0xFF, 0xFD, 0xFD, 0x70], &[8, 0, 0xFF, 0xFD, 0x81]);
        assert_eq!(diff.expected.to_string(), "[09] 00 ff [fd] fd [70]");
        assert_eq!(diff.actual.to_string(), "[08] 00 ff fd [81]");
        assert_eq!(diff.first, Some(0));
    }

    #[test]
    fn long_stretches_that_agree_are_left_out() {
        let diff = bytes(&[0; 100], &[0; 100]);
        let zeros = ["00"; 12].join(" ");
        assert_eq!(diff.expected.to_string(), format!("{zeros} (… 76 bytes …) {zeros}"));
        assert_eq!(diff.first, None);
    }

    #[test]
    fn what_differs_for_long_is_cut() {
        let diff = bytes(&[1, 2, 3], &[vec![1], vec![9; 7_000_000], vec![3]].concat());
        let Row(row) = &diff.actual;
        let [Segment::Same(_), Segment::Differs(shown), Segment::LeftOut(rest), Segment::Same(_)] =
            row.as_slice()
        else {
            panic!("{row:?}");
        };
        assert_eq!((shown.len(), *rest), (LONGEST, 7_000_000 - LONGEST));
        assert_eq!(diff.expected.to_string(), "01 [02] 03");
        assert_eq!(diff.first, Some(1));
    }
}
