//! Who may send: hosts that share a line must not disturb each other.

use std::time::Duration;

use crate::bus::{QUIET, VirtualBus};

/// The host whose turn it is. It lasts until its packet and the answers are through, and not longer than
/// a packet may pause.
#[derive(Debug, Default)]
pub(super) struct Turn {
    /// Who was heard last: what devices send is for it.
    pub(super) host: Option<u64>,
    /// When it ends at the latest.
    pub(super) end: Option<Duration>,
    /// Whether nobody else is heard until then.
    is_alone: bool,
}

impl Turn {
    /// A host was heard, which is alone if it `may_split` packets.
    pub(super) fn heard(&mut self, host: u64, may_split: bool, now: Duration) {
        let end = self.end.filter(|_| self.host == Some(host)).unwrap_or(now + QUIET);
        *self = Self { host: Some(host), end: Some(end), is_alone: may_split };
    }

    /// Ends the turn if its packet and the answers are through.
    pub(super) fn settle(&mut self, bus: &VirtualBus) {
        if !bus.is_within_packet() && bus.next().is_none() {
            self.end = None;
        }
    }

    /// Ends the turn if it lasts too long. Returns whether it does.
    pub(super) fn expire(&mut self, now: Duration) -> bool {
        self.end.take_if(|end| *end <= now).is_some()
    }

    /// Whether a host is heard.
    pub(super) fn admits(&self, host: u64) -> bool {
        self.end.is_none() || !self.is_alone || self.host == Some(host)
    }
}
