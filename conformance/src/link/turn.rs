//! Who may send: hosts that share a line must not disturb each other.

use std::time::Duration;

use crate::bus::{QUIET, Sender, VirtualBus};

/// A host is alone no longer, however slowly its packet comes.
const PATIENCE: Duration = Duration::from_secs(1);

/// The host whose turn it is. It lasts until its packet is through, or pauses for longer than a packet may.
#[derive(Debug, Default)]
pub(super) struct Turn {
    /// Who was heard last.
    pub(super) sender: Option<Sender>,
    /// When it ends, if the host sends nothing more.
    end: Option<Duration>,
    /// Nobody else is heard until then.
    alone: Duration,
}

impl Turn {
    /// A host was heard until `last`. It is alone if it `may_split` packets.
    pub(super) fn heard(&mut self, sender: Sender, may_split: bool, last: Duration) {
        if self.end.is_none() || self.sender != Some(sender) {
            self.alone = if may_split { last + PATIENCE } else { Duration::ZERO };
        }
        self.sender = Some(sender);
        self.end = Some(last + QUIET);
    }

    /// Ends the turn if its packet is through.
    pub(super) fn settle(&mut self, bus: &VirtualBus) {
        if !bus.is_within_packet() {
            self.end = None;
        }
    }

    /// Ends the turn if the rest of its packet does not come. Returns whether it does.
    pub(super) fn expire(&mut self, now: Duration) -> bool {
        self.end.take_if(|end| *end <= now).is_some()
    }

    /// Whether it is someone's turn.
    pub(super) const fn lasts(&self) -> bool {
        self.end.is_some()
    }

    /// Whether it is a host's turn.
    pub(super) fn is_of(&self, host: u64) -> bool {
        self.lasts() && self.sender.is_some_and(|last| last.host == host)
    }

    /// Whether a host is heard.
    pub(super) fn admits(&self, host: u64, now: Duration) -> bool {
        !self.lasts() || self.alone <= now || self.is_of(host)
    }

    /// When others may be heard next, if that changes.
    pub(super) fn next(&self, now: Duration) -> Option<Duration> {
        self.end.map(|end| if self.alone > now { end.min(self.alone) } else { end })
    }
}
