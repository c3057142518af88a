//! Encodes short packets: their bytes go to the buffer and into the CRC, and are not read back.
//!
//! A load of bytes that were just stored in smaller pieces makes the processor wait for longer than
//! all the rest of such a packet takes.

use crate::dynamixel2::header::{CRC, PREFIX};
use crate::dynamixel2::{HEADER, STUFFING_BYTE, STUFFING_PATTERN};
use crate::simd::{Backend, HAS_WORDS, Looked, Pieces, Task, WINDOW, run};

/// Bytes before the parameters.
const FRONT: usize = PREFIX + 1;
/// Size in bytes of the longest packet that is written in this way, before stuffing.
const ROOM: usize = FRONT + size_of::<u64>() - 1 + WINDOW + CRC;

/// Writes the packet to `buffer` and returns its length. `None` if the parameters are not at most
/// seven bytes and a last part of at most 64, if stuffing is needed before the last part, or if the
/// packet may not fit.
#[inline(always)]
#[expect(clippy::inline_always, reason = "as the public function is")]
pub(super) fn encode(id: u8, code: u8, params: &[&[u8]], buffer: &mut [u8]) -> Option<usize> {
    if !HAS_WORDS {
        return None;
    }
    let (mut lead, mut lead_len, mut tail) = (0_u64, 0, &[][..]);
    for part in params {
        if !tail.is_empty() {
            return None;
        }
        if lead_len + part.len() < size_of_val(&lead) {
            lead |= word(part) << (8 * lead_len);
            lead_len += part.len();
        } else {
            tail = part;
        }
    }
    let [low, high] = u16::try_from(1 + lead_len + tail.len() + CRC).ok()?.to_le_bytes();
    let [first, second, third, fourth] = HEADER;
    let prefix = u64::from_le_bytes([first, second, third, fourth, id, low, high, code]);
    run(Encode { pieces: Pieces { prefix, lead_len, lead, tail }, buffer })
}

/// The CRC and the patterns of a packet, which ends before its CRC here; `None` if its body is
/// longer than 65 bytes or a pattern begins with its instruction.
#[inline]
pub(super) fn look(before_crc: &[u8]) -> Option<Looked> {
    if !HAS_WORDS {
        return None;
    }
    let (prefix, tail) = before_crc.split_first_chunk()?;
    let prefix = u64::from_le_bytes(*prefix);
    run(Pieces { prefix, lead_len: 0, lead: 0, tail })
}

/// The task that writes a packet and returns its length.
struct Encode<'a> {
    pieces: Pieces<'a>,
    buffer: &'a mut [u8],
}

impl Task for Encode<'_> {
    type Output = Option<usize>;

    #[inline(always)]
    #[expect(clippy::inline_always, reason = "see `Task`")]
    fn run(self, backend: impl Backend) -> Option<usize> {
        let Self { pieces, buffer } = self;
        let Looked { crc, patterns } = backend.look(pieces)?;
        if patterns != 0 {
            return encode_stuffed(backend, pieces, patterns, buffer);
        }
        let len = FRONT + pieces.lead_len + pieces.tail.len() + CRC;
        if let Some(room) = buffer.first_chunk_mut() {
            put(pieces, crc, len, room)?;
        } else {
            let mut room = [0; ROOM];
            put(pieces, crc, len, &mut room)?;
            buffer.get_mut(..len)?.copy_from_slice(room.get(..len)?);
        }
        Some(len)
    }
}

/// Writes a packet of `len` bytes that needs no stuffing.
#[inline(always)]
#[expect(clippy::inline_always, reason = "part of a `Task`")]
fn put(pieces: Pieces<'_>, crc: u16, len: usize, room: &mut [u8; ROOM]) -> Option<()> {
    put_front(pieces, room)?;
    let (before_crc, slots) = room.get_mut(..len)?.split_last_chunk_mut::<CRC>()?;
    *slots = crc.to_le_bytes();
    copy(pieces.tail, before_crc.get_mut(FRONT + pieces.lead_len..)?);
    Some(())
}

/// The same, with stuffing after the patterns that begin at these places of the tail. A separate
/// function, as most packets need no stuffing.
#[inline(never)]
fn encode_stuffed(
    backend: impl Backend,
    pieces: Pieces<'_>,
    patterns: u64,
    buffer: &mut [u8],
) -> Option<usize> {
    let Pieces { prefix, lead_len, tail, .. } = pieces;
    let mut whole = [0; 2 * WINDOW];
    copy(tail, whole.get_mut(..tail.len())?);
    let count = patterns.count_ones();
    // A length this short needs only its low byte.
    let prefix = prefix + (u64::from(count) << 40);
    let target = put_front(Pieces { prefix, ..pieces }, buffer)?;
    // A whole window each time: the end of a loop over the bytes is hard to predict.
    *target.first_chunk_mut()? = *whole.first_chunk::<WINDOW>()?;
    let (mut left, mut stuffed) = (patterns, 0);
    while left != 0 {
        let behind = left.trailing_zeros() as usize + STUFFING_PATTERN.len();
        let (stuffing, rest) = target.get_mut(behind + stuffed..)?.split_first_mut()?;
        *stuffing = STUFFING_BYTE;
        *rest.first_chunk_mut()? = *whole.get(behind..)?.first_chunk::<WINDOW>()?;
        stuffed += 1;
        left &= left - 1;
    }
    let end = FRONT + lead_len + tail.len() + stuffed;
    let (before_crc, rest) = buffer.split_at_mut_checked(end)?;
    *rest.first_chunk_mut()? = backend.umts(before_crc).to_le_bytes();
    Some(end + CRC)
}

/// Writes the bytes before the tail. Returns the space for the tail; the bytes after it are
/// overwritten.
#[inline]
fn put_front<'b>(pieces: Pieces<'_>, buffer: &'b mut [u8]) -> Option<&'b mut [u8]> {
    let Pieces { prefix, lead, lead_len, .. } = pieces;
    *buffer.first_chunk_mut()? = prefix.to_le_bytes();
    *buffer.get_mut(FRONT..)?.first_chunk_mut()? = lead.to_le_bytes();
    buffer.get_mut(FRONT + lead_len..)
}

/// Fewer than eight bytes as a number, the first byte lowest.
#[inline]
fn word(bytes: &[u8]) -> u64 {
    if let (Some(first), Some(last)) = (bytes.first_chunk(), bytes.last_chunk()) {
        let (first, last) = (u32::from_le_bytes(*first), u32::from_le_bytes(*last));
        u64::from(last) << (8 * (bytes.len() - 4)) | u64::from(first)
    } else {
        // Byte by byte: the caller may have just stored them one by one (see above).
        bytes.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte))
    }
}

/// Copies to a slice of the same size, without a call if it is short.
#[inline]
fn copy(bytes: &[u8], target: &mut [u8]) {
    /// Copies `N` to `2 * N` bytes by two moves that may overlap.
    #[inline]
    fn ends<const N: usize>(bytes: &[u8], target: &mut [u8]) -> Option<()> {
        *target.first_chunk_mut::<N>()? = *bytes.first_chunk()?;
        *target.last_chunk_mut::<N>()? = *bytes.last_chunk()?;
        Some(())
    }
    let copied = match bytes.len() {
        0 => Some(()),
        65.. => None,
        32.. => ends::<32>(bytes, target),
        16.. => ends::<16>(bytes, target),
        8.. => ends::<8>(bytes, target),
        4.. => ends::<4>(bytes, target),
        _ => None,
    };
    if copied.is_none() {
        target.copy_from_slice(bytes);
    }
}
