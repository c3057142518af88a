//! Short packets, which are most of the traffic on a bus: one window decides about CRC and stuffing.
//!
//! Where the lengths of packets vary, a processor can't predict where a loop over their bytes ends.
//! So a short packet is looked at as the end of a window of a fixed size.

use super::candidate::Whole;
use crate::dynamixel2::STUFFING_PATTERN;
use crate::dynamixel2::header::{CRC, Header, PREFIX};
use crate::simd::{Backend, HAS_WORDS, Places, Task, WINDOW, meter, run};

/// The number of packets that are examined at once.
const AHEAD: usize = 16;

/// Packets found in advance, one directly after the other. Looking for several in one loop lets the
/// processor work on more than one at a time.
#[derive(Clone, Debug)]
pub(super) struct Ready {
    packets: [Short; AHEAD],
    next: usize,
    count: usize,
}

/// A short, valid packet, of at most [`WINDOW`] bytes.
#[derive(Clone, Copy, Debug, Default)]
struct Short {
    len: u8,
    patterns: u8,
}

const _: () = assert!(WINDOW <= u8::MAX as usize);

impl Ready {
    pub(super) const fn new() -> Self {
        Self { packets: [Short { len: 0, patterns: 0 }; AHEAD], next: 0, count: 0 }
    }

    /// The next of the packets found.
    #[inline]
    pub(super) fn pop(&mut self) -> Option<Whole> {
        if self.next >= self.count {
            return None;
        }
        let Short { len, patterns } = *self.packets.get(self.next)?;
        self.next += 1;
        Some(Whole { len: len.into(), patterns: patterns.into(), fast: false })
    }

    /// Looks for packets from `start` of the buffer on. No earlier packets may be left. Returns whether there
    /// are some.
    #[inline(never)]
    pub(super) fn find(&mut self, buffer: &[u8], start: usize, max_packet: usize) -> bool {
        self.next = 0;
        if HAS_WORDS {
            self.count = run(Find { packets: &mut self.packets, buffer, start, max_packet });
        } // else the whole packet is looked at, as a long one
        self.count > 0
    }
}

/// The task that finds short packets in `buffer` from `start` on. Returns their number.
struct Find<'a> {
    packets: &'a mut [Short],
    buffer: &'a [u8],
    start: usize,
    max_packet: usize,
}

impl Task for Find<'_> {
    type Output = usize;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> usize {
        let mut start = self.start;
        let mut count = 0;
        for slot in self.packets {
            let Some(packet) = packet(backend, self.buffer, start, self.max_packet) else {
                break;
            };
            start += usize::from(packet.len);
            *slot = packet;
            count += 1;
        }
        count
    }
}

/// The short packet that begins at `start`, if all its bytes have arrived.
#[inline(always)]
#[expect(clippy::inline_always, reason = "part of a `Task`")]
fn packet(backend: impl Backend, buffer: &[u8], start: usize, max_packet: usize) -> Option<Short> {
    let len = len(buffer.get(start..)?, max_packet)?;
    let window = buffer.get(..start + len)?.last_chunk()?;
    meter::add(WINDOW);
    if !backend.ends_in_crc(window, len) {
        return None;
    }
    // Most packets have no pattern, nor its first bytes.
    let patterns = match backend.pairs(window) & in_body(len) {
        0 => 0,
        _ => patterns(backend.places(window), len)?,
    };
    Some(Short { len: u8::try_from(len).ok()?, patterns })
}

/// The places at which a pattern in the body of a packet begins. The packet is the last `len` bytes
/// of a window.
#[inline]
fn in_body(len: usize) -> u64 {
    // Its last byte is in the body too.
    u64::MAX >> (CRC + STUFFING_PATTERN.len() - 1) & u64::MAX << (WINDOW - len + PREFIX)
}

/// The length of a packet that begins with these bytes, if it is short and breaks no rule before
/// its body.
#[inline]
fn len(bytes: &[u8], max_packet: usize) -> Option<usize> {
    let &[ref prefix @ .., instruction] = bytes.first_chunk::<{ PREFIX + 1 }>()?;
    let len = Header::plain(prefix, instruction)?.packet_len();
    (len <= max_packet.min(WINDOW)).then_some(len)
}

/// The number of patterns in the body of such a packet; `None` if one of them lacks its stuffing
/// byte.
#[inline]
#[expect(clippy::cast_possible_truncation, reason = "no more than a window has places")]
fn patterns(places: Places, len: usize) -> Option<u8> {
    let patterns = places.patterns & in_body(len);
    // And so must be its stuffing.
    let stuffed = (places.stuffing & u64::MAX >> CRC) >> STUFFING_PATTERN.len();
    (patterns & !stuffed == 0).then_some(patterns.count_ones() as u8)
}
