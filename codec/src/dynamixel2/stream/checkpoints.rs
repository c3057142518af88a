//! Computes the CRC of any range of the buffer, in about the time of 64 bytes.
//!
//! Fast status packets are not stuffed, so one that turns out to be false may have many headers
//! inside, each of which claims bytes up to the same end. To compute each of these CRCs from its
//! bytes would take time that grows with the square of the length. But a CRC is linear: if `a` and
//! `b` are the CRCs of everything up to two places `n` bytes apart, the CRC of the bytes between is
//! b + a·x^(8n) mod P. So it is enough to keep one CRC every 64 bytes.

use super::BLOCK;
use crate::crc::{self, UMTS_INIT};
use crate::simd::meter;

/// CRCs at the blocks' beginnings, for a buffer of twice `BLOCKS` blocks.
#[derive(Clone, Debug)]
pub(super) struct Checkpoints<const BLOCKS: usize> {
    /// For each block, the CRC of the bytes from an earlier block up to it.
    crcs: [[u16; BLOCKS]; 2],
    /// The last block whose CRC is known.
    last: usize,
}

impl<const BLOCKS: usize> Checkpoints<BLOCKS> {
    pub(super) const fn new() -> Self {
        Self { crcs: [[UMTS_INIT; BLOCKS]; 2], last: 0 }
    }

    /// The CRC of the bytes of `buffer` from `start` up to `end`. `start` must not decrease and
    /// bytes must not change between calls, except after [`Checkpoints::shift`] or
    /// [`Checkpoints::clear`].
    pub(super) fn range(&mut self, buffer: &[u8], start: usize, end: usize) -> u16 {
        if start / BLOCK > self.last {
            self.last = start / BLOCK;
            self.set(self.last, UMTS_INIT);
        }
        while (self.last + 1) * BLOCK <= end {
            let block = buffer.get(self.last * BLOCK..).unwrap_or_default();
            let block = block.get(..BLOCK).unwrap_or(block);
            meter::add(block.len());
            let crc = crc::umts_update(self.get(self.last), block);
            if !self.set(self.last + 1, crc) {
                break; // the end of the buffer
            }
            self.last += 1;
        }
        let count = end - start;
        self.up_to(buffer, end) ^ crc::umts_shift(self.up_to(buffer, start), count as u64)
    }

    /// Removes the first `blocks` blocks; the others move to the front.
    pub(super) fn shift(&mut self, blocks: usize) {
        if blocks > self.last {
            return self.clear();
        }
        self.crcs.as_flattened_mut().copy_within(blocks..=self.last, 0);
        self.last -= blocks;
    }

    /// Forgets everything, as the bytes change.
    pub(super) fn clear(&mut self) {
        self.last = 0;
        self.set(0, UMTS_INIT);
    }

    /// The CRC of the bytes up to `end`.
    fn up_to(&self, buffer: &[u8], end: usize) -> u16 {
        let block = (end / BLOCK).min(self.last);
        let rest = buffer.get(block * BLOCK..end).unwrap_or_default();
        meter::add(rest.len());
        crc::umts_update(self.get(block), rest)
    }

    fn get(&self, block: usize) -> u16 {
        self.crcs.as_flattened().get(block).copied().unwrap_or_default()
    }

    /// Whether there is such a block.
    fn set(&mut self, block: usize, crc: u16) -> bool {
        let slot = self.crcs.as_flattened_mut().get_mut(block);
        slot.map(|slot| *slot = crc).is_some()
    }
}
