//! The ops `open`, `call` and `close`.

use std::io::ErrorKind;

use actucheck_adapter::{Call, Port, Refusal, Reported};
use dynamixel2::{Bus, ReadError, TransferError, WriteError};

use crate::calls::{self, Failure};
use crate::line::Buffered;

/// The library's bus, on a port that it opens by itself.
pub(crate) struct Host(Buffered);

impl Port for Host {
    fn open(path: &str, baud: u32) -> Result<Self, Refusal> {
        let bus = Bus::open(path, baud).map_err(|error| Refusal::rejected("port", error))?;
        Ok(Self(bus))
    }

    fn call(&mut self, device: u8, call: &Call) -> Result<Vec<Reported>, Refusal> {
        let made = calls::make(&mut self.0, device, call);
        let made = made.unwrap_or(Err(Failure::Missing("the library has no function for it")));
        made.map_err(|failure| match failure {
            Failure::Missing(reason) => Refusal::skipped(reason),
            Failure::Refused(detail) => Refusal::rejected("refused", detail),
            Failure::Failed(error) => Refusal::rejected(class(&error), error),
        })
    }
}

/// What went wrong.
fn class(error: &TransferError) -> &'static str {
    match error {
        TransferError::WriteError(WriteError::BufferTooSmall(_)) => "refused",
        TransferError::WriteError(_) => "port",
        TransferError::ReadError(error) => match error {
            ReadError::Io(error) if error.kind() == ErrorKind::TimedOut => "timeout",
            ReadError::Io(_) => "port",
            ReadError::MotorError(_) => "status",
            // A length above its buffer's is one that it takes from the answer.
            ReadError::InvalidMessage(_) | ReadError::BufferFull(_) => "corrupt",
        },
    }
}
