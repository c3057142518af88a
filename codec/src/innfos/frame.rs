use super::{
    BROADCAST_ADDRESS, CRC_LOW_BYTE_FIRST, Command, FrameError, HEADER, LENGTH_LOW_BYTE_FIRST,
    LENGTH_SIZE, MAX_ADDRESS, MIN_ADDRESS, OPTIONAL_CRC_REPLIES, REPLY_CRC_FROM, REQUEST_CRC_FROM,
    TAIL,
};
use crate::{BufferTooSmall, EncodeError, crc};

/// Bytes before the data: header, address, command, length.
const PREFIX: usize = size_of_val(&HEADER) + 2 * size_of::<u8>() + LENGTH_SIZE;

// What the code of this module takes for granted of the YAML: any byte is an address.
const _: () = assert!(LENGTH_SIZE == size_of::<u16>() && !LENGTH_LOW_BYTE_FIRST);
const _: () = assert!(CRC_LOW_BYTE_FIRST);
const _: () = assert!(MIN_ADDRESS == 1 && MAX_ADDRESS == u8::MAX && BROADCAST_ADDRESS == 0);

/// The direction of a frame. The frame itself does not state it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From the host.
    Request,
    /// To the host.
    Reply,
}

/// A frame whose header, size, end and CRC are right. Its accessors can't fail.
/// [`Message::parse`](super::Message::parse) checks whether the data fits the command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Frame<'a> {
    direction: Direction,
    address: u8,
    command: Command,
    data: &'a [u8],
}

impl<'a> Frame<'a> {
    /// Reads `bytes`, which are one frame and nothing else.
    ///
    /// # Errors
    /// The first rule that the bytes break, with the offset, in this order: header, size, end byte,
    /// extra bytes, CRC.
    pub fn parse(direction: Direction, bytes: &'a [u8]) -> Result<Self, FrameError> {
        let (parts, rest) = Parts::split(direction, bytes)?;
        if !rest.is_empty() {
            let available = bytes.len();
            return Err(FrameError::Trailing { end: available - rest.len(), available });
        }
        parts.checked(direction)
    }

    /// Reads the frame at the beginning of `bytes`. Returns it and the rest of the bytes.
    ///
    /// # Errors
    /// As [`Frame::parse`], apart from extra bytes.
    pub fn first(direction: Direction, bytes: &'a [u8]) -> Result<(Self, &'a [u8]), FrameError> {
        let (parts, rest) = Parts::split(direction, bytes)?;
        Ok((parts.checked(direction)?, rest))
    }

    /// Its direction.
    #[must_use]
    pub const fn direction(&self) -> Direction {
        self.direction
    }

    /// The actuator that it is for or from; 0 means all actuators, or the board.
    #[must_use]
    pub const fn address(&self) -> u8 {
        self.address
    }

    /// The command.
    #[must_use]
    pub const fn command(&self) -> Command {
        self.command
    }

    /// The bytes between length and CRC.
    #[must_use]
    pub const fn data(&self) -> &'a [u8] {
        self.data
    }
}

/// The parts of a frame whose header, size and end are right.
struct Parts<'a> {
    address: u8,
    command: u8,
    data: &'a [u8],
    /// None, or the two bytes of the CRC.
    crc: &'a [u8],
}

impl<'a> Parts<'a> {
    fn split(direction: Direction, bytes: &'a [u8]) -> Result<(Self, &'a [u8]), FrameError> {
        let available = bytes.len();
        let truncated = |needed| FrameError::Truncated { available, needed };
        if let Some(found) = bytes.first().copied().filter(|first| *first != HEADER) {
            return Err(FrameError::Header { found });
        }
        let (prefix, rest) = bytes.split_first_chunk::<PREFIX>().ok_or(truncated(PREFIX + 1))?;
        let [_, address, command, high, low] = *prefix;
        let length = usize::from(u16::from_be_bytes([high, low]));
        let crc_len = crc_len(direction, command, length, rest);
        let tail = PREFIX + length + crc_len;
        let (data, rest) = rest.split_at_checked(length).ok_or(truncated(tail + 1))?;
        let (crc, rest) = rest.split_at_checked(crc_len).ok_or(truncated(tail + 1))?;
        let (found, rest) = rest.split_first().ok_or(truncated(tail + 1))?;
        if *found != TAIL {
            return Err(FrameError::Tail { at: tail, found: *found });
        }
        Ok((Self { address, command, data, crc }, rest))
    }

