//! What is wrong in the meaning of frames.

use actucheck_codec::innfos::{
    Direction, Frame, FullScale, Iq24, Message, MessageError, Mode, Operation, Value,
};

use super::super::table::rounded;
use super::super::warning::Warning;

/// What is wrong with a frame.
pub(super) fn warnings(frame: &Frame<'_>) -> Vec<Warning> {
    let found = match Message::parse(frame) {
        Ok(message) => value(&message),
        Err(error) => rule(frame.direction(), &error).map(|rule| (rule, error.to_string())),
    };
    found.and_then(|(rule, text)| Warning::of(["innfos"], &[rule], text)).into_iter().collect()
}

/// The requirement that a frame without a meaning breaks. No sentence is about commands that are in
/// no table.
fn rule(direction: Direction, error: &MessageError) -> Option<&'static str> {
    match error {
        MessageError::NoReply { .. } => Some("reply.always"),
        MessageError::Size { command, .. } => Some(match (command.row()?.operation, direction) {
            (Operation::Read, _) => "read.sizes",
            (Operation::Write, Direction::Request) => "write.sizes",
            (Operation::Write, Direction::Reply) => "write.result",
        }),
        _ => None,
    }
}

/// What is wrong with a value of the right size, and the requirement that says so.
fn value(message: &Message) -> Option<(&'static str, String)> {
    let (row, name) = (message.command.row()?, message.command.name());
    match message.value? {
        Value::Flag(flag) if flag.is_yes().is_none() => {
            Some(("flag.values", format!("{name} is 01 or 00, not {:02X}", flag.0)))
        }
        Value::Mode(Mode::Unknown(code)) => {
            Some(("mode.values", format!("no mode has the number {code}")))
        }
        Value::Iq24(Iq24(number)) if number.unsigned_abs() > 1 << 24 => {
            let text = format!("{name} is -1 to 1, not {}", rounded(Iq24(number).to_f64()));
            let rule = match row.full_scale {
                Some(FullScale::Current) => "value.relative",
                _ if name.contains("loop output") => "value.output-limit",
                _ => return None,
            };
            Some((rule, text))
        }
        _ => None,
    }
}
