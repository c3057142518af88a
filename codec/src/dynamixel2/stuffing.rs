//! Byte stuffing, which keeps headers from appearing in a body (DYNAMIXEL Protocol 2.0, Packet 처리,
//! "packet handling").
//!
//! A *body* is the bytes from the instruction up to the CRC. A sender inserts FD after every FF FF
//! FD in it; a receiver removes it.

pub(crate) mod compact;
mod insert;
mod remove;
#[cfg(test)]
mod tests;

use core::fmt;

use super::STUFFING_PATTERN;
use crate::BufferTooSmall;

pub(crate) use insert::insert;
pub(crate) use remove::remove;

/// Looks for the pattern byte by byte, across slices.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Matcher {
    /// How many bytes of the pattern the last bytes match.
    matched: usize,
}

impl Matcher {
    /// Takes the next byte. Returns whether it ends the pattern.
    pub(crate) fn step(&mut self, byte: u8) -> bool {
        let [first, second, last] = STUFFING_PATTERN;
        self.matched = match self.matched {
            2 if byte == last => 3,
            // After a third FF, the last two FF may begin a pattern.
            1 | 2 if byte == second => 2,
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
    /// The body has the pattern without the stuffing byte after it.
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

/// The size of `body` with stuffing: at most a third larger.
#[must_use]
pub fn stuffed_len(body: &[u8]) -> usize {
    body.len() + insert::missing(body)
}

/// Writes `body` to `buffer` with FD after every FF FF FD. Returns the written bytes. The bytes
/// after it in `buffer` are overwritten.
///
/// ```
/// use actucheck_codec::dynamixel2::stuffing::stuff;
/// let mut buffer = [0; 8];
/// let stuffed = stuff(b"\x03\xFF\xFF\xFD", &mut buffer)?;
/// assert_eq!(stuffed, b"\x03\xFF\xFF\xFD\xFD");
/// # Ok::<(), actucheck_codec::BufferTooSmall>(())
/// ```
///
/// # Errors
/// If `buffer` is smaller than [`stuffed_len`].
pub fn stuff<'b>(body: &[u8], buffer: &'b mut [u8]) -> Result<&'b [u8], BufferTooSmall> {
    let available = buffer.len();
    let too_small = || BufferTooSmall { needed: stuffed_len(body), available };
    buffer.get_mut(..body.len()).ok_or_else(too_small)?.copy_from_slice(body);
    let end = insert(buffer, 0, body.len()).ok_or_else(too_small)?;
    buffer.get(..end).ok_or_else(too_small)
}

/// Writes a stuffed body to `buffer` without its stuffing. Returns the written bytes. The bytes
/// after it in `buffer` are overwritten.
///
/// ```
/// use actucheck_codec::dynamixel2::stuffing::unstuff;
/// let mut buffer = [0; 8];
/// let body = unstuff(b"\x03\xFF\xFF\xFD\xFD", &mut buffer)?;
/// assert_eq!(body, b"\x03\xFF\xFF\xFD");
/// # Ok::<(), actucheck_codec::dynamixel2::stuffing::UnstuffError>(())
/// ```
///
/// # Errors
/// If `stuffed` has FF FF FD without FD after it, or `buffer` is too small; a buffer of the size of
/// `stuffed` is always enough.
pub fn unstuff<'b>(stuffed: &[u8], buffer: &'b mut [u8]) -> Result<&'b [u8], UnstuffError> {
    let needed = remove::checked(stuffed, buffer).map_err(|at| UnstuffError::Bare { at })?;
    let too_small = BufferTooSmall { needed, available: buffer.len() };
    buffer.get(..needed).ok_or(UnstuffError::Buffer(too_small))
}

/// The offset at which FD is missing after the first bare pattern.
pub(crate) fn bare(stuffed: &[u8]) -> Option<usize> {
    remove::checked(stuffed, &mut []).err()
}
