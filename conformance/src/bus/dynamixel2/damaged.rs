//! Packets whose CRC is wrong. The parser looks for packets in their bytes, so it does not tell them.

use actucheck_codec::dynamixel2::{Frame, FrameError, HEADER};

/// The bytes from the beginning of a packet up to its parameters.
const LENGTH: usize = 7;

/// Bytes that may be the beginning of a packet.
#[derive(Default)]
pub(super) struct Damaged(Vec<u8>);

impl Damaged {
    /// No packet goes on after the bytes that were taken.
    pub(super) fn quiet(&mut self) {
        self.0.clear();
    }

    /// Takes bytes, and hands on each packet in them whose CRC is wrong.
    pub(super) fn feed(&mut self, bytes: &[u8], mut take: impl FnMut(&[u8])) {
        self.0.extend_from_slice(bytes);
        let mut rest = self.0.as_slice();
        loop {
            let header = rest.windows(HEADER.len()).position(|window| window == HEADER);
            let begun = header.unwrap_or(rest.len().saturating_sub(HEADER.len() - 1));
            rest = rest.get(begun..).unwrap_or_default();
            let Some([.., low, high]) = rest.get(..LENGTH) else { break };
            let end = LENGTH + usize::from(u16::from_le_bytes([*low, *high]));
            let Some((packet, after)) = rest.split_at_checked(end) else { break };
            if let Err(FrameError::Crc { .. }) = Frame::parse(packet) {
                take(packet);
            }
            rest = after;
        }
        let taken = self.0.len() - rest.len();
        self.0.drain(..taken);
    }
}
