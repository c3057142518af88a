//! The bytes of one call of [`Parser::feed`](super::Parser::feed): short packets are found where they are, and
//! only what the parser must look at more closely is copied into its buffer.

use super::Event;
use super::candidate::Whole;
use super::short::Ready;
use crate::dynamixel2::Frame;
use crate::simd::WINDOW;

/// Bytes that the parser is taking.
pub(super) struct Input<'b> {
    bytes: &'b [u8],
    /// The bytes before it were taken.
    at: usize,
    /// Packets from there on.
    ready: Ready,
    /// The parser has no event without more bytes.
    pub(super) is_drained: bool,
}

impl<'b> Input<'b> {
    pub(super) const fn new(bytes: &'b [u8]) -> Self {
        Self { bytes, at: 0, ready: Ready::new(), is_drained: true }
    }

    /// The next of the packets found.
    #[inline]
    pub(super) fn pop(&mut self) -> Option<Whole> {
        self.ready.pop()
    }

    /// Looks for packets from here on, if there are enough bytes before them for a window. Returns whether
    /// there are some.
    pub(super) fn find(&mut self, max_packet: usize) -> bool {
        self.at >= WINDOW && self.ready.find(self.bytes, self.at, max_packet)
    }

    /// Takes a packet that was found.
    #[inline]
    pub(super) fn take(&mut self, Whole { len, patterns, .. }: Whole) -> Option<Event<'b>> {
        let bytes = self.bytes.get(self.at..)?;
        self.at += len;
        Frame::checked(bytes, len, patterns).map(Event::Frame)
    }

    /// The bytes that are not taken yet.
    pub(super) fn rest(&self) -> &'b [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    /// All bytes but the last so many are taken.
    pub(super) const fn take_all_but(&mut self, rest: usize) {
        self.at = self.bytes.len() - rest;
    }

    /// Gives back the last `count` of the bytes that were taken, if they were so many.
    pub(super) fn give_back(&mut self, count: usize) -> bool {
        let at = self.at.checked_sub(count);
        self.at = at.unwrap_or(self.at);
        at.is_some()
    }
}
