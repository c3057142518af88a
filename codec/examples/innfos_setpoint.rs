//! Sends INNFOS setpoints in physical units; NaN is not sent.

use actucheck_codec::Error;
use actucheck_codec::innfos::{Command, DD_6010, Direction, Frame, Message, MessageError};

/// The frame that turns actuator `address` to `revolutions`.
fn turn_to(address: u8, revolutions: f64, buffer: &mut [u8]) -> Result<&[u8], Error> {
    let message = Message::set(address, Command::WritePosition, revolutions, &DD_6010)?;
    Ok(message.encode(buffer)?)
}

fn main() -> Result<(), Error> {
    let mut buffer = [0; Message::MAX_LEN];
    let frame = turn_to(6, 1.0, &mut buffer)?;
    println!("{frame:02X?}");
    assert_eq!(frame, b"\xEE\x06\x0A\x00\x04\x01\x00\x00\x00\x01\xD8\xED");

    // The setpoint of a frame, in the same unit.
    let message = Message::parse(&Frame::parse(Direction::Request, frame)?)?;
    let value = message.value.and_then(|value| message.command.physical(value, &DD_6010));
    assert_eq!(value, Some(1.0));

    // A controller that divides zero by zero moves nothing.
    let refused = turn_to(6, f64::NAN, &mut buffer);
    println!("{refused:?}");
    let command = Command::WritePosition;
    assert_eq!(refused, Err(MessageError::NotANumber { command }.into()));
    Ok(())
}
