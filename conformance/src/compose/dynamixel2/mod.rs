//! Instruction packets and status packets from words. The layouts of the parameters are those of
//! the wire's file.

mod fields;
mod register;

use actucheck_spec::Spec;
use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::{Block, Dynamixel2, Instruction, Packet, reference};

pub(super) use self::register::bytes;

use self::fields::{Part, Parts};
use super::{
    ComposeError, Composed, Phrase, Word, as_word, for_one_device, hex_of, named, no_value, number,
    unknown, value_of,
};

/// The largest body that the length field can count, which counts the CRC too.
const LONGEST_BODY: usize = 0xFFFF - 2;
const ALERT: &str = "alert";

pub(super) fn compose(spec: &Spec, phrase: &Phrase<'_>) -> Result<Composed, ComposeError> {
    let wire = &spec.wires.dynamixel2.content;
    if phrase.actuator.is_some() || phrase.direction == Direction::Reply {
        let message = "--actuator and --direction are for another wire; the instruction says the \
                       direction here";
        return Err(ComposeError::Misplaced(message.to_owned()));
    }
    let mut refused = Vec::new();
    let packet = match as_word(phrase.verb).as_str() {
        "status" => status(spec, wire, phrase, &mut refused)?,
        "fast-status" => fast_status(spec, wire, phrase, &mut refused)?,
        _ => instruction(spec, wire, phrase, &mut refused)?,
    };
    refused.extend(register::problems(spec, phrase, &packet));
    frame(packet, refused)
}

/// An instruction packet.
fn instruction(
    spec: &Spec,
    wire: &Dynamixel2,
    phrase: &Phrase<'_>,
    refused: &mut Vec<String>,
) -> Result<Packet, ComposeError> {
    let (code, row) = instruction_of(wire, phrase.verb)?;
    let name = row.map_or(phrase.verb, |row| &row.name);
    if row.is_none() {
        refused.push(format!("the documents have no instruction 0x{code:02X}"));
    } else {
        let devices = phrase.devices(spec).into_iter().flatten();
        let without = devices.filter(|device| !device.instructions.iter().any(|it| it == name));
        refused.extend(without.map(|it| format!("{} has no instruction {name}", it.title)));
    }
    let is_raw = |word: &Word| word.name == "params" && word.id.is_none();
    let params = match (phrase.words, row) {
        ([word], _) if is_raw(word) => {
            if row.is_some_and(lists_devices) && !phrase.ids.is_empty() {
                let message = "the devices are in `params=HEX`; take away --id";
                return Err(ComposeError::Misplaced(message.to_owned()));
            }
            hex_of(word)?
        }
        (words, _) if words.iter().any(is_raw) => {
            let message = "`params=HEX` has all parameters, so no other word goes with it";
            return Err(ComposeError::Misplaced(message.to_owned()));
        }
        (_, Some(row)) => {
            Parts::new(spec, phrase, &row.parameters)?.fill(&row.parameters, refused)?
        }
        ([], None) => Vec::new(),
        (_, None) => {
            let message =
                format!("the parameters of {name} have no names; give `params=HEX` alone");
            return Err(ComposeError::Misplaced(message));
        }
    };
    let id = recipient(wire, phrase, row, refused)?;
    let packet = Packet::Instruction { id, instruction: code, params: params.into() };
    if row.is_some() && reference::call(&packet).is_general {
        refused.push(format!("the parameters do not fit {name}"));
    }
    Ok(packet)
}

/// An instruction by its name or its code; `None` if the documents have none with this code.
fn instruction_of<'a>(
    wire: &'a Dynamixel2,
    verb: &str,
) -> Result<(u8, Option<&'a Instruction>), ComposeError> {
    let code = number::whole(verb).and_then(|code| u8::try_from(code).ok());
    if let Some(code) = code {
        return Ok((code, wire.instructions.iter().find(|row| row.code == code)));
    }
    let row = wire.instructions.iter().find(|row| as_word(&row.name) == as_word(verb));
    row.map(|row| (row.code, Some(row))).ok_or_else(|| {
        let names = wire.instructions.iter().map(|row| as_word(&row.name));
        let answers = ["status", "fast-status"].map(str::to_owned);
        unknown("instruction", verb, names.chain(answers).collect())
    })
}

fn lists_devices(row: &Instruction) -> bool {
    row.parameters.iter().any(|field| !field.each.is_empty())
}

/// The ID of an instruction packet. One with a list of devices goes to all.
fn recipient(
    wire: &Dynamixel2,
    phrase: &Phrase<'_>,
    row: Option<&Instruction>,
    refused: &mut Vec<String>,
) -> Result<u8, ComposeError> {
    let broadcast = wire.framing.id.broadcast;
    if row.is_some_and(lists_devices) {
        return Ok(broadcast);
    }
    let id = one_id(phrase)?;
    if let Some(row) = row
        && row.broadcast_only
        && id != broadcast
    {
        refused.push(format!("{} goes to the broadcast ID {broadcast} only", row.name));
    }
    allow(wire, id, id == broadcast, refused);
    Ok(id)
}

