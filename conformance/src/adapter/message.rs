//! The fields of the op `message`: which side of a packet is given, its bytes or what it says.

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{Direction, Message};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The side of a packet that is given; the other one is asked.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Told {
    /// One whole frame.
    Frame {
        /// Its direction.
        direction: Direction,
        /// Its bytes.
        bytes: HexBytes,
    },
    /// What it says.
    Message {
        /// What it says.
        message: Message,
    },
}

impl Told {
    /// The direction of the packet.
    #[must_use]
    pub const fn direction(&self) -> Direction {
        match self {
            Self::Frame { direction, .. } => *direction,
            Self::Message { message } => message.direction,
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests may stop at a surprise

    use super::super::Question;

    #[test]
    fn questions_are_read_as_they_are_written() {
        for text in [
            r#"{"op":"message","wire":"innfos","unit":"R","direction":"reply","bytes":"ee01"}"#,
            r#"{"op":"message","wire":"innfos","unit":null,"direction":"reply","bytes":"ee01"}"#,
            r#"{"op":"message","wire":"innfos","direction":"request","bytes":"ee0105"}"#,
            r#"{"op":"message","wire":"innfos","names":["no","yes"],"message":{"direction":"reply","address":6,"command":254,"value":{"name":"yes"}}}"#,
            r#"{"op":"message","wire":"innfos","unit":"A","actuator":"DD-6010","message":{"direction":"request","address":6,"command":8,"value":{"number":16.5}}}"#,
        ] {
            let question: Question = serde_json::from_str(text).unwrap();
            assert_eq!(question.to_string(), text);
        }
    }
}
