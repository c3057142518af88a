//! Whole packets: a checked view of a packet, and building a packet.

mod direct;
#[cfg(test)]
mod tests;
mod writer;

use core::fmt;

use super::header::{CRC, Header, PREFIX, is_device, is_id};
use super::stuffing::{self, Matcher};
use super::{FrameError, Instruction, STUFFING_PATTERN};
use crate::simd::patterns;
use crate::{BufferTooSmall, EncodeError, crc};

pub(crate) use writer::Writer;

/// A packet whose header, ID, length, CRC and stuffing are right. Its accessors can't fail.
///
/// The status packet that answers Fast Sync Read or Fast Sync Write is not stuffed and has CRCs
/// of its own: [`FastStatus`](super::FastStatus) reads it.
#[derive(Clone, Copy)]
pub struct Frame<'a> {
    id: u8,
    /// The instruction's code, which becomes an [`Instruction`] only when somebody asks for it.
    code: u8,
    /// Sizes in bytes: the body on the wire, and the parameters without stuffing.
    body_len: usize,
    params_len: usize,
    /// The bytes from the instruction on. Bytes after the body have no meaning; being allowed to
    /// read them makes unstuffing faster.
    bytes: &'a [u8],
}

impl PartialEq for Frame<'_> {
    fn eq(&self, other: &Self) -> bool {
        (self.id, self.code, self.stuffed_params())
            == (other.id, other.code, other.stuffed_params())
    }
}

impl Eq for Frame<'_> {}

impl fmt::Debug for Frame<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Frame")
            .field("id", &self.id)
            .field("instruction", &self.instruction())
            .field("stuffed_params", &self.stuffed_params())
            .finish()
    }
}

impl<'a> Frame<'a> {
    /// The packet of `len` bytes at the beginning of `bytes`, which was already checked and has
    /// `patterns` bytes of stuffing.
    #[inline]
    pub(crate) fn checked(bytes: &'a [u8], len: usize, patterns: usize) -> Option<Self> {
        let (&[.., id, _, _], bytes) = bytes.split_first_chunk::<PREFIX>()?;
        let body_len = len - PREFIX - CRC;
        Some(Self {
            id,
            code: *bytes.first()?,
            body_len,
            params_len: body_len - 1 - patterns,
            bytes,
        })
    }

    /// Reads `bytes`, which are one packet and nothing else.
    ///
    /// # Errors
    /// The first rule that the bytes break, with the offset: header, ID, length, size, CRC,
    /// stuffing, in this order.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, FrameError> {
        let parts = Parts::split(bytes)?;
        let patterns = parts.check()?;
        let code = parts.body.first().copied().unwrap_or_default(); // a length of 3 has one
        parts.header.check_instruction(code)?;
        let (body_len, params_len) = (parts.body.len(), parts.body.len() - 1 - patterns);
        Ok(Self { id: parts.header.id, code, body_len, params_len, bytes: parts.body })
    }

    /// The ID of the device that an instruction packet is for, or that sent a status packet.
    #[must_use]
    pub const fn id(&self) -> u8 {
        self.id
    }

    /// The instruction; [`Instruction::Status`] for a status packet.
    #[must_use]
    pub const fn instruction(&self) -> Instruction {
        Instruction::from_code(self.code)
    }

    /// The bytes between instruction and CRC as on the wire, including stuffing. In a status packet
    /// the first is the error byte.
    #[must_use]
    #[inline]
    pub fn stuffed_params(&self) -> &'a [u8] {
        self.bytes.get(1..self.body_len).unwrap_or_default()
    }

    /// The number of bytes that [`Frame::params`] yields.
    #[must_use]
    pub const fn params_len(&self) -> usize {
        self.params_len
    }

    /// The parameters without stuffing. In a status packet the first is the error byte.
    pub fn params(&self) -> impl Iterator<Item = u8> + Clone + use<'a> {
        // The pattern may begin with the instruction, so the search begins there too.
        let mut matcher = Matcher::default();
        let mut skip = matcher.step(self.code);
        self.stuffed_params().iter().copied().filter(move |byte| {
            let keep = !skip;
            skip = keep && matcher.step(*byte);
            keep
        })
    }

    /// Writes the parameters without stuffing to `buffer`; returns them. The bytes after them in
    /// `buffer` are overwritten. With 128 bytes of room it is fastest: short packets are then copied
    /// by moves of a fixed size.
    ///
    /// # Errors
    /// If `buffer` is smaller than [`Frame::params_len`].
    #[inline]
    pub fn copy_params<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], BufferTooSmall> {
        self.copy_behind(0, buffer)
    }

    /// The same without the first `front` parameters. A pattern may begin with the last of these,
    /// but with no earlier byte.
    #[inline]
    pub(crate) fn copy_behind<'b>(
        &self,
        front: usize,
        buffer: &'b mut [u8],
    ) -> Result<&'b [u8], BufferTooSmall> {
        let (len, available) = (self.params_len.saturating_sub(front), buffer.len());
        let too_small = BufferTooSmall { needed: len, available };
        let target = buffer.get_mut(..len).ok_or(too_small)?;
        let body_len = self.body_len.saturating_sub(front);
        let bytes = self.bytes.get(front..).unwrap_or_default();
        if len + 1 == body_len {
            target.copy_from_slice(bytes.get(1..body_len).unwrap_or_default());
        } else {
            stuffing::remove(bytes, body_len, buffer, len);
        }
        buffer.get(..len).ok_or(too_small)
    }
}

