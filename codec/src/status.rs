//! Status packets: what a device answers (DYNAMIXEL Protocol 2.0, Status Packet).

use crate::dynamixel2::{ALERT_BIT, ErrorNumber, Instruction};
use crate::{EncodeError, Frame, frame};

/// The error byte of a status packet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct StatusError(pub u8);

impl StatusError {
    /// Whether the device has a hardware error, which its Hardware Error Status register tells.
    #[must_use]
    pub const fn alert(self) -> bool {
        self.0 & ALERT_BIT != 0
    }

    /// How the instruction went.
    #[must_use]
    pub const fn number(self) -> ErrorNumber {
        ErrorNumber::from_code(self.0 & !ALERT_BIT)
    }
}

impl Frame<'_> {
    /// The error byte of a status packet; `None` for an instruction packet.
    #[must_use]
    pub fn error(&self) -> Option<StatusError> {
        let error = self.params().next().filter(|_| self.instruction() == Instruction::Status);
        error.map(StatusError)
    }
}

/// Builds a status packet in `buffer`; returns the packet.
///
/// ```
/// use actucheck_codec::status::{self, StatusError};
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
