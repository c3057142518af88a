//! What is wrong in the meaning of frames.

use actucheck_codec::innfos::{Direction, Frame, Message, MessageError, Operation};

use super::super::warning::Warning;

/// What is wrong with a frame.
pub(super) fn warnings(frame: &Frame<'_>) -> Vec<Warning> {
    let Err(error) = Message::parse(frame) else { return Vec::new() };
    let rule = match error {
        MessageError::NoReply { .. } => Some("innfos.reply.always"),
        MessageError::Size { command, .. } => {
            command.row().map(|row| match (row.operation, frame.direction()) {
                (Operation::Read, _) => "innfos.read.sizes",
                (Operation::Write, Direction::Request) => "innfos.write.sizes",
                (Operation::Write, Direction::Reply) => "innfos.write.result",
            })
        }
        // No sentence is about commands that are in no table.
        _ => None,
    };
    rule.and_then(|rule| Warning::of([rule.to_owned()], error.to_string())).into_iter().collect()
}
