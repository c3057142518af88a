//! Counts what passes on a line.

use std::collections::BTreeMap;
use std::time::Duration;

use crate::traffic::{Response, Times, Traffic};

/// What passed on a line so far.
#[derive(Clone, Debug, Default)]
pub(super) struct Counts {
    pieces: usize,
    sent: usize,
    received: usize,
    unasked: usize,
    times: Times,
    by_instruction: BTreeMap<String, Times>,
}

impl Counts {
    pub(super) const fn sent(&mut self, bytes: &[u8]) {
        self.pieces += 1;
        self.sent += bytes.len();
    }

    pub(super) const fn received(&mut self, count: usize) {
        self.received += count;
    }

    /// Bytes that came when nothing had asked for them.
    pub(super) const fn unasked(&mut self, count: usize) {
        self.received += count;
        self.unasked += count;
    }

    /// An answer began after this time.
    pub(super) fn answered(&mut self, instruction: &str, time: Duration) {
        self.times.add(time);
        if let Some(times) = self.by_instruction.get_mut(instruction) {
            times.add(time);
        } else {
            self.by_instruction.entry(instruction.to_owned()).or_default().add(time);
        }
    }

    /// The longest time that an answer took.
    pub(super) fn slowest(&self) -> Duration {
        self.times.most()
    }

    pub(super) fn traffic(&self) -> Traffic {
        let response = |(instruction, times): (&String, &Times)| {
            Some(Response { instruction: instruction.clone(), spread: times.spread()? })
        };
        Traffic {
            pieces: self.pieces,
            sent: self.sent,
            received: self.received,
            unasked: self.unasked,
            response: self.times.spread(),
            by_instruction: self.by_instruction.iter().filter_map(response).collect(),
        }
    }
}