    fn checked(self, direction: Direction) -> Result<Frame<'a>, FrameError> {
        let Self { address, command, data, crc } = self;
        if let [low, high] = *crc {
            let (found, expected) = (u16::from_le_bytes([low, high]), crc::modbus(data));
            // For a frame whose CRC is optional, `crc_len` has checked it.
            if found != expected && !has_optional_crc(direction, command, data.len()) {
                return Err(FrameError::Crc { at: PREFIX + data.len(), found, expected });
            }
        }
        Ok(Frame { direction, address, command: Command::from_code(command), data })
    }
}

/// Bytes of the CRC. `rest` begins with the data.
fn crc_len(direction: Direction, command: u8, length: usize, rest: &[u8]) -> usize {
    if !has_optional_crc(direction, command, length) {
        return if has_crc(direction, length) { 2 } else { 0 };
    }
    // Zeros or the right CRC with the end byte after them count as a CRC.
    let (data, rest) = rest.split_at_checked(length).unwrap_or_default();
    match *rest {
        [low, high, TAIL, ..] => {
            let crc = u16::from_le_bytes([low, high]);
            let right = crc == 0 || crc == crc::modbus(data);
            if right { 2 } else { 0 }
        }
        _ => 0,
    }
}

/// Whether a frame with this many bytes of data has a CRC (INNFOS document, Communication protocol
/// format and Protocol example).
const fn has_crc(direction: Direction, length: usize) -> bool {
    let from = match direction {
        Direction::Request => REQUEST_CRC_FROM,
        Direction::Reply => REPLY_CRC_FROM,
    };
    length >= from
}

/// Whether the CRC is optional: some replies have no CRC, zeros in its place, or a CRC (INNFOS
/// document, Handshake with ECB and Query actuator).
fn has_optional_crc(direction: Direction, command: u8, length: usize) -> bool {
    direction == Direction::Reply
        && length > 0
        && !has_crc(direction, length)
        && OPTIONAL_CRC_REPLIES.contains(&command)
}

/// The size of a frame with this many bytes of data.
#[must_use]
pub const fn encoded_len(direction: Direction, data: usize) -> usize {
    PREFIX + data + if has_crc(direction, data) { size_of::<u16>() } else { 0 } + size_of_val(&TAIL)
}

/// Builds a frame in `buffer`; returns it. A reply whose CRC is optional gets none, as the document
/// prints it.
///
/// ```
/// use actucheck_codec::innfos::{self, Command, Direction};
/// let mut buffer = [0; 16];
/// let frame = innfos::encode(Direction::Request, 1, Command::ReadSpeed, &[], &mut buffer)?;
/// assert_eq!(frame, b"\xEE\x01\x05\x00\x00\xED");
/// # Ok::<(), actucheck_codec::EncodeError>(())
/// ```
///
/// # Errors
/// If there are more than 65,535 bytes of data, or `buffer` is too small; the error has the size
/// needed: 6 bytes, the data, and 2 for the CRC if there is one.
pub fn encode<'b>(
    direction: Direction,
    address: u8,
    command: Command,
    data: &[u8],
    buffer: &'b mut [u8],
) -> Result<&'b [u8], EncodeError> {
    let length =
        u16::try_from(data.len()).map_err(|_| EncodeError::TooLong { length: data.len() })?;
    let [high, low] = length.to_be_bytes();
    let prefix = [HEADER, address, command.code(), high, low];
    let crc = crc::modbus(data).to_le_bytes();
    let crc: &[u8] = if has_crc(direction, data.len()) { &crc } else { &[] };
    let needed = encoded_len(direction, data.len());
    let too_small = BufferTooSmall { needed, available: buffer.len() };
    let target = buffer.get_mut(..needed).ok_or(too_small)?;
    let bytes = prefix.iter().chain(data).chain(crc).chain(&[TAIL]);
    for (slot, byte) in target.iter_mut().zip(bytes) {
        *slot = *byte;
    }
    Ok(target)
}
