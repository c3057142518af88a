//! Status packets, with which devices answer (DYNAMIXEL Protocol 2.0, Status Packet).

use super::{ALERT_BIT, ErrorNumber, Frame, FrameError, Instruction, frame};
use crate::layout::LayoutError;
use crate::register::{Register, RegisterError, Value};
use crate::{BufferTooSmall, EncodeError};

/// The error byte of a status packet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct StatusError(pub u8);

impl StatusError {
    /// The result of the instruction, and whether the device has a hardware error.
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::{ErrorNumber, StatusError};
    /// assert_eq!(StatusError::new(ErrorNumber::AccessError, true), StatusError(0x87));
    /// ```
    #[must_use]
    pub const fn new(number: ErrorNumber, alert: bool) -> Self {
        Self(number.code() & !ALERT_BIT | if alert { ALERT_BIT } else { 0 })
    }

    /// Whether the device has a hardware error. Its register Hardware Error Status says which.
    #[must_use]
    pub const fn alert(self) -> bool {
        self.0 & ALERT_BIT != 0
    }

    /// The result of the instruction.
    #[must_use]
    pub const fn number(self) -> ErrorNumber {
        ErrorNumber::from_code(self.0 & !ALERT_BIT)
    }
}

/// The kind of a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind<'a> {
    /// An instruction packet, from a host. [`Request::parse`](super::Request::parse) reads it.
    Instruction(Instruction),
    /// A status packet, from a device.
    Status(Status<'a>),
}

impl<'a> Frame<'a> {
    /// Whether it is an instruction packet or a status packet.
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::{Frame, Instruction, Kind};
    /// let ping = Frame::parse(b"\xFF\xFF\xFD\x00\x01\x03\x00\x01\x19\x4E")?;
    /// assert_eq!(ping.kind(), Kind::Instruction(Instruction::Ping));
    /// # Ok::<(), actucheck_codec::dynamixel2::FrameError>(())
    /// ```
    #[must_use]
    pub fn kind(&self) -> Kind<'a> {
        self.status().map_or(Kind::Instruction(self.instruction()), Kind::Status)
    }

    /// The error byte of a status packet; `None` for an instruction packet.
    #[must_use]
    pub fn error(&self) -> Option<StatusError> {
        let error = self.params().next().filter(|_| self.instruction() == Instruction::Status);
        error.map(StatusError)
    }

    /// The status packet in this frame.
    ///
    /// # Errors
    /// [`FrameError::Instruction`] if it is an instruction packet.
    pub fn status(&self) -> Result<Status<'a>, FrameError> {
        let found = self.instruction().code();
        let error = self.error().ok_or(FrameError::Instruction { found })?;
        Ok(Status { frame: *self, error })
    }
}

/// A status packet. The meaning of its data depends on the request that it answers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Status<'a> {
    frame: Frame<'a>,
    error: StatusError,
}

impl<'a> Status<'a> {
    /// The ID of the device that answers.
    #[must_use]
    pub const fn id(&self) -> u8 {
        self.frame.id()
    }

    /// The result of the instruction.
    #[must_use]
    pub const fn error(&self) -> StatusError {
        self.error
    }

