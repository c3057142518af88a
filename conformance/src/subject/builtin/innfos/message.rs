//! The codec's messages.

use actucheck_codec::innfos::{Actuator, Command, Format, Message, MessageError, Operation};
use actucheck_spec::model::Fault;
use actucheck_spec::wire::{self, Direction};

use super::super::{not_fitting, output, rejection, unbuilt};
use super::{Result, frame, of, value};
use crate::adapter::{Output, Rejection};

/// What a frame says.
pub(super) fn read(direction: Direction, bytes: &[u8], actuator: &Actuator) -> Result {
    let frame = frame(direction, bytes)?;
    let Message { address, command, value, .. } =
        Message::parse(&frame).map_err(|error| unread(&error))?;
    let value = match value {
        None => None,
        Some(value) => Some(value::meaning(command, actuator, value).ok_or_else(not_fitting)?),
    };
    let command = command.code();
    Ok(Output::Message(wire::Message { direction, address, command, value }))
}

/// The frame of a message.
pub(super) fn build(message: &wire::Message, actuator: &Actuator, buffer: &mut [u8]) -> Result {
    let wire::Message { direction, address, command, value } = message;
    let (direction, command) = (of(*direction), Command::from_code(*command));
    let value = match value {
        None => None,
        Some(value) => {
            let format = format(message.direction, command).ok_or_else(not_fitting)?;
            let own = value::own(command, actuator, format, value);
            Some(own.ok_or_else(not_fitting)?)
        }
    };
    let message = Message { direction, address: *address, command, value };
    message.encode(buffer).map(output).map_err(|error| unread(&error))
}

/// The format of the value that the caller of the codec has to give.
fn format(direction: Direction, command: Command) -> Option<Format> {
    let row = command.row()?;
    match (direction, row.operation) {
        (Direction::Reply, Operation::Write) => Some(Format::Flag),
        _ => row.format,
    }
}

fn unread(error: &MessageError) -> Rejection {
    match error {
        MessageError::Unknown { .. } => rejection(Fault::Instruction, error),
        MessageError::Encode(error) => unbuilt(error),
        _ => rejection(Fault::Parameter, error),
    }
}
