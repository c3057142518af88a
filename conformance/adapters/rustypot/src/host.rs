//! The ops of a host.

use std::error::Error;
use std::io;
use std::time::Duration;

use actucheck_adapter::{Call, Memory, Port, Refusal, Reported};
use rustypot::CommunicationErrorKind;
use serialport::SerialPort;

use crate::calls::{self, Failure};
use crate::cause;
use crate::memory_port::MemoryPort;

/// How long the port waits for bytes; the library leaves it to its user.
pub(crate) const TIMEOUT: Duration = Duration::from_millis(100);

/// A port that is opened as the library's documentation says.
pub(crate) struct Host(Box<dyn SerialPort>);

impl Port for Host {
    fn open(path: &str, baud: u32) -> Result<Self, Refusal> {
        let port = serialport::new(path, baud).timeout(TIMEOUT).open();
        Ok(Self(port.map_err(|error| Refusal::rejected("port", error))?))
    }

    fn on(line: Memory, baud: u32) -> Result<Self, Refusal> {
        Ok(Self(Box::new(MemoryPort { line, baud, timeout: TIMEOUT })))
    }

    fn call(&mut self, device: u8, call: &Call) -> Result<Vec<Reported>, Refusal> {
        calls::make(self.0.as_mut(), device, call).map_err(|failure| match failure {
            Failure::Missing(refusal) => refusal,
            Failure::NoAnswer => Refusal::rejected("unspecified", "it returned false"),
            Failure::Failed(error) => Refusal::rejected(class(cause(error.as_ref())), error),
        })
    }
}

/// What went wrong.
fn class(cause: &(dyn Error + 'static)) -> &'static str {
    use CommunicationErrorKind::{
        ChecksumError, IncorrectId, ParsingError, TimeoutError, Unsupported,
    };
    if let Some(error) = cause.downcast_ref::<io::Error>() {
        return if error.kind() == io::ErrorKind::TimedOut { "timeout" } else { "port" };
    }
    match cause.downcast_ref() {
        Some(ChecksumError | IncorrectId(..) | ParsingError) => "corrupt",
        Some(TimeoutError) => "timeout",
        Some(Unsupported) => "refused",
        None if cause.is::<serialport::Error>() => "port",
        None => "internal",
    }
}
