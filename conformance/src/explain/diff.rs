//! Two runs of bytes beside each other, with brackets around what differs.

use similar::{Algorithm, DiffOp, capture_diff_slices};

/// The bytes demanded and the bytes that came, as text of the same form.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diff {
    /// What was demanded, brackets around what is missing.
    pub expected: String,
    /// What came, brackets around what is wrong.
    pub actual: String,
    /// The first byte that differs, from 0; `None` if none does.
    pub first: Option<usize>,
}

/// Compares two runs of bytes. Long stretches in which they agree are left out.
///
/// ```
/// let diff = actucheck::explain::diff::bytes(&[1, 0xFD, 0xFD], &[1, 0xFD]);
/// assert_eq!((diff.expected.as_str(), diff.actual.as_str()), ("01 fd [fd]", "01 fd"));
/// assert_eq!(diff.first, Some(2));
/// ```
#[must_use]
pub fn bytes(expected: &[u8], actual: &[u8]) -> Diff {
    let (mut left, mut right) = (Vec::new(), Vec::new());
    for op in capture_diff_slices(Algorithm::Myers, expected, actual) {
        let old = expected.get(op.old_range()).unwrap_or_default();
        let new = actual.get(op.new_range()).unwrap_or_default();
        if matches!(op, DiffOp::Equal { .. }) {
            left.push(shortened(old));
            right.push(shortened(new));
        } else {
            left.extend(bracketed(old));
            right.extend(bracketed(new));
        }
    }
    let agree = expected.iter().zip(actual).take_while(|(a, b)| a == b).count();
    let first = (expected != actual).then_some(agree);
    Diff { expected: left.join(" "), actual: right.join(" "), first }
}

/// The part of a packet that the byte at `offset` of a whole frame belongs to.
#[must_use]
pub fn part_of_frame(frame: &[u8], offset: usize) -> &'static str {
    match offset {
        0..4 => "header",
        4 => "ID",
        5..7 => "length",
        7 => "instruction",
        _ if offset + 2 >= frame.len() => "CRC",
        _ => "parameters",
    }
}

fn hex(bytes: &[u8]) -> String {
    let bytes: Vec<_> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    bytes.join(" ")
}

fn bracketed(bytes: &[u8]) -> Option<String> {
    (!bytes.is_empty()).then(|| format!("[{}]", hex(bytes)))
}

/// Bytes of which only the ends matter.
fn shortened(bytes: &[u8]) -> String {
    const ENDS: usize = 12;
    match (bytes.get(..ENDS), bytes.len().checked_sub(ENDS).and_then(|at| bytes.get(at..))) {
        (Some(head), Some(tail)) if bytes.len() > 3 * ENDS => {
            format!("{} (… {} bytes …) {}", hex(head), bytes.len() - 2 * ENDS, hex(tail))
        }
        _ => hex(bytes),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_missing_and_what_is_wrong_stand_in_brackets() {
        let diff = bytes(&[9, 0, 0xFF, 0xFD, 0xFD, 0x70], &[8, 0, 0xFF, 0xFD, 0x81]);
        assert_eq!(diff.expected, "[09] 00 ff [fd] fd [70]");
        assert_eq!(diff.actual, "[08] 00 ff fd [81]");
        assert_eq!(diff.first, Some(0));
    }

    #[test]
    fn long_stretches_that_agree_are_left_out() {
        let diff = bytes(&[0; 100], &[0; 100]);
        assert!(diff.expected.contains("(… 76 bytes …)"), "{}", diff.expected);
        assert_eq!(diff.first, None);
    }

    #[test]
    fn each_byte_of_a_frame_has_a_part() {
        let frame = [0xFF, 0xFF, 0xFD, 0x00, 1, 4, 0, 0x55, 0, 0xA1, 0x0C];
        let parts: Vec<_> = (0..frame.len()).map(|at| part_of_frame(&frame, at)).collect();
        assert_eq!(
            parts[4..],
            ["ID", "length", "length", "instruction", "parameters", "CRC", "CRC"]
        );
    }
}
