//! Takes stuffing away from a body that is known to be right.

use crate::crc::{Backend, Engine, Task, WINDOW};
use crate::dynamixel2::STUFFING_PATTERN;

/// Writes what follows the body's first byte to the first `len` bytes of `buffer`, which is how
/// long that is without stuffing. The body is the first `stuffed` of the `bytes`. More of either
/// makes it faster; what is behind in `buffer` is lost.
pub(crate) fn remove(bytes: &[u8], stuffed: usize, buffer: &mut [u8], len: usize) {
    let engine = Engine::new();
    if let Some(whole) = buffer.first_chunk_mut()
        && engine.run(Short { bytes, stuffed, whole }).is_some()
    {
        return;
    }
    let target = buffer.get_mut(..len).unwrap_or_default();
    let mut whole = [0; 2 * WINDOW];
    if engine.run(Short { bytes, stuffed, whole: &mut whole }).is_some() {
        copy_short(&whole, target);
    } else {
        remove_any(bytes.get(..stuffed).unwrap_or_default(), target);
    }
}

/// The task to do so by moves of a whole window each, whatever is behind; `None` if the body is
/// too long for it, has none or more than two patterns, or ends too close to the end of `bytes`.
///
/// No branch depends on where the patterns stand, as nothing foretells it.
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
        // Where patterns begin that have their stuffing in the body.
        let places = (1 << stuffed.checked_sub(3).filter(|last| *last < WINDOW)?) - 1;
        let patterns = backend.places(bytes.first_chunk()?).patterns & places;
        let others = patterns & patterns.wrapping_sub(1);
        if stuffed > WINDOW || patterns == 0 || others & others.wrapping_sub(1) != 0 {
            return None;
        }
        // Where there is no stuffing, that of a body that ends there.
        let stuffing = |patterns: u64| (patterns.trailing_zeros() as usize + 3).min(stuffed);
        let (first, second) = (stuffing(patterns), stuffing(others));
        let after = |at: usize| bytes.get(at + 1..)?.first_chunk::<WINDOW>();
        *whole.first_chunk_mut()? = *after(0)?;
        *whole.get_mut(first - 1..)?.first_chunk_mut()? = *after(first)?;
        *whole.get_mut(second - 2..)?.first_chunk_mut()? = *after(second)?;
        Some(())
    }
}

/// Copies the bytes that `target` has room for, at most a window.
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

/// Byte by byte, whatever the length, and again without branches.
fn remove_any(body: &[u8], target: &mut [u8]) {
    let [one, two, three] = STUFFING_PATTERN;
    let pattern = u32::from_be_bytes([0, one, two, three]);
    let Some((first, rest)) = body.split_first() else {
        return; // never: there is an instruction
    };
    let mut last_four = u32::from(*first);
    let mut next = 0;
    for byte in rest {
        if let Some(slot) = target.get_mut(next) {
            *slot = *byte;
        }
        // Behind a pattern stands stuffing: the next byte takes its place.
        next += usize::from(last_four & 0x00FF_FFFF != pattern);
        last_four = last_four << 8 | u32::from(*byte);
    }
}
