//! Whether a packet begins where a header stands.

use super::Reason;
use crate::dynamixel2::FrameError;
use crate::dynamixel2::header::{CRC, Header, PREFIX};
use crate::simd;

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
    /// bytes that can break them. So the first broken rule does not depend on how many bytes have
    /// come.
    #[inline]
    pub(super) fn judge(&mut self, bytes: &[u8], max_packet: usize) -> Verdict {
        let header = match Header::check(bytes) {
            Ok(Some(header)) => header,
            Ok(None) => return Verdict::Open,
            Err(FrameError::Id { .. }) => return Verdict::False(Reason::Id),
            Err(_) => return Verdict::False(Reason::Length),
        };
        let len = header.packet_len();
        if len > max_packet {
            return Verdict::False(Reason::Oversize);
        }
        let Some(&instruction) = bytes.get(PREFIX) else {
            return Verdict::Open;
        };
        let fast = header.is_fast(instruction);
        let room = if fast { header.check_fast() } else { header.check_instruction(instruction) };
        if room.is_err() {
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

    /// Whether a pattern stands in the body without its stuffing. The next packet's header is such
    /// a pattern, so a false header is found out when the next packet begins.
    #[inline]
    fn find_bare_pattern(&mut self, bytes: &[u8], len: usize) -> bool {
        let body_end = len - CRC;
        let there = bytes.get(..=body_end).unwrap_or(bytes);
        let Some(patterns) = simd::patterns(there, self.next.max(PREFIX), body_end) else {
            return true;
        };
        // The last three bytes may begin a pattern of which the rest is to come.
        self.next = there.len().saturating_sub(3);
        self.patterns += patterns;
        false
    }
}