    /// The bytes between the error and the CRC, without stuffing.
    pub fn data(&self) -> impl Iterator<Item = u8> + Clone + use<'a> {
        self.frame.params().skip(1)
    }

    /// The number of bytes that [`Status::data`] yields.
    #[must_use]
    pub const fn data_len(&self) -> usize {
        self.frame.params_len().saturating_sub(1)
    }

    /// Writes the data to `buffer`; returns them. The bytes after them in `buffer` are overwritten,
    /// as with [`Frame::copy_params`].
    ///
    /// # Errors
    /// If `buffer` is smaller than [`Status::data_len`].
    pub fn copy_data<'b>(&self, buffer: &'b mut [u8]) -> Result<&'b [u8], BufferTooSmall> {
        self.frame.copy_behind(1, buffer)
    }

    /// The answer to a Read of this register. The packet may have data although the device reports
    /// an error.
    ///
    /// # Errors
    /// If the number of bytes is not that of the register.
    pub fn value<T: Value>(&self, register: Register<T>) -> Result<T, RegisterError> {
        let mut buffer = [0; 4];
        let data = self.copy_data(&mut buffer).map_err(|error| RegisterError::Size {
            register: register.row.name,
            found: error.needed,
            expected: register.row.kind.size().into(),
        })?;
        register.decode(data)
    }

    /// The answer to a Ping.
    ///
    /// ```
    /// use actucheck_codec::dynamixel2::Frame;
    /// let reply = b"\xFF\xFF\xFD\x00\x01\x07\x00\x55\x00\x06\x04\x26\x65\x5D";
    /// let ping = Frame::parse(reply)?.status()?.ping()?;
    /// assert_eq!((ping.model_number, ping.firmware_version), (1030, 38));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If there are not three bytes of data.
    pub fn ping(&self) -> Result<PingStatus, LayoutError> {
        let mut buffer = [0; PingStatus::SIZE];
        let data = self.copy_data(&mut buffer).map_err(|error| LayoutError::Extra {
            offset: PingStatus::SIZE,
            bytes: error.needed - PingStatus::SIZE,
        })?;
        PingStatus::parse(data)
    }
}

/// The answer to a Ping (DYNAMIXEL Protocol 2.0, Ping; JA40 document, §1.6.1).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PingStatus {
    /// The device's Model Number register.
    pub model_number: u16,
    /// The device's Firmware Version register.
    pub firmware_version: u8,
}

impl PingStatus {
    /// Bytes of data.
    pub const SIZE: usize = 3;

    /// Reads the data of the status packet.
    ///
    /// # Errors
    /// If they are not three bytes.
    pub fn parse(data: &[u8]) -> Result<Self, LayoutError> {
        match *data {
            [low, high, firmware_version] => {
                Ok(Self { model_number: u16::from_le_bytes([low, high]), firmware_version })
            }
            [_, _, _, ..] => {
                let bytes = data.len() - Self::SIZE;
                Err(LayoutError::Extra { offset: Self::SIZE, bytes })
            }
            [_, _] => Err(short("firmware version", 2, 0, 1)),
            _ => Err(short("model number", 0, data.len(), 2)),
        }
    }

    /// Builds the status packet of device `id` in `buffer`; returns the packet.
    ///
    /// # Errors
    /// As [`frame::encode`].
    pub fn encode<'b>(
        &self,
        id: u8,
        error: StatusError,
        buffer: &'b mut [u8],
    ) -> Result<&'b [u8], EncodeError> {
        let [low, high] = self.model_number.to_le_bytes();
        encode(id, error, &[low, high, self.firmware_version], buffer)
    }
}

fn short(field: &'static str, offset: usize, available: usize, needed: usize) -> LayoutError {
    LayoutError::Short { field, offset, available, needed }
}

/// Builds a status packet in `buffer`; returns the packet. `params` is the data: empty for most
/// instructions, and for a Read the bytes read.
///
/// ```
/// use actucheck_codec::dynamixel2::status::{self, StatusError};
/// let mut buffer = [0; 16];
/// let packet = status::encode(1, StatusError(0), &[], &mut buffer)?;
/// assert_eq!(packet, b"\xFF\xFF\xFD\x00\x01\x04\x00\x55\x00\xA1\x0C");
/// # Ok::<(), actucheck_codec::EncodeError>(())
/// ```
///
/// # Errors
/// As [`frame::encode`].
pub fn encode<'b>(
    id: u8,
    error: StatusError,
    params: &[u8],
    buffer: &'b mut [u8],
) -> Result<&'b [u8], EncodeError> {
    frame::encode(id, Instruction::Status, &[&[error.0], params], buffer)
}
