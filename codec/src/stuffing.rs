//! Byte stuffing: what keeps a header from appearing in a body (DYNAMIXEL Protocol 2.0, Packet
//! 처리).
//!
//! A *body* is the bytes from the instruction up to the CRC. A sender puts FD behind every
//! FF FF FD in it, a receiver takes it away.

mod insert;
mod remove;
#[cfg(test)]
mod tests;

use core::fmt;

use crate::BufferTooSmall;
use crate::dynamixel2::{STUFFING_BYTE, STUFFING_PATTERN};

pub(crate) use insert::insert;
pub(crate) use remove::remove;

/// Looks for the pattern byte by byte, across slices.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Matcher {
    /// How many bytes of the pattern the last bytes seen are.
    matched: usize,
}

impl Matcher {
    /// Takes the next byte; tells whether it ends the pattern.
    pub(crate) fn step(&mut self, byte: u8) -> bool {
        let [first, second, last] = STUFFING_PATTERN;
        self.matched = match self.matched {
            2 if byte == last => 3,
            // A third FF leaves the last two as the beginning of a pattern.
            1 | 2 if byte == second => planted!("stuffing.third-ff", 2 * (2 - self.matched), 2),
            _ if byte == first => 1,
            _ => 0,
        };
        if self.matched == STUFFING_PATTERN.len() {
            self.matched = 0;
            return true;
        }
        false
    }
}

/// Why a stuffed body can't be unstuffed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnstuffError {
    /// The pattern stands there without the byte that belongs behind it.
    Bare {
        /// The offset in the body at which that byte is missing.
        at: usize,
    },
    /// The buffer is too small.
    Buffer(BufferTooSmall),
}

impl fmt::Display for UnstuffError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bare { at } => {
                write!(f, "FF FF FD ends before byte {at} of the body, which is not FD")
            }
            Self::Buffer(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for UnstuffError {}

/// How many bytes `body` has when it is stuffed: at most a third more.
#[must_use]
pub fn stuffed_len(body: &[u8]) -> usize {
    let mut matcher = Matcher::default();
    body.len() + body.iter().filter(|byte| matcher.step(**byte)).count()
}

/// Writes `body` to `buffer` with FD behind every FF FF FD; returns what was written.
///
/// ```
/// use actucheck_codec::stuffing::stuff;
/// let mut buffer = [0; 8];
/// let stuffed = stuff(b"\x03\xFF\xFF\xFD", &mut buffer)?;
/// assert_eq!(stuffed, b"\x03\xFF\xFF\xFD\xFD");
/// # Ok::<(), actucheck_codec::BufferTooSmall>(())
/// ```
///
/// # Errors
/// If `buffer` is smaller than [`stuffed_len`].
pub fn stuff<'b>(body: &[u8], buffer: &'b mut [u8]) -> Result<&'b [u8], BufferTooSmall> {
    let too_small = BufferTooSmall { needed: stuffed_len(body), available: buffer.len() };
    let target = buffer.get_mut(..too_small.needed).ok_or(too_small)?;
    let mut matcher = Matcher::default();
    let stuffed = body.iter().flat_map(|byte| {
        let extra = matcher.step(*byte).then_some(STUFFING_BYTE);
        core::iter::once(*byte).chain(extra)
    });
    for (slot, byte) in target.iter_mut().zip(stuffed) {
        *slot = byte;
    }
    Ok(target)
}

/// Writes a stuffed body to `buffer` as it was before stuffing; returns what was written.
///
/// ```
/// use actucheck_codec::stuffing::unstuff;
/// let mut buffer = [0; 8];
/// let body = unstuff(b"\x03\xFF\xFF\xFD\xFD", &mut buffer)?;
/// assert_eq!(body, b"\x03\xFF\xFF\xFD");
/// # Ok::<(), actucheck_codec::stuffing::UnstuffError>(())
/// ```
///
/// # Errors
/// If FF FF FD stands in `stuffed` without FD behind it, or `buffer` is too small; a buffer of
/// the size of `stuffed` is always enough.
pub fn unstuff<'b>(stuffed: &[u8], buffer: &'b mut [u8]) -> Result<&'b [u8], UnstuffError> {
    let available = buffer.len();
    let mut needed = 0;
    let mut slots = buffer.iter_mut();
    for byte in Unstuffed::new(stuffed) {
        let byte = byte.map_err(|at| UnstuffError::Bare { at })?;
        needed += 1;
        if let Some(slot) = slots.next() {
            *slot = byte;
        }
    }
    let too_small = UnstuffError::Buffer(BufferTooSmall { needed, available });
    buffer.get(..needed).ok_or(too_small)
}

/// The bytes of a stuffed body without its stuffing; `Err` with the offset of the byte that is
/// not FD where a pattern is bare, and nothing after it.
#[derive(Clone, Debug)]
pub(crate) struct Unstuffed<'a> {
    stuffed: &'a [u8],
    next: usize,
    matcher: Matcher,
    /// The last byte taken ended a pattern.
    after_pattern: bool,
}

impl<'a> Unstuffed<'a> {
    pub(crate) fn new(stuffed: &'a [u8]) -> Self {
        Self { stuffed, next: 0, matcher: Matcher::default(), after_pattern: false }
    }
}

impl Iterator for Unstuffed<'_> {
    type Item = Result<u8, usize>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.after_pattern {
            self.after_pattern = false;
            let next = self.stuffed.get(self.next);
            let bare = next != Some(&STUFFING_BYTE);
            if planted!("stuffing.bare-at-the-end", bare && next.is_some(), bare) {
                let at = self.next;
                self.next = self.stuffed.len();
                return Some(Err(at));
            }
            self.next += 1;
        }
        let byte = *self.stuffed.get(self.next)?;
        self.next += 1;
        self.after_pattern = self.matcher.step(byte);
        Some(Ok(byte))
    }
}
