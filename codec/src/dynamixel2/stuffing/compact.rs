//! Byte stuffing byte by byte: little code, for processors without 64-bit registers, to which windows
//! of 64 bytes cost more than they save.

use crate::dynamixel2::{STUFFING_BYTE, STUFFING_PATTERN};
use crate::simd::meter;

/// As [`insert`](super::insert()).
pub(super) fn insert(buffer: &mut [u8], start: usize, end: usize) -> Option<usize> {
    let stuffed_end = end + missing(buffer.get(start..end)?);
    if stuffed_end > buffer.len() {
        return None;
    }
    // From the back, until nothing is missing any more.
    let (mut read, mut write) = (end, stuffed_end);
    while read < write {
        if buffer.get(start..read)?.ends_with(&STUFFING_PATTERN) {
            write -= 1;
            *buffer.get_mut(write)? = STUFFING_BYTE;
        }
        read -= 1;
        write -= 1;
        *buffer.get_mut(write)? = *buffer.get(read)?;
    }
    Some(stuffed_end)
}

/// The number of bytes that stuffing adds to a body.
pub(super) fn missing(body: &[u8]) -> usize {
    // Two patterns never overlap.
    body.windows(STUFFING_PATTERN.len()).filter(|bytes| **bytes == STUFFING_PATTERN).count()
}

/// As [`checked`](super::remove::checked).
pub(super) fn checked(stuffed: &[u8], buffer: &mut [u8]) -> Result<usize, usize> {
    let (mut read, mut written) = (0, 0);
    // The stuffed body from the end of the last stuffing up to here.
    let mut since = 0;
    while let Some(byte) = stuffed.get(read) {
        read += 1;
        if let Some(slot) = buffer.get_mut(written) {
            *slot = *byte;
        }
        written += 1;
        if stuffed.get(since..read).is_some_and(|bytes| bytes.ends_with(&STUFFING_PATTERN)) {
            if stuffed.get(read) != Some(&STUFFING_BYTE) {
                return Err(read);
            }
            read += 1;
            since = read;
        }
    }
    Ok(written)
}

/// As [`patterns`](crate::simd::patterns).
pub(crate) fn patterns(bytes: &[u8], from: usize, body_end: usize) -> Option<usize> {
    const LEN: usize = STUFFING_PATTERN.len();
    let mut count = 0;
    for (at, window) in bytes.get(from..)?.windows(LEN + 1).enumerate() {
        meter::add(1);
        let [pattern @ .., byte] = window else { return None }; // never: a window has four
        if pattern == STUFFING_PATTERN {
            // Behind the body comes the CRC, whatever its value.
            if *byte != STUFFING_BYTE || from + at + LEN >= body_end {
                return None;
            }
            count += 1;
        }
    }
    Some(count)
}
