//! The parser: its buffer, and how it works through it.

use super::candidate::{Progress, Verdict, Whole};
use super::checkpoints::Checkpoints;
use super::input::Input;
use super::short::Ready;
use super::{BLOCK, Event, RawFastStatus, Reason};
use crate::crc;
use crate::dynamixel2::header::CRC;
use crate::dynamixel2::{Frame, HEADER};
use crate::simd::{self, WINDOW, meter};

/// The longest packet, in bytes, that [`Parser::new`] accepts. The length field would allow 65,542.
pub const DEFAULT_MAX_PACKET: usize = BLOCKS * BLOCK;
const BLOCKS: usize = 16;

/// Finds the packets in a stream; the [module](super) explains how.
///
/// A parser accepts packets of up to 64 times `BLOCKS` bytes, and its size is a little more than
/// twice that. 1025 blocks are enough for every packet; put such a parser into a `static` or a
/// `Box`, not on the stack. A parser of no blocks does not compile:
///
/// ```compile_fail,E0080
/// use actucheck_codec::dynamixel2::stream::Parser;
/// let none = Parser::<0>::default();
/// ```
#[derive(Clone, Debug)]
pub struct Parser<const BLOCKS: usize = 16> {
    /// Twice the longest packet, so that the bytes of an incomplete packet are moved to the front
    /// only when at least as many bytes have been processed.
    buffer: [[[u8; BLOCK]; BLOCKS]; 2],
    /// The bytes from `start` to `end` belong to no run and no packet yet.
    start: usize,
    end: usize,
    max_packet: usize,
    /// The run of skipped bytes just before `start`, not reported yet; 0 if there is none.
    skipped: u64,
    reason: Reason,
    /// The progress of the examination of the bytes at `start`.
    ready: Ready,
    /// Of the header at `start`, if there is one.
    progress: Progress,
    /// No bytes will follow the available ones.
    quiet: bool,
    checkpoints: Checkpoints<BLOCKS>,
}

/// The result at the old `start`, which has moved past it.
#[derive(Clone, Copy)]
enum Found {
    Packet(Whole),
    Run { bytes: u64, reason: Reason },
}

impl Parser {
    /// A parser for packets of up to [`DEFAULT_MAX_PACKET`] bytes.
    #[must_use]
    pub const fn new() -> Self {
        Self::with_max_packet(DEFAULT_MAX_PACKET)
    }
}

impl<const BLOCKS: usize> Default for Parser<BLOCKS> {
    fn default() -> Self {
        Self::with_max_packet(usize::MAX)
    }
}

impl<const BLOCKS: usize> Parser<BLOCKS> {
    /// A parser for packets of up to `max_packet` bytes, or of 64 times `BLOCKS` bytes if that is
    /// less. Longer packets count as false.
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::stream::Parser;
    /// // Status packets of a few registers; 256 bytes of buffer.
    /// let small = Parser::<2>::with_max_packet(100);
    /// # let _ = small;
    /// ```
    #[must_use]
    pub const fn with_max_packet(max_packet: usize) -> Self {
        const { assert!(BLOCKS > 0, "a parser of no blocks takes no byte") };
        let room = BLOCK * BLOCKS;
        Self {
            buffer: [[[0; BLOCK]; BLOCKS]; 2],
            start: 0,
            end: 0,
            max_packet: if max_packet < room { max_packet } else { room },
            skipped: 0,
            reason: Reason::Garbage,
            ready: Ready::new(),
            progress: Progress::new(),
            quiet: false,
            checkpoints: Checkpoints::new(),
        }
    }