/// A status packet.
fn status(
    spec: &Spec,
    wire: &Dynamixel2,
    phrase: &Phrase<'_>,
    refused: &mut Vec<String>,
) -> Result<Packet, ComposeError> {
    for_one_device(phrase)?;
    let id = one_id(phrase)?;
    allow(wire, id, false, refused);
    let (error, params) = answer(spec, wire, phrase, None, refused)?;
    Ok(Packet::Status { id, error, params })
}

/// The status packet that several devices share.
fn fast_status(
    spec: &Spec,
    wire: &Dynamixel2,
    phrase: &Phrase<'_>,
    refused: &mut Vec<String>,
) -> Result<Packet, ComposeError> {
    if let Some(word) = phrase.words.iter().find(|word| word.id.is_none()) {
        let message = format!("put the ID of a device before `{0}`: ID:{0}", word.name);
        return Err(ComposeError::Misplaced(message));
    }
    let ids = fields::devices(phrase)?;
    let mut blocks = Vec::new();
    for id in ids {
        allow(wire, id, false, refused);
        let (error, data) = answer(spec, wire, phrase, Some(id), refused)?;
        blocks.push(Block { id, error, data });
    }
    if blocks
        .iter()
        .any(|block| blocks.first().is_some_and(|first| first.data.len() != block.data.len()))
    {
        refused.push(
            "the devices of a fast status packet all send the same number of bytes".to_owned(),
        );
    }
    Ok(Packet::FastStatus { blocks })
}

/// The error and the parameters of an answer.
fn answer(
    spec: &Spec,
    wire: &Dynamixel2,
    phrase: &Phrase<'_>,
    id: Option<u8>,
    refused: &mut Vec<String>,
) -> Result<(u8, HexBytes), ComposeError> {
    let part = Part::of(spec, phrase, id, &["error", "params"])?;
    let error = match part.field("error") {
        Some(word) => error_of(wire, value_of(word)?, refused)?,
        None => 0,
    };
    let params = match part.field("params") {
        Some(params) => hex_of(params)?,
        None => part.data(phrase.verb)?.map(<[u8]>::to_vec).unwrap_or_default(),
    };
    Ok((error, params.into()))
}

/// An error byte: its number, or its name, with `+alert` for the alert bit.
fn error_of(wire: &Dynamixel2, value: &str, refused: &mut Vec<String>) -> Result<u8, ComposeError> {
    let alert = 1_u8.checked_shl(wire.status.alert_bit.into()).unwrap_or(0);
    let (alerts, numbers): (Vec<_>, Vec<_>) =
        value.split('+').partition(|word| as_word(word) == ALERT);
    let number = match *numbers {
        [] => 0,
        [word] => match number::whole(word).map(u8::try_from) {
            Some(Ok(number)) => number,
            _ => named("error", word, wire.status.errors.iter(), |row| &row.name)?.number,
        },
        _ => return Err(no_value(value, "error", "a status packet has one error, and `alert`")),
    };
    let error = if alerts.is_empty() { number } else { number | alert };
    let number = error & !alert;
    if number != 0 && !wire.status.errors.iter().any(|row| row.number == number) {
        refused.push(format!("the documents have no error number 0x{number:02X}"));
    }
    Ok(error)
}

/// The only ID.
fn one_id(phrase: &Phrase<'_>) -> Result<u8, ComposeError> {
    match phrase.ids {
        [id] => Ok(*id),
        [] => Err(ComposeError::Missing("add --id with the ID of the device".to_owned())),
        _ => Err(ComposeError::Misplaced("this packet has one ID; give --id one".to_owned())),
    }
}

fn allow(wire: &Dynamixel2, id: u8, is_broadcast: bool, refused: &mut Vec<String>) {
    let ids = &wire.framing.id;
    if !is_broadcast && !(ids.min..=ids.max).contains(&id) {
        refused.push(format!("no device can have the ID {id}; IDs are {} to {}", ids.min, ids.max));
    }
}

/// The bytes of a packet, whether or not it may have its ID.
fn frame(packet: Packet, refused: Vec<String>) -> Result<Composed, ComposeError> {
    let (id, body) = match &packet {
        Packet::Instruction { id, instruction, params } => {
            (*id, [&[*instruction], &**params].concat())
        }
        Packet::Status { id, error, params } => {
            (*id, [&[reference::STATUS, *error], &**params].concat())
        }
        Packet::FastStatus { .. } => {
            let bytes = reference::encode(&packet).ok_or(ComposeError::TooLong)?;
            return Ok(Composed { packet: packet.into(), bytes, not_stuffed: None, refused });
        }
    };
    let stuffed = reference::stuff(&body);
    if stuffed.len() > LONGEST_BODY {
        return Err(ComposeError::TooLong);
    }
    let (bytes, not_stuffed) = (reference::frame(id, &stuffed), Some(reference::frame(id, &body)));
    Ok(Composed { packet: packet.into(), bytes, not_stuffed, refused })
}
