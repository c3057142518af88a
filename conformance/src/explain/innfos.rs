//! One frame of the INNFOS Ethernet protocol, field by field.

mod converse;
mod mistakes;
mod split;
mod warnings;

use actucheck_codec::innfos::{self, Frame, FrameError, Message, MessageError, Value};
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::Packet;
use actucheck_spec::wire::innfos::reference::encode;

use super::stream::Listener;
use super::table::{Explanation, Table, rounded};
use super::{Asked, Invalid};
use crate::device::Tables;

pub(super) use mistakes::MISTAKES;

/// Sizes in bytes: header, address, command and length together; the CRC with the end byte.
const PREFIX: usize = 5;
const CRC_AND_END: usize = 3;

/// Explains a whole frame.
pub(super) fn explain(asked: &Asked<'_>) -> Result<Explanation, Invalid> {
    let direction = match asked.context.direction {
        Some(Direction::Reply) => innfos::Direction::Reply,
        _ => innfos::Direction::Request,
    };
    frame(direction, asked.bytes).map_err(|error| Invalid::new(error.offset(), &error))
}

/// A right frame that has what can be read of these bytes, which begin like a frame.
pub(super) fn mended(bytes: &[u8], direction: Option<Direction>) -> Option<Vec<u8>> {
    let [first, address, command, high, low, rest @ ..] = bytes else { return None };
    let mut data = rest.to_vec();
    data.resize(usize::from(u16::from_be_bytes([*high, *low])), 0);
    let frame = |direction| {
        let (address, command, data) = (*address, *command, data.clone().into());
        encode(&Packet { direction, address, command, data })
    };
    let frames = direction.map_or(Direction::ALL.to_vec(), |direction| vec![direction]);
    let mut frames: Vec<_> = frames.into_iter().filter_map(frame).collect();
    // Of two directions, the one whose size fits.
    frames.sort_by_key(|frame| frame.len() != bytes.len());
    frames.into_iter().next().filter(|_| *first == innfos::HEADER)
}

/// Finds frames in a stream, and follows who asks and who answers.
pub(super) fn listen(_: Tables) -> Box<dyn Listener> {
    Box::new((split::Frames::default(), converse::Talk::default()))
}

fn frame(direction: innfos::Direction, bytes: &[u8]) -> Result<Explanation, FrameError> {
    let frame = Frame::parse(direction, bytes)?;
    let mut table = Table::new(bytes);
    table.take(1, "header", |_| String::new());
    table.take(1, "address", |_| match frame.address() {
        0 => "0 (all, or the board)".to_owned(),
        address => address.to_string(),
    });
    let command = frame.command();
    table.take(1, "command", |_| format!("{:#04X} ({})", command.code(), command.name()));
    let size = frame.data().len();
    table.take(2, "length", |_| format!("{size} bytes of data"));
    if size > 0 {
        let meaning = match Message::parse(&frame) {
            Ok(message) => message.value.map_or_else(String::new, |value| words(&message, value)),
            Err(MessageError::Unknown { .. }) => String::new(),
            Err(error) => error.to_string(),
        };
        table.take(size, "data", |_| meaning.clone());
    }
    if bytes.len() >= PREFIX + size + CRC_AND_END {
        table.take(2, "CRC", |bytes| match bytes {
            [0, 0] => "zeros, which this reply may have".to_owned(),
            _ => "of the data, right".to_owned(),
        });
    }
    table.take(1, "end", |_| String::new());

    let word = match direction {
        innfos::Direction::Request => "request to",
        innfos::Direction::Reply => "reply of",
    };
    let title = format!("{word} {}: {}", frame.address(), command.name());
    Ok(Explanation { title, rows: table.rows })
}

/// The value, with its unit if that does not depend on the model.
fn words(message: &Message, value: Value) -> String {
    let row = message.command.row();
    let unit = row.and_then(|row| row.unit).unwrap_or_default();
    let relative = row.and_then(|row| row.full_scale).is_some();
    let number = |number: f64| match (relative, unit) {
        (true, unit) => format!("{} of the model's full scale ({unit})", rounded(number)),
        (false, "") => rounded(number),
        (false, unit) => format!("{} {unit}", rounded(number)),
    };
    match value {
        Value::Flag(flag) => match flag.is_yes() {
            Some(true) => "yes (success, enabled, on, normal)".to_owned(),
            Some(false) => "no (failure, disabled, off)".to_owned(),
            None => format!("{:#04X}, which the document does not explain", flag.0),
        },
        Value::Mode(mode) => format!("{} ({})", mode.code(), mode.name()),
        Value::Alarms(alarms) => {
            let names: Vec<_> = alarms.names().collect();
            if names.is_empty() { "no alarm".to_owned() } else { names.join(", ") }
        }
        Value::Iq8(value) => number(value.to_f64()),
        Value::Iq24(value) => number(value.to_f64()),
        Value::Scaled(raw) => format!("{raw}, in a scale of its own ({unit})"),
        Value::Mac(_) => "tells actuators apart".to_owned(),
    }
}
