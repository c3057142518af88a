//! What passes on the line of a host in a step.

use std::time::Duration;

use actucheck_spec::wire::Direction;

use crate::adapter::Passed;

/// The most bytes of a step that are kept, and in how many pieces.
const KEPT: (usize, usize) = (1024, 48);

/// What passes, as far as it is kept.
#[derive(Debug, Default)]
pub(super) struct Passing {
    pub(super) line: Vec<Passed>,
    /// Bytes that are not kept.
    pub(super) more: usize,
}

impl Passing {
    /// Takes bytes that pass so many milliseconds after the step began.
    pub(super) fn add(&mut self, at_ms: u64, direction: Direction, bytes: &[u8]) {
        let size: usize = self.line.iter().map(|passed| passed.bytes.len()).sum();
        let bytes_left = if self.line.len() < KEPT.1 { KEPT.0.saturating_sub(size) } else { 0 };
        let kept = bytes.get(..bytes_left).unwrap_or(bytes);
        self.more += bytes.len() - kept.len();
        if !kept.is_empty() {
            self.line.push(Passed { at_ms, direction, bytes: kept.to_vec().into() });
        }
    }
}

/// A time in whole milliseconds.
pub(super) fn milliseconds(time: Duration) -> u64 {
    u64::try_from(time.as_millis()).unwrap_or(u64::MAX)
}