    /// Takes all of `bytes`, and hands on each event that they complete. To go on after
    /// [`Parser::idle`] without waiting for bytes, feed none.
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::stream::{Event, Parser};
    /// let received: [&[u8]; 2] = [b"\xFF\xFF\xFD\x00\x01\x04\x00\x55", b"\x00\xA1\x0C"];
    /// let mut parser = Parser::new();
    /// let mut ids = Vec::new();
    /// for bytes in received {
    ///     parser.feed(bytes, |event| {
    ///         if let Event::Frame(frame) = event {
    ///             ids.push(frame.id());
    ///         }
    ///     });
    /// }
    /// assert_eq!(ids, [1]);
    /// ```
    pub fn feed(&mut self, bytes: &[u8], mut take: impl FnMut(Event<'_>)) {
        let mut input = Input::new(bytes);
        while let Some(event) = self.next_of(&mut input) {
            take(event);
        }
    }

    /// The next event with these bytes after those in the buffer; `None` if all of them are taken.
    #[inline]
    fn next_of<'e, 'b: 'e>(&'e mut self, input: &mut Input<'b>) -> Option<Event<'e>> {
        loop {
            if let Some(packet) = input.pop() {
                return input.take(packet);
            }
            if input.is_drained && self.refill(input) {
                continue;
            }
            if let Some(packet) = self.next_short_packet() {
                return self.take(packet);
            }
            match self.search() {
                Some(found) => return self.event(found),
                None if input.rest().is_empty() => return None,
                None => input.is_drained = true,
            }
        }
    }

    /// Looks for packets in the input, or else takes some of it. Returns whether there were packets.
    #[inline(never)]
    fn refill(&mut self, input: &mut Input<'_>) -> bool {
        self.give_back(input);
        if self.pending() == 0 && input.find(self.max_packet) {
            return true;
        }
        let rest = self.push(input.rest()).len();
        input.take_all_but(rest);
        input.is_drained = false;
        false
    }

    /// Gives the bytes of an incomplete packet back if they are few: then it may be found where it is.
    fn give_back(&mut self, input: &mut Input<'_>) {
        let held = self.end - self.start;
        if held < WINDOW && input.give_back(held) {
            self.end = self.start;
            self.progress = Progress::new();
        }
    }

    /// Takes as many of `bytes` as fit into the buffer. Returns the rest. [`Parser::feed`] takes
    /// them all; this is for who wants to stop between two events.
    ///
    /// At least one byte is taken if [`Parser::next_event`] returned `None` last.
    #[must_use = "bytes that were not taken are to be pushed again after the events"]
    pub fn push<'b>(&mut self, bytes: &'b [u8]) -> &'b [u8] {
        if self.quiet {
            // No packet continues after a quiet time, so the events before it come first.
            return bytes;
        }
        self.make_room(bytes.len());
        let buffer = self.buffer.as_flattened_mut().as_flattened_mut();
        let room = buffer.get_mut(self.end..).unwrap_or_default();
        let (taken, rest) = bytes.split_at(bytes.len().min(room.len()));
        if let Some(slots) = room.get_mut(..taken.len()) {
            slots.copy_from_slice(taken);
        }
        self.end += taken.len();
        rest
    }

    /// The bus was quiet: an incomplete packet stays incomplete. Call [`Parser::next_event`] until
    /// it returns `None`, then push the bytes after the quiet time.
    ///
    /// The caller, who has a clock, decides how long a quiet time is.
    pub fn idle(&mut self) {
        self.quiet = self.pending() > 0;
    }

    /// The next packet or run of skipped bytes; `None` if more bytes are needed.
    #[inline]
    pub fn next_event(&mut self) -> Option<Event<'_>> {
        if let Some(packet) = self.next_short_packet() {
            return self.take(packet);
        }
        let found = self.search()?;
        self.event(found)
    }

    #[inline]
    fn event(&mut self, found: Found) -> Option<Event<'_>> {
        match found {
            Found::Packet(packet) => self.take(packet),
            Found::Run { bytes, reason } => Some(Event::Skipped { bytes, reason }),
        }
    }

    /// The packet at `start`. Moves `start` past it.
    #[inline]
    fn take(&mut self, Whole { len, patterns, fast }: Whole) -> Option<Event<'_>> {
        let start = self.start;
        self.start += len;
        self.progress = Progress::new();
        let bytes = self.buffer().get(start..)?;
        Some(if fast {
            Event::FastStatus(RawFastStatus::new(bytes.get(..len)?))
        } else {
            Event::Frame(Frame::checked(bytes, len, patterns)?)
        })
    }

    /// The number of pushed bytes that belong to no event yet.
    #[must_use]
    pub const fn pending(&self) -> u64 {
        self.skipped + (self.end - self.start) as u64
    }

    /// The usual case: a short packet directly after another one.
    #[inline]
    fn next_short_packet(&mut self) -> Option<Whole> {
        if let Some(packet) = self.ready.pop() {
            return Some(packet);
        }
        if self.skipped > 0 {
            return None;
        }
        let buffer = self.buffer.as_flattened().as_flattened().get(..self.end)?;
        self.ready.find(buffer, self.start, self.max_packet);
        self.ready.pop()
    }

    /// All cases.
    #[inline(never)]
    fn search(&mut self) -> Option<Found> {
        loop {
            self.skip(simd::header(self.ahead()));
            let ahead = self.ahead().len();
            if ahead < HEADER.len() {
                if !self.quiet {
                    return None;
                }
                // An incomplete header is not a header.
                self.skip(ahead);
                self.quiet = false;
                return self.end_run();
            }
            let found = self.end_run().or_else(|| self.packet().map(Found::Packet));
            if found.is_some() || self.skipped == 0 {
                return found;
            }
        }
    }

    /// The packet that begins with the header at `start`. If there is none, either the header is
    /// false and a run begins, or more bytes are needed.
    #[inline]
    fn packet(&mut self) -> Option<Whole> {
        let mut progress = self.progress;
        let verdict = progress.judge(self.ahead(), self.max_packet);
        match verdict {
            Verdict::Whole(whole) if self.crc_matches(whole) => return Some(whole),
            Verdict::Whole(_) => self.begin_run(Reason::Crc),
            Verdict::False(reason) => self.begin_run(reason),
            Verdict::Incomplete if self.quiet => self.begin_run(Reason::Truncated),
            Verdict::Incomplete => self.progress = progress,
        }
        None
    }

    #[inline]
    fn crc_matches(&mut self, whole: Whole) -> bool {
        let end = self.start + whole.len - CRC;
        let buffer = self.buffer.as_flattened().as_flattened();
        let found = buffer.get(end..).and_then(<[u8]>::first_chunk);
        // Other packets overlap by a few bytes at most, so reading each whole keeps the cost linear.
        let computed = if whole.fast && whole.len > 2 * BLOCK {
            self.checkpoints.range(buffer, self.start, end)
        } else {
            let bytes = buffer.get(self.start..end).unwrap_or_default();
            meter::add(bytes.len());
            crc::umts(bytes)
        };
        found.is_some_and(|found| computed == u16::from_le_bytes(*found))
    }

    /// The header at `start` is false.
    fn begin_run(&mut self, reason: Reason) {
        self.reason = reason;
        self.skip(1);
    }

    /// The number of bytes before the next header or beginning of one.
    fn skip(&mut self, bytes: usize) {
        if bytes > 0 {
            self.start += bytes;
            self.skipped += bytes as u64;
            self.progress = Progress::new();
        }
    }

    /// The run that ends at `start`, if there is one.
    fn end_run(&mut self) -> Option<Found> {
        let (bytes, reason) = (self.skipped, self.reason);
        (self.skipped, self.reason) = (0, Reason::Garbage);
        (bytes > 0).then_some(Found::Run { bytes, reason })
    }

    fn buffer(&self) -> &[u8] {
        self.buffer.as_flattened().as_flattened()
    }

    fn ahead(&self) -> &[u8] {
        self.buffer().get(self.start..self.end).unwrap_or_default()
    }

    /// Moves the bytes to the front if `wanted` more do not fit after them, unless more bytes would
    /// be moved than have been processed.
    fn make_room(&mut self, wanted: usize) {
        let size = 2 * BLOCKS * BLOCK;
        if self.start == self.end {
            // Not at the very front: `short` reads a whole window that ends with the packet.
            (self.start, self.end) = (BLOCK, BLOCK);
            self.checkpoints.clear();
        } else if size - self.end < wanted && self.start >= size / 2 {
            // By whole blocks, as the checkpoints are one a block. One more stays, as above.
            let blocks = self.start / BLOCK - usize::from(BLOCKS > 1);
            let gone = blocks * BLOCK;
            let buffer = self.buffer.as_flattened_mut().as_flattened_mut();
            meter::add(self.end - gone);
            buffer.copy_within(gone..self.end, 0);
            (self.start, self.end) = (self.start - gone, self.end - gone);
            self.checkpoints.shift(blocks);
        }
    }
}
