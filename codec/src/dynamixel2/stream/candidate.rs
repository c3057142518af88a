//! Decides whether a packet begins at a header.

use super::Reason;
use crate::dynamixel2::FrameError;
use crate::dynamixel2::header::{CRC, Header, PREFIX};
use crate::simd;

/// What is known about the bytes from a header on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// More bytes are needed to decide.
    Incomplete,
    /// Not a packet, whatever follows.
    False(Reason),
    /// All bytes have arrived, and all rules hold except that of the CRC, which is not checked yet.
    Whole(Whole),
}

impl Verdict {
    /// For a rule that the bytes after a whole header break.
    fn broken(error: FrameError) -> Self {
        Self::False(match error {
            FrameError::Id { .. } => Reason::Id,
            _ => Reason::Length,
        })
    }
}

/// A packet whose CRC is not checked yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Whole {
    /// Bytes of the packet.
    pub(super) len: usize,
    /// The number of patterns in its body, each with its stuffing byte.
    pub(super) patterns: usize,
    /// Whether it is a fast status packet, which is not stuffed.
    pub(super) fast: bool,
}

/// The progress of the search for patterns while the candidate is incomplete.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Progress {
    /// The offset at which it continues; 0 before it has begun.
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
        let Some(prefix) = bytes.first_chunk() else {
            return Header::check_start(bytes)
                .map_or_else(Verdict::broken, |()| Verdict::Incomplete);
        };
        let header = match Header::check(prefix) {
            Ok(header) => header,
            Err(error) => return Verdict::broken(error),
        };
        let len = header.packet_len();
        if len > max_packet {
            return Verdict::False(Reason::Oversize);
        }
        let Some(&instruction) = bytes.get(PREFIX) else {
            return Verdict::Incomplete;
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
            return Verdict::Incomplete;
        }
        Verdict::Whole(Whole { len, patterns: self.patterns, fast })
    }

    /// Whether the body has a pattern without its stuffing. The next packet's header is such a
    /// pattern, so a false header is detected when the next packet begins.
    #[inline]
    fn find_bare_pattern(&mut self, bytes: &[u8], len: usize) -> bool {
        let body_end = len - CRC;
        let there = bytes.get(..=body_end).unwrap_or(bytes);
        let Some(patterns) = simd::patterns(there, self.next.max(PREFIX), body_end) else {
            return true;
        };
        // The last three bytes may be the beginning of a pattern.
        self.next = there.len().saturating_sub(3);
        self.patterns += patterns;
        false
    }
}
