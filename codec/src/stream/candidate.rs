//! Whether a packet begins where a header stands.

use super::Reason;
use super::search;
use crate::dynamixel2::{BROADCAST_ID, Instruction, MIN_LENGTH};
use crate::frame::{CRC, PREFIX, check_id};

/// The instruction of a status packet.
pub(super) const STATUS: u8 = Instruction::Status.code();

/// What is known of the bytes from a header on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// More bytes are needed to tell.
    Open,
    /// No packet, whatever follows.
    False(Reason),
    /// All bytes are there, and all rules but that of the CRC hold.
    Whole(Whole),
}

/// A packet whose CRC is still to be checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Whole {
    /// Bytes of the packet.
    pub(super) len: usize,
    /// Patterns in its body, each with a byte of stuffing behind it.
    pub(super) patterns: usize,
    /// It is a fast status packet, which is not stuffed.
    pub(super) fast: bool,
}

/// How far the search for stuffing came while the candidate was incomplete.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Progress {
    /// Where it goes on; 0 before it has begun.
    next: usize,
    patterns: usize,
}

impl Progress {
    pub(super) const fn new() -> Self {
        Self { next: 0, patterns: 0 }
    }

    /// Looks at `bytes`, which begin with a whole header. The rules are tried in the order of the
    /// bytes that can break them, so the first broken one is the same however many bytes are
    /// there behind it.
    #[inline]
    pub(super) fn judge(&mut self, bytes: &[u8], max_packet: usize) -> Verdict {
        let Some(&[_, _, _, _, id, low, high]) = bytes.first_chunk::<PREFIX>() else {
            let bad_id = bytes.get(4).is_some_and(|id| check_id(*id).is_err());
            return if bad_id { Verdict::False(Reason::Id) } else { Verdict::Open };
        };
        if check_id(id).is_err() {
            return Verdict::False(Reason::Id);
        }
        let length = u16::from_le_bytes([low, high]);
        if length < MIN_LENGTH {
            return Verdict::False(Reason::Length);
        }
        let len = PREFIX + usize::from(length);
        if len > max_packet {
            return Verdict::False(Reason::Oversize);
        }
        let Some(&instruction) = bytes.get(PREFIX) else {
            return Verdict::Open;
        };
        let fast = instruction == STATUS && id == BROADCAST_ID;
        if instruction == STATUS && length < min_status_length(fast) {
            return Verdict::False(Reason::Length);
        }
        if !fast && self.find_bare_pattern(bytes, len) {
            return Verdict::False(Reason::Stuffing);
        }
        if bytes.len() < len {
            return Verdict::Open;
        }
        Verdict::Whole(Whole { len, patterns: self.patterns, fast })
    }

    /// Whether a pattern stands in the body without its stuffing. A header inside the body is
    /// one, so a candidate never outlasts the packet behind it.
    #[inline]
    fn find_bare_pattern(&mut self, bytes: &[u8], len: usize) -> bool {
        let body_end = len - CRC;
        let there = bytes.get(..=body_end).unwrap_or(bytes);
        let Some(patterns) = search::patterns(there, self.next.max(PREFIX), body_end) else {
            return true;
        };
        // The last three bytes may begin a pattern of which the rest is to come.
        self.next = there.len().saturating_sub(3);
        self.patterns += patterns;
        false
    }
}

/// A status packet has an error byte; a fast one has an ID beside it and a CRC a device.
const fn min_status_length(fast: bool) -> u16 {
    MIN_LENGTH + if fast { 2 } else { 1 }
}
