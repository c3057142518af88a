//! What answers a packet, each time that it is heard.

use std::collections::VecDeque;
use std::time::Duration;

/// Bytes, and how long after the packet that they answer they are there.
pub(crate) type Bursts = Vec<(Duration, Vec<u8>)>;

/// What answers one packet, and no other.
#[derive(Debug, Default)]
pub(crate) struct Answers {
    packet: Vec<u8>,
    left: VecDeque<Bursts>,
    /// The last bytes that were heard, as many as the packet has.
    heard: Vec<u8>,
}

impl Answers {
    /// What answers this packet the first time, the second time, and so on.
    pub(crate) fn to(packet: Vec<u8>, answers: impl IntoIterator<Item = Bursts>) -> Self {
        Self { packet, left: answers.into_iter().collect(), heard: Vec::new() }
    }

    /// Takes a byte. Returns what answers the packet that ends with it, if it is the one.
    pub(crate) fn hear(&mut self, byte: u8) -> Option<Bursts> {
        self.heard.push(byte);
        let surplus = self.heard.len().saturating_sub(self.packet.len());
        self.heard.drain(..surplus);
        let is_it = !self.packet.is_empty() && self.heard == self.packet;
        is_it.then(|| self.left.pop_front().unwrap_or_default())
    }

    /// Lets no packet go on after the bytes that were heard.
    #[cfg(unix)]
    pub(crate) fn quiet(&mut self) {
        self.heard.clear();
    }
}
