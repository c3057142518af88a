//! Short packets, the most of what is on a bus: their stuffing and CRC by one masked window.
//!
//! Where the lengths of packets vary, a loop over their bytes ends where no processor expects it.
//! So a short packet is looked at as the end of a window of fixed size, with zeros in place of
//! what stands before it. They change neither its CRC, which begins with 0, nor its stuffing.

use super::candidate::STATUS;
use super::{meter, search};
use crate::crc::{self, UMTS_INIT};
use crate::dynamixel2::{BROADCAST_ID, HEADER, MAX_ID, MIN_LENGTH};
use crate::frame::{CRC, PREFIX};

/// Bytes of the longest packet that is short.
pub(super) const LONGEST: usize = WINDOW + CRC;
/// Bytes of the window, in which a packet ends with its body.
const WINDOW: usize = 32;

const _: () = assert!(UMTS_INIT == 0, "zeros in front must not change a CRC");

/// Zeros, then as many ones: what to keep of a window, from any place on.
static KEEP: [[u8; WINDOW]; 2] = [[0; WINDOW], [0xFF; WINDOW]];

/// Ones from the place `first` on, at most at the window's end.
#[inline]
fn keep_from(first: usize) -> &'static [u8; WINDOW] {
    let kept = KEEP.as_flattened().get(WINDOW.saturating_sub(first)..);
    kept.and_then(<[u8]>::first_chunk).unwrap_or(&[0; WINDOW])
}

/// How long a packet is if it begins with these bytes, is short, and breaks no rule before its
/// body; the bytes themselves may be old ones.
#[inline]
pub(super) fn len(bytes: &[u8]) -> Option<usize> {
    let &[first, second, third, fourth, id, low, high, instruction] = bytes.first_chunk()?;
    let length = u16::from_le_bytes([low, high]);
    let status = instruction == STATUS;
    let short = [first, second, third, fourth] == HEADER
        && (id <= MAX_ID || (id == BROADCAST_ID && !status))
        && length >= MIN_LENGTH + u16::from(status)
        && usize::from(length) <= LONGEST - PREFIX;
    short.then_some(PREFIX + usize::from(length))
}

/// How many patterns a packet has, the last `len` of the `bytes`; `None` if its CRC or stuffing
/// is wrong.
#[inline]
pub(super) fn check(bytes: &[u8; LONGEST], len: usize) -> Option<usize> {
    meter::add(2 * WINDOW);
    let (window, found) = bytes.split_last_chunk::<CRC>()?;
    let first = LONGEST.saturating_sub(len);
    let mut packet = [0; WINDOW];
    let words = window.as_chunks().0.iter().zip(keep_from(first).as_chunks().0);
    for (slot, (bytes, keep)) in packet.as_chunks_mut().0.iter_mut().zip(words) {
        *slot = (u64::from_ne_bytes(*bytes) & u64::from_ne_bytes(*keep)).to_ne_bytes();
    }
    if crc::umts(&packet) != u16::from_le_bytes(*found) {
        return None;
    }
    if has_pattern(bytes, first + PREFIX) {
        let body_end = WINDOW;
        return search::patterns(bytes.get(..=body_end)?, first + PREFIX, body_end);
    }
    Some(0)
}

/// Whether the pattern of stuffing stands in the body, which begins at `first`, or across its end.
#[inline]
fn has_pattern(bytes: &[u8; LONGEST], first: usize) -> bool {
    let (keep, _) = keep_from(first).as_chunks::<8>();
    let mut found = 0;
    for (index, keep) in keep.iter().enumerate() {
        let Some(window) = bytes.get(8 * index..).and_then(<[u8]>::first_chunk::<10>) else {
            return true; // there is one for each
        };
        let others = !u64::from_le_bytes(*keep);
        found |= search::some_zero(search::mismatches(window) | others);
    }
    found != 0
}
