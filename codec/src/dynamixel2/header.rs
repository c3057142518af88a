//! The bytes before a packet's parameters, and the rules for accepting them (DYNAMIXEL Protocol
//! 2.0, Instruction Packet and Status Packet; JA40 document, §1.4 and §1.5).
//!
//! The rules are only here. Their callers have a whole packet
//! ([`Frame::parse`](super::Frame::parse)) or perhaps a part of one (the stream parser).

use super::{
    BROADCAST_ID, CRC_LOW_BYTE_FIRST, FrameError, HEADER, Instruction, LENGTH_LOW_BYTE_FIRST,
    LENGTH_SIZE, MAX_ID, MIN_ID, MIN_LENGTH,
};

/// Bytes before the instruction: header, ID, length.
pub(crate) const PREFIX: usize = HEADER.len() + size_of::<u8>() + LENGTH_SIZE;
/// Bytes of the CRC, with which a packet ends.
pub(crate) const CRC: usize = size_of::<u16>();
/// The instruction of a status packet.
pub(crate) const STATUS: u8 = Instruction::Status.code();

// What the code of this module assumes about the YAML.
const _: () = assert!(LENGTH_SIZE == size_of::<u16>() && LENGTH_LOW_BYTE_FIRST);
const _: () = assert!(CRC_LOW_BYTE_FIRST);
const _: () = assert!(MIN_ID == 0 && MAX_ID < BROADCAST_ID);
const _: () = assert!(MIN_LENGTH as usize == size_of::<u8>() + CRC);

/// ID and length of a packet, which follow the rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Header {
    pub(crate) id: u8,
    length: u16,
}

impl Header {
    /// Checks a prefix against the rules, in the order of the bytes that can break them.
    ///
    /// # Errors
    /// The first rule that it breaks: [`FrameError::Header`], [`FrameError::Id`] or
    /// [`FrameError::Length`].
    #[inline]
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "a copy is taken apart by shifts")]
    pub(crate) fn check(prefix: &[u8; PREFIX]) -> Result<Self, FrameError> {
        Self::check_start(prefix)?;
        let &[.., id, low, high] = prefix;
        let header = Self { id, length: u16::from_le_bytes([low, high]) };
        header.check_length(MIN_LENGTH)?;
        Ok(header)
    }

    /// The header of a packet that breaks no rule before its body and is no fast status packet. The other
    /// functions check the same, but tell which rule is broken first, which takes more steps.
    #[inline]
    #[expect(clippy::trivially_copy_pass_by_ref, reason = "as above")]
    pub(crate) fn plain(prefix: &[u8; PREFIX], instruction: u8) -> Option<Self> {
        if !prefix.starts_with(&HEADER) {
            return None; // first, as what lies between packets seldom has one
        }
        let &[.., id, low, high] = prefix;
        let header = Self { id, length: u16::from_le_bytes([low, high]) };
        let is_right = if instruction == STATUS {
            is_device(id) && header.length > MIN_LENGTH
        } else {
            is_id(id) && header.length >= MIN_LENGTH
        };
        is_right.then_some(header)
    }

    /// Checks the beginning of a prefix: its header and ID, or the part of them that is there.
    ///
    /// # Errors
    /// The first rule that it breaks: [`FrameError::Header`] or [`FrameError::Id`].
    #[inline]
    pub(crate) fn check_start(bytes: &[u8]) -> Result<(), FrameError> {
        if !bytes.starts_with(&HEADER) {
            return other_header(bytes).map_or(Ok(()), Err);
        }
        match bytes.get(HEADER.len()) {
            Some(&found) if !is_id(found) => Err(FrameError::Id { found }),
            _ => Ok(()),
        }
    }

    /// Checks that the length is enough for a packet with this instruction: a status packet has an
    /// error byte.
    ///
    /// # Errors
    /// [`FrameError::Length`] if not.
    #[inline]
    pub(crate) const fn check_instruction(self, instruction: u8) -> Result<(), FrameError> {
        self.check_length(if instruction == STATUS { MIN_LENGTH + 1 } else { MIN_LENGTH })
    }

    /// The same for a fast status packet, which has an ID in addition to its error byte.
    ///
    /// # Errors
    /// [`FrameError::Length`] if not.
    #[inline]
    pub(crate) const fn check_fast(self) -> Result<(), FrameError> {
        self.check_length(MIN_LENGTH + 2)
    }

    /// Whether such a packet in a stream is a fast status packet: a status packet from the
    /// broadcast ID, which no device has.
    #[inline]
    pub(crate) const fn is_fast(self, instruction: u8) -> bool {
        instruction == STATUS && self.id == BROADCAST_ID
    }

    /// Bytes of the whole packet.
    #[inline]
    pub(crate) const fn packet_len(self) -> usize {
        PREFIX + self.length as usize
    }

    #[inline]
    const fn check_length(self, least: u16) -> Result<(), FrameError> {
        if self.length >= least {
            return Ok(());
        }
        Err(FrameError::Length { found: self.length as usize, expected: least as usize })
    }
}

/// Whether a packet may have this ID: a device's, or the broadcast ID.
#[inline]
pub(crate) const fn is_id(id: u8) -> bool {
    is_device(id) || id == BROADCAST_ID
}

/// Whether a device may have this ID.
#[inline]
pub(crate) const fn is_device(id: u8) -> bool {
    id <= MAX_ID
}

/// The first byte that differs from a header; `None` if `bytes` are the beginning of a header.
#[cold]
fn other_header(bytes: &[u8]) -> Option<FrameError> {
    let mut pairs = bytes.iter().zip(HEADER).enumerate();
    let (at, (found, expected)) = pairs.find(|(_, (found, expected))| *found != expected)?;
    Some(FrameError::Header { at, found: *found, expected })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plain_header_is_one_that_passes_each_check() {
        let [first, second, third, fourth] = HEADER;
        for (id, instruction, length) in (0..=255).flat_map(|id| {
            (0..=255).flat_map(move |code| (0..8).map(move |length| (id, code, length)))
        }) {
            for last in [fourth, fourth + 1] {
                let prefix = [first, second, third, last, id, length, 0];
                let checked = Header::check(&prefix)
                    .and_then(|header| header.check_instruction(instruction).map(|()| header));
                let expected = checked.ok().filter(|header| !header.is_fast(instruction));
                assert_eq!(
                    Header::plain(&prefix, instruction),
                    expected,
                    "{prefix:?} {instruction}"
                );
            }
        }
    }
}