/// The parts of a packet whose header, ID, length and size are right.
pub(crate) struct Parts<'a> {
    pub(crate) header: Header,
    /// The bytes from the instruction up to the CRC, as on the wire.
    pub(crate) body: &'a [u8],
    /// The whole packet.
    bytes: &'a [u8],
    /// Everything before the CRC.
    before_crc: &'a [u8],
    crc: u16,
}

impl<'a> Parts<'a> {
    #[inline]
    pub(crate) fn split(bytes: &'a [u8]) -> Result<Self, FrameError> {
        let available = bytes.len();
        let truncated = |needed| FrameError::Truncated { available, needed };
        let Some(prefix) = bytes.first_chunk() else {
            // An ID may be wrong too, but that the packet is truncated comes first.
            let other_header = |error: &FrameError| matches!(error, FrameError::Header { .. });
            let broken = Header::check_start(bytes).err().filter(other_header);
            return Err(broken.unwrap_or(truncated(PREFIX)));
        };
        let header = Header::check(prefix)?;
        let end = header.packet_len();
        if available > end {
            return Err(FrameError::Trailing { end, available });
        }
        let (before_crc, crc) =
            bytes.split_last_chunk::<CRC>().filter(|_| available == end).ok_or(truncated(end))?;
        let body = before_crc.get(PREFIX..).ok_or(truncated(end))?;
        Ok(Self { header, body, bytes, before_crc, crc: u16::from_le_bytes(*crc) })
    }

    /// Checks the CRC, then the stuffing. Returns the number of patterns in the body.
    fn check(&self) -> Result<usize, FrameError> {
        let looked = direct::look(self.before_crc);
        self.compare_crc(looked.map_or_else(|| crc::umts(self.before_crc), |looked| looked.crc))?;
        match looked {
            Some(looked) if looked.patterns == 0 => Ok(0),
            _ => self.patterns(),
        }
    }

    fn patterns(&self) -> Result<usize, FrameError> {
        let end = self.before_crc.len();
        let up_to_crc = self.bytes.get(..=end).unwrap_or(self.bytes);
        let bare = || stuffing::bare(self.body).unwrap_or_default();
        patterns(up_to_crc, PREFIX, end).ok_or_else(|| FrameError::Stuffing { at: PREFIX + bare() })
    }

    pub(crate) fn check_crc(&self) -> Result<(), FrameError> {
        self.compare_crc(crc::umts(self.before_crc))
    }

    fn compare_crc(&self, expected: u16) -> Result<(), FrameError> {
        let (at, found) = (self.before_crc.len(), self.crc);
        if found == expected { Ok(()) } else { Err(FrameError::Crc { at, found, expected }) }
    }
}

