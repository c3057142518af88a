//! What one process of a subject was asked, in order.

use std::collections::VecDeque;
use std::sync::Arc;

use crate::suite::check::Check;

/// How many questions before a failure are remembered, in case it depends on them.
const BEFORE: usize = 1024;
/// How many are kept: a failure is examined a little later than it occurs.
const KEPT: usize = 4 * BEFORE;

/// The last questions that a process was asked, also before it was last started.
#[derive(Debug, Default)]
pub(super) struct History {
    entries: VecDeque<Entry>,
    /// How many entries were dropped.
    dropped: usize,
    /// The place of the first question since the process was last started.
    start: usize,
}

#[derive(Debug)]
struct Entry {
    number: usize,
    check: Arc<Check>,
    start: usize,
}

/// A place in the history of a process.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mark {
    start: usize,
    end: usize,
}

impl History {
    /// Adds the question with this number.
    pub(super) fn add(&mut self, number: usize, check: Arc<Check>) {
        if self.entries.len() == KEPT {
            self.entries.pop_front();
            self.dropped += 1;
        }
        self.entries.push_back(Entry { number, check, start: self.start });
    }

    /// The process begins anew with the next question.
    pub(super) fn begin_anew(&mut self) {
        self.start = self.dropped + self.entries.len();
    }

    /// The place where the question with this number was asked last.
    pub(super) fn mark(&self, number: usize) -> Option<Mark> {
        let place = self.entries.iter().rposition(|entry| entry.number == number)?;
        let start = self.entries.get(place)?.start;
        Some(Mark { start, end: self.dropped + place })
    }

    /// What the process was asked before, since it was started, as far as it is remembered.
    pub(super) fn before(&self, mark: Mark) -> Vec<Arc<Check>> {
        let first = mark.start.max(mark.end.saturating_sub(BEFORE)).max(self.dropped);
        let (skip, take) = (first - self.dropped, mark.end.saturating_sub(first));
        let checks = self.entries.iter().skip(skip).take(take);
        checks.map(|entry| Arc::clone(&entry.check)).collect()
    }
}
