//! Looks for headers and for the pattern of byte stuffing: in windows of 64 bytes while there are as
//! many, then at eight places at a time.
//!
//! Eight neighbouring places are one `u64`, the first in its lowest byte; the words that begin one,
//! two and three bytes later have the following bytes of each place. A byte of the combined word is
//! zero where all bytes match.

use super::words::{everywhere, zero_bytes};
use super::{Backend, HAS_WORDS, Task, WINDOW as LARGE, meter, run};
use crate::dynamixel2::stuffing::compact;
use crate::dynamixel2::{HEADER, STUFFING_BYTE, STUFFING_PATTERN};

/// The number of places that are examined together.
const PLACES: usize = 8;
/// The bytes that decide these places: up to the last place's pattern and one byte after it.
const WINDOW: usize = PLACES + 3;

/// The eight bytes of a window from `AT` on.
#[inline]
fn word<const AT: usize, const N: usize>(window: &[u8; N]) -> u64 {
    let (_, bytes) = window.split_at(AT);
    bytes.first_chunk().copied().map_or(0, u64::from_le_bytes)
}

/// Zero in the places where FF FF FD begins.
#[inline]
fn mismatches<const N: usize>(window: &[u8; N]) -> u64 {
    let [first, second, third] = STUFFING_PATTERN;
    (word::<0, _>(window) ^ everywhere(first))
        | (word::<1, _>(window) ^ everywhere(second))
        | (word::<2, _>(window) ^ everywhere(third))
}

/// Whether `bytes` begin with a header, as far as they go.
#[inline]
fn may_be_header(bytes: &[u8]) -> bool {
    bytes.iter().zip(HEADER).all(|(byte, header)| *byte == header)
}

/// The offset of the first header, which may be cut off by the end; the length of `bytes` if there
/// is none.
pub(crate) fn header(bytes: &[u8]) -> usize {
    let [_, _, _, fourth] = HEADER;
    let is_header = |at: &usize| bytes.get(*at..).is_some_and(may_be_header);
    if !HAS_WORDS {
        let found = (0..bytes.len()).find(is_header).unwrap_or(bytes.len());
        meter::add(bytes.len().min(found + HEADER.len()));
        return found;
    }
    let mut at = match run(FindHeader { bytes }) {
        Ok(at) => {
            meter::add(at + HEADER.len());
            return at;
        }
        Err(at) => at,
    };
    while let Some(window) = bytes.get(at..).and_then(<[u8]>::first_chunk::<WINDOW>) {
        let found = zero_bytes(mismatches(window) | (word::<3, _>(window) ^ everywhere(fourth)));
        if found != 0 {
            at += found.trailing_zeros() as usize / 8;
            meter::add(at + WINDOW);
            return at;
        }
        at += PLACES;
    }
    meter::add(bytes.len());
    (at..bytes.len()).find(is_header).unwrap_or(bytes.len())
}

/// Counts the patterns that begin at `from` or later; `from` is not before the body. `None` if one
/// of them lacks its stuffing byte; the bytes after that one are not examined.
///
/// `bytes` are those of a packet from its header on, at most up to its first CRC byte; the body
/// ends at `body_end`. A pattern counts as soon as the byte after it is available.
#[inline]
pub(crate) fn patterns(bytes: &[u8], from: usize, body_end: usize) -> Option<usize> {
    if !HAS_WORDS {
        return compact::patterns(bytes, from, body_end);
    }
    let large = bytes.len() >= from + LARGE;
    let (mut count, mut at) =
        if large { run(CountPatterns { bytes, from, body_end })? } else { (0, from) };
    while let Some(window) = bytes.get(at..).and_then(<[u8]>::first_chunk::<WINDOW>) {
        count += patterns_in(window, 0, at + WINDOW > body_end)?;
        at += PLACES;
    }
    // Fewer places are left than a window has. The last window has them; header, ID and length are
    // enough bytes before the body for it.
    if at + WINDOW < bytes.len() + PLACES
        && let Some(window) = bytes.last_chunk()
    {
        let looked_at = at + WINDOW - bytes.len();
        count += patterns_in(window, looked_at, bytes.len() > body_end)?;
    }
    Some(count)
}

/// Counts the patterns in a window, without the first `looked_at` places. At the end of the body
/// the last byte of the window belongs to the CRC, whatever its value.
#[inline]
fn patterns_in(window: &[u8; WINDOW], looked_at: usize, ends_body: bool) -> Option<usize> {
    meter::add(WINDOW);
    let mismatches = mismatches(window) | ((1 << (8 * looked_at)) - 1);
    let patterns = zero_bytes(mismatches);
    let mut stuffed = zero_bytes(word::<3, _>(window) ^ everywhere(STUFFING_BYTE));
    if ends_body {
        stuffed &= !(0xFF << (8 * (PLACES - 1)));
    }
    (patterns & !stuffed == 0).then_some(patterns.count_ones() as usize)
}

/// The number of places that a large window decides.
const LARGE_PLACES: usize = LARGE - 3;
const DECIDED: u64 = u64::MAX >> 3;

/// The task that finds the first header: its offset, or `Err` with the offset up to which there is
/// none.
struct FindHeader<'a> {
    bytes: &'a [u8],
}

impl Task for FindHeader<'_> {
    type Output = Result<usize, usize>;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> Result<usize, usize> {
        let mut at = 0;
        while let Some(window) = self.bytes.get(at..).and_then(<[u8]>::first_chunk) {
            let mut patterns = backend.places(window).patterns & DECIDED;
            while patterns != 0 {
                let found = at + patterns.trailing_zeros() as usize;
                if self.bytes.get(found..).is_some_and(may_be_header) {
                    return Ok(found);
                }
                patterns &= patterns - 1;
            }
            at += LARGE_PLACES;
        }
        Err(at)
    }
}

/// As [`patterns`], but only as far as large windows reach. Returns the count and the offset
/// reached.
struct CountPatterns<'a> {
    bytes: &'a [u8],
    from: usize,
    body_end: usize,
}

impl Task for CountPatterns<'_> {
    type Output = Option<(usize, usize)>;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> Option<(usize, usize)> {
        let (mut count, mut at) = (0, self.from);
        while let Some(window) = self.bytes.get(at..).and_then(<[u8]>::first_chunk) {
            let places = backend.places(window);
            let ends_body = at + LARGE > self.body_end;
            let stuffed = (places.stuffing & u64::MAX >> u32::from(ends_body)) >> 3;
            let patterns = places.patterns & DECIDED;
            let bare = patterns & !stuffed;
            meter::add(3 + LARGE_PLACES.min(bare.trailing_zeros() as usize));
            if bare != 0 {
                return None;
            }
            count += patterns.count_ones() as usize;
            at += LARGE_PLACES;
        }
        Some((count, at))
    }
}
