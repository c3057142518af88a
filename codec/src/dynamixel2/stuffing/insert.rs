//! Stuffs a body in place.

use super::compact;
use crate::dynamixel2::{STUFFING_BYTE, STUFFING_PATTERN};
use crate::simd::{Backend, HAS_WORDS, Task, WINDOW, run};

/// The number of places that a window decides: those whose whole pattern is in it.
const PLACES: usize = WINDOW - (STUFFING_PATTERN.len() - 1);

/// Inserts FD after every pattern in the bytes of `buffer` from `start` up to `end`. Returns the
/// new end, or `None` if they do not fit. The bytes after them in `buffer` are overwritten.
#[inline]
pub(crate) fn insert(buffer: &mut [u8], start: usize, end: usize) -> Option<usize> {
    if !HAS_WORDS {
        return compact::insert(buffer, start, end);
    }
    run(Insert { buffer, start, end })
}

/// The number of bytes that stuffing adds to a body.
pub(super) fn missing(body: &[u8]) -> usize {
    if !HAS_WORDS {
        return compact::missing(body);
    }
    run(Missing { body })
}

struct Missing<'a> {
    body: &'a [u8],
}

impl Task for Missing<'_> {
    type Output = usize;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> usize {
        let windows = (0..self.body.len()).step_by(PLACES);
        let patterns = windows.map(|at| patterns(backend, self.body, at, self.body.len()));
        patterns.map(|patterns| patterns.count_ones() as usize).sum()
    }
}

struct Insert<'a> {
    buffer: &'a mut [u8],
    start: usize,
    end: usize,
}

impl Task for Insert<'_> {
    type Output = Option<usize>;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> Option<usize> {
        let Self { buffer, start, end } = self;
        let (mut missing, mut at) = (0, start);
        while at < end {
            missing += patterns(backend, buffer, at, end).count_ones() as usize;
            at += PLACES;
        }
        let stuffed_end = end + missing;
        if stuffed_end > buffer.len() {
            return None;
        }
        // From the back, so that every byte moves only once, and the bytes before are still
        // unchanged.
        let mut end = end;
        while missing > 0 {
            at = at.checked_sub(PLACES)?;
            let mut patterns = patterns(backend, buffer, at, end);
            while let Some(last) = patterns.checked_ilog2() {
                let behind = at + last as usize + STUFFING_PATTERN.len();
                buffer.copy_within(behind..end, behind + missing);
                missing -= 1;
                *buffer.get_mut(behind + missing)? = STUFFING_BYTE;
                end = behind;
                patterns ^= 1 << last;
            }
        }
        Some(stuffed_end)
    }
}

/// The patterns that begin in the window at `at`, and end at `end` at the latest.
#[inline(always)]
#[expect(clippy::inline_always, reason = "part of a `Task`")]
fn patterns(backend: impl Backend, bytes: &[u8], at: usize, end: usize) -> u64 {
    let bytes = bytes.get(at..).unwrap_or_default();
    let patterns = if let Some(window) = bytes.first_chunk() {
        backend.places(window).patterns
    } else {
        let mut window = [0; WINDOW];
        window.iter_mut().zip(bytes).for_each(|(slot, byte)| *slot = *byte);
        backend.places(&window).patterns
    };
    let places = (end + 1).saturating_sub(at + STUFFING_PATTERN.len());
    if places < PLACES { patterns & ((1 << places) - 1) } else { patterns }
}
