//! Takes stuffing away: fast from a body that is known to be right, and from any other.

use super::compact;
use crate::dynamixel2::STUFFING_PATTERN;
use crate::simd::{Backend, HAS_WORDS, Places, Processor, Task, WINDOW, run};

/// The number of places that a window decides: those whose whole pattern and one more byte are in
/// it.
const PLACES: usize = WINDOW - STUFFING_PATTERN.len();

/// Writes what follows the body's first byte to the first `len` bytes of `buffer`, which is how
/// long that is without stuffing. The body is the first `stuffed` of the `bytes`. More of either
/// makes it faster; the bytes after them in `buffer` are overwritten.
#[inline]
pub(crate) fn remove(bytes: &[u8], stuffed: usize, buffer: &mut [u8], len: usize) {
    if !HAS_WORDS {
        let body = bytes.get(..stuffed).unwrap_or_default();
        return remove_any(body, buffer.get_mut(..len).unwrap_or_default());
    }
    if let Some(whole) = buffer.first_chunk_mut()
        && run(Short { bytes, stuffed, whole }).is_some()
    {
        return;
    }
    remove_slowly(bytes, stuffed, buffer.get_mut(..len).unwrap_or_default());
}

/// The same for any body and for any buffer.
#[inline(never)]
fn remove_slowly(bytes: &[u8], stuffed: usize, target: &mut [u8]) {
    let mut whole = [0; 2 * WINDOW];
    if run(Short { bytes, stuffed, whole: &mut whole }).is_some() {
        copy_short(&whole, target);
    } else {
        remove_any(bytes.get(..stuffed).unwrap_or_default(), target);
    }
}

/// The task that does so by moving whole windows; `None` if the body is too long, has no pattern or
/// more than two, or ends too close to the end of `bytes`.
///
/// No branch depends on the places of the patterns, as no processor could predict it.
struct Short<'a> {
    bytes: &'a [u8],
    stuffed: usize,
    whole: &'a mut [u8; 2 * WINDOW],
}

impl Task for Short<'_> {
    type Output = Option<()>;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> Option<()> {
        let Self { bytes, stuffed, whole } = self;
        // The places of patterns with their stuffing in the body.
        let places = (1 << stuffed.checked_sub(3).filter(|last| *last < WINDOW)?) - 1;
        let patterns = backend.places(bytes.first_chunk()?).patterns & places;
        let others = patterns & patterns.wrapping_sub(1);
        if stuffed > WINDOW || patterns == 0 || others & others.wrapping_sub(1) != 0 {
            return None;
        }
        // Without a second pattern, the place after the body.
        let stuffing = |patterns: u64| (patterns.trailing_zeros() as usize + 3).min(stuffed);
        let first = stuffing(patterns);
        let second = stuffing(others);
        let after = |at: usize| bytes.get(at + 1..)?.first_chunk::<WINDOW>();
        *whole.first_chunk_mut()? = *after(0)?;
        *whole.get_mut(first - 1..)?.first_chunk_mut()? = *after(first)?;
        *whole.get_mut(second - 2..)?.first_chunk_mut()? = *after(second)?;
        Some(())
    }
}

/// Copies as many bytes as fit into `target`, at most a window.
#[inline]
fn copy_short(bytes: &[u8; 2 * WINDOW], target: &mut [u8]) {
    /// By two moves of `N` bytes that overlap.
    #[inline]
    fn copy<const N: usize>(bytes: &[u8], target: &mut [u8]) -> Option<()> {
        let from_last = target.len().checked_sub(N)?;
        *target.first_chunk_mut::<N>()? = *bytes.first_chunk()?;
        *target.last_chunk_mut::<N>()? = *bytes.get(from_last..)?.first_chunk()?;
        Some(())
    }
    if copy::<32>(bytes, target).or_else(|| copy::<16>(bytes, target)).is_none()
        && copy::<8>(bytes, target).is_none()
    {
        target.iter_mut().zip(bytes).for_each(|(slot, byte)| *slot = *byte);
    }
}

/// Whatever the length.
fn remove_any(body: &[u8], target: &mut [u8]) {
    // A pattern may begin with the byte that is left out.
    let (front, rest) = if body.starts_with(&STUFFING_PATTERN) {
        let behind = STUFFING_PATTERN.len() + 1;
        (body.get(1..STUFFING_PATTERN.len()), body.get(behind..))
    } else {
        (None, body.get(1..))
    };
    let (front, rest) = (front.unwrap_or_default(), rest.unwrap_or_default());
    if let Some((target, behind)) = target.split_at_mut_checked(front.len()) {
        target.copy_from_slice(front);
        // The body is valid, so there is no error.
        let _len = checked(rest, behind);
    }
}

/// Writes a stuffed body without its stuffing to `buffer`, as far as it fits. Returns the unstuffed
/// size. The bytes after them in `buffer` are overwritten.
///
/// # Errors
/// The offset at which FD is missing after the first bare pattern.
pub(super) fn checked(stuffed: &[u8], buffer: &mut [u8]) -> Result<usize, usize> {
    if !HAS_WORDS {
        return compact::checked(stuffed, buffer);
    }
    // Not `run`, as with that call between them the compiler stores the task by moves of 16 bytes. The
    // back end loads 8 bytes at a time and has to wait for these: 6 % for short bodies.
    Processor::new().run(Checked { stuffed, buffer })
}

/// The task that does so, window by window.
struct Checked<'a> {
    stuffed: &'a [u8],
    buffer: &'a mut [u8],
}

impl Task for Checked<'_> {
    type Output = Result<usize, usize>;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> Result<usize, usize> {
        let Self { stuffed, buffer } = self;
        let (mut read, mut written) = (0, 0);
        while let Some(rest @ [_, ..]) = stuffed.get(read..) {
            let mut keep = |from: usize, to: usize| {
                put(rest, from, to, buffer.get_mut(written..).unwrap_or_default());
                written += to - from;
            };
            let Places { patterns, stuffing } = match rest.first_chunk() {
                Some(window) => backend.places(window),
                None => backend.places(&pad(rest)),
            };
            let decided = PLACES.min(rest.len());
            let (mut left, mut done) = (patterns & ((1 << decided) - 1), 0);
            while left != 0 {
                let behind = left.trailing_zeros() as usize + STUFFING_PATTERN.len();
                if stuffing >> behind & 1 == 0 {
                    return Err(read + behind);
                }
                keep(done, behind);
                done = behind + 1;
                left &= left - 1;
            }
            if done < decided {
                keep(done, decided);
                done = decided;
            }
            read += done;
        }
        Ok(written)
    }
}

/// Padded with zeros.
fn pad(bytes: &[u8]) -> [u8; WINDOW] {
    let mut padded = [0; WINDOW];
    padded.iter_mut().zip(bytes).for_each(|(slot, byte)| *slot = *byte);
    padded
}

/// Copies the bytes between two places, and perhaps some more, to the front of `target`, as far as
/// they fit.
#[inline(always)]
#[expect(clippy::inline_always, reason = "part of a `Task`")]
fn put(bytes: &[u8], from: usize, to: usize, target: &mut [u8]) {
    let bytes = bytes.get(from..).unwrap_or_default();
    if let (Some(window), Some(target)) = (bytes.first_chunk(), target.first_chunk_mut::<WINDOW>())
    {
        *target = *window;
    } else {
        target.iter_mut().zip(bytes).take(to - from).for_each(|(slot, byte)| *slot = *byte);
    }
}