/// Builds a packet in `buffer` from its parameters, which may come in several parts; returns the
/// packet. The bytes after it in `buffer` are overwritten.
///
/// ```
/// use actucheck_codec::dynamixel2::{Instruction, frame};
/// let mut buffer = [0; 16];
/// let packet = frame::encode(1, Instruction::Ping, &[], &mut buffer)?;
/// assert_eq!(packet, b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E");
/// # Ok::<(), actucheck_codec::EncodeError>(())
/// ```
///
/// # Errors
/// If the ID is not valid, the packet would be longer than its length field can say, or `buffer` is
/// too small; the error has the size needed.
#[inline(always)]
#[expect(clippy::inline_always, reason = "most of it goes where the number of parts is known")]
pub fn encode<'b>(
    id: u8,
    instruction: Instruction,
    params: &[&[u8]],
    buffer: &'b mut [u8],
) -> Result<&'b [u8], EncodeError> {
    check_id(id)?;
    if let Some(len) = direct::encode(id, instruction.code(), params, buffer) {
        return Writer::after(buffer, len).into_written();
    }
    encode_parts(id, instruction, params, buffer)
}

/// The size of such a packet in bytes, including stuffing.
///
/// ```
/// use actucheck_codec::dynamixel2::{Instruction, frame};
/// assert_eq!(frame::encoded_len(Instruction::Ping, &[])?, 10);
/// assert_eq!(frame::encoded_len(Instruction::Write, &[b"\x74\x00", b"\xFF\xFF\xFD"])?, 16);
/// # Ok::<(), actucheck_codec::EncodeError>(())
/// ```
///
/// # Errors
/// If the packet would be longer than its length field can say.
pub fn encoded_len(instruction: Instruction, params: &[&[u8]]) -> Result<usize, EncodeError> {
    len_of(|buffer| encode(0, instruction, params, buffer))
}

/// The largest size in bytes of a packet with this many bytes of parameters, as stuffing may add a
/// third of the body. For buffers of constant size.
///
/// ```
/// use actucheck_codec::dynamixel2::frame;
/// let buffer = [0; frame::max_encoded_len(6)]; // a Write of four bytes
/// assert_eq!(buffer.len(), 18);
/// ```
#[must_use]
pub const fn max_encoded_len(params: usize) -> usize {
    let body = 1 + params;
    PREFIX + body + body / STUFFING_PATTERN.len() + CRC
}

/// How many bytes `encode` would write.
pub(crate) fn len_of(
    encode: impl FnOnce(&mut [u8]) -> Result<&[u8], EncodeError>,
) -> Result<usize, EncodeError> {
    match encode(&mut []) {
        Ok(packet) => Ok(packet.len()),
        Err(EncodeError::Buffer(too_small)) => Ok(too_small.needed),
        Err(error) => Err(error),
    }
}

#[inline(never)]
fn encode_parts<'b>(
    id: u8,
    instruction: Instruction,
    params: &[&[u8]],
    buffer: &'b mut [u8],
) -> Result<&'b [u8], EncodeError> {
    let put_all = |put: &mut dyn FnMut(&[u8])| params.iter().for_each(|part| put(part));
    encode_with(id, instruction, put_all, buffer)
}

/// As [`encode`], with the parameters from a function that appends one part after the other.
pub(crate) fn encode_with(
    id: u8,
    instruction: Instruction,
    params: impl Fn(&mut dyn FnMut(&[u8])),
    buffer: &mut [u8],
) -> Result<&[u8], EncodeError> {
    check_id(id)?;
    let mut writer = Writer::new(buffer);
    writer.skip_prefix();
    writer.put(instruction.code());
    params(&mut |part| writer.put_all(part));
    if let Some(end) = writer.written().and_then(|end| stuffing::insert(buffer, PREFIX, end))
        && end + CRC <= buffer.len()
    {
        return Writer::after(buffer, end).finish(id);
    }
    let mut matcher = Matcher::default();
    let mut end = PREFIX;
    let mut count = |part: &[u8]| {
        end += part.len() + part.iter().filter(|byte| matcher.step(**byte)).count();
    };
    count(&[instruction.code()]);
    params(&mut count);
    Writer::after(buffer, end).finish(id)
}

pub(crate) fn length_field(length: usize) -> Result<u16, EncodeError> {
    u16::try_from(length).map_err(|_| EncodeError::TooLong { length })
}

/// A packet may have this ID.
fn check_id(id: u8) -> Result<(), EncodeError> {
    if is_id(id) { Ok(()) } else { Err(EncodeError::Id { found: id }) }
}

/// A device may have this ID.
pub(crate) fn check_device(id: u8) -> Result<(), EncodeError> {
    if is_device(id) { Ok(()) } else { Err(EncodeError::Id { found: id }) }
}
