//! The blocks of a fast status packet, each of which is one device's answer.

use actucheck_codec::crc;
use actucheck_codec::dynamixel2::StatusError;
use actucheck_codec::dynamixel2::fast_status::Block;

use super::super::diff::spaced;
use super::PREFIX;
use super::words::{error_words, whom};

/// Bytes of a block beside its data: error, ID and CRC.
const BLOCK: usize = 4;

/// Bytes of data in each block of an answer to a write, by the length that the packet states.
pub(super) fn data_of_write(bytes: &[u8], devices: usize) -> u16 {
    let [_, _, _, _, _, low, high, ..] = *bytes else { return 0 };
    let blocks = usize::from(u16::from_le_bytes([low, high])).saturating_sub(1);
    let block = blocks.checked_div(devices).unwrap_or_default();
    u16::try_from(block.saturating_sub(BLOCK)).unwrap_or_default()
}

/// The blocks that are whole, as their CRCs say: each CRC covers all before it.
pub(super) fn whole_blocks(bytes: &[u8], lengths: impl Iterator<Item = u16>) -> Vec<Block<'_>> {
    let mut found = Vec::new();
    let (head, mut rest) = bytes.split_at_checked(PREFIX + 1).unwrap_or_default();
    let mut crc = crc::umts(head);
    for length in lengths {
        let Some((block, after)) = rest.split_at_checked(BLOCK + usize::from(length)) else {
            break;
        };
        let Some((before, sum)) = block.split_last_chunk() else { break };
        crc = crc::umts_update(crc, before);
        if crc == u16::from_le_bytes(*sum)
            && let [error, id, data @ ..] = before
        {
            found.push(Block { error: StatusError(*error), id: *id, data });
        }
        crc = crc::umts_update(crc, sum);
        rest = after;
    }
    found
}

/// A block in words.
pub(super) fn block_words(block: &Block<'_>) -> String {
    format!("{}: {}, data {}", whom(block.id), error_words(block.error), spaced(block.data))
}
