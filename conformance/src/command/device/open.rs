//! Opens the line to a device, wherever it is.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use actucheck::adapter::{Implementation, Settings, Wire};
use actucheck::port::Place;
use actucheck::subject::device::{Line, Slave, SlaveError};

use super::super::shared::Failure;

/// What is opened.
pub(super) struct Opening<'a> {
    pub(super) wire: Wire,
    pub(super) place: &'a Place,
    /// Whether the place is the command of an adapter.
    pub(super) is_adapter: bool,
    /// The rate of a serial port.
    pub(super) baud: u32,
    /// How long an answer is awaited.
    pub(super) limit: Duration,
}

impl Opening<'_> {
    /// The line, and what an adapter says of its library.
    pub(super) fn line(
        &self,
        interrupted: &Arc<AtomicBool>,
    ) -> Result<(Line, Option<Implementation>), Failure> {
        let Self { wire, place, baud, limit, .. } = *self;
        let interrupted = Arc::clone(interrupted);
        let command = match place {
            Place::Program(command) if self.is_adapter => command,
            _ => {
                let line = Line::open(wire, place, baud, limit, interrupted);
                return Ok((line.map_err(Failure::not_started)?, None));
            }
        };
        // An interruption does not end it, as the device is restored after one.
        let (slave, library) =
            Slave::start(command, &Settings::default(), wire).map_err(|error| match error {
                SlaveError::Start(error) => Failure::not_started(error),
                error @ SlaveError::NoDevice(_) => Failure::usage(error),
            })?;
        Ok((Line::on(wire, place, Box::new(slave), limit, interrupted), Some(library)))
    }
}
