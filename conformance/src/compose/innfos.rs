//! Requests and replies from words: `read position`, `write mode=current`.

use actucheck_spec::Spec;
use actucheck_spec::wire::innfos::{
    Actuator, Command, Format, Innfos, Operation, Packet, reference,
};
use actucheck_spec::wire::{Direction, Message, Number, Value};

use super::{
    ComposeError, Composed, Phrase, Word, as_word, for_one_device, hex_of, named, no_value, number,
    unknown,
};

/// What a flag may be called, and what the reference model calls it.
const FLAGS: [(&str, &str); 8] = [
    ("no", "no"),
    ("off", "no"),
    ("0", "no"),
    ("failure", "no"),
    ("yes", "yes"),
    ("on", "yes"),
    ("1", "yes"),
    ("success", "yes"),
];

pub(super) fn compose(spec: &Spec, phrase: &Phrase<'_>) -> Result<Composed, ComposeError> {
    let innfos = &spec.wires.innfos.content;
    if !phrase.tables.is_empty() {
        let message = "--device is for another wire; take it away";
        return Err(ComposeError::Misplaced(message.to_owned()));
    }
    for_one_device(phrase)?;
    let address = address(phrase)?;
    let mut refused = Vec::new();
    let packet = match number::whole(phrase.verb).map(u8::try_from) {
        Some(Ok(command)) => coded(phrase, address, command)?,
        _ => named_command(spec, phrase, address, &mut refused)?,
    };
    if !reference::is_in_tables(innfos, &packet) {
        refused.push("the document's tables have no such packet".to_owned());
    }
    let bytes = reference::encode(&packet).ok_or(ComposeError::TooLong)?;
    Ok(Composed { packet: packet.into(), bytes, not_stuffed: None, refused })
}

fn address(phrase: &Phrase<'_>) -> Result<u8, ComposeError> {
    match phrase.ids {
        [id] => Ok(*id),
        [] => Err(ComposeError::Missing(
            "add --id with the actuator's address, or --id 0 for the board or all".to_owned(),
        )),
        _ => Err(ComposeError::Misplaced("this packet has one address; give --id one".to_owned())),
    }
}

/// A packet whose command and data are given as bytes.
fn coded(phrase: &Phrase<'_>, address: u8, command: u8) -> Result<Packet, ComposeError> {
    let data = match phrase.words {
        [] => Vec::new(),
        [word] if word.name == "data" => hex_of(word)?,
        _ => {
            let message = "a command by its code takes `data=HEX` only";
            return Err(ComposeError::Misplaced(message.to_owned()));
        }
    };
    Ok(Packet { direction: phrase.direction, address, command, data: data.into() })
}

fn named_command(
    spec: &Spec,
    phrase: &Phrase<'_>,
    address: u8,
    refused: &mut Vec<String>,
) -> Result<Packet, ComposeError> {
    let innfos = &spec.wires.innfos.content;
    let operation = match as_word(phrase.verb).as_str() {
        "read" => Operation::Read,
        "write" => Operation::Write,
        _ => {
            let known = ["read", "write", "a code such as 0x06"].map(str::to_owned).to_vec();
            return Err(unknown("verb", phrase.verb, known));
        }
    };
    let [word] = phrase.words else {
        let message = format!("name one command: {} NAME, or NAME=VALUE", phrase.verb);
        return Err(ComposeError::Missing(message));
    };
    let rows = innfos.commands.iter().filter(|row| row.operation == operation);
    let row = named("command", &word.name, rows, |row| &row.name)?;
    let actuator = match phrase.actuator {
        Some(name) => Some(named("actuator", name, innfos.actuators.rows.iter(), |row| &row.name)?),
        None => None,
    };
    let direction = phrase.direction;
    let value = value(innfos, row, direction, word, actuator)?;
    if let Some(Value::Number(number)) = value {
        refused.extend(outside(spec, row, number, actuator));
    }
    let message = Message { direction, address, command: row.code, value };
    let packet = reference::packet(innfos, &message, actuator);
    let fits = packet.filter(|packet| says(innfos, packet, &message, actuator));
    fits.ok_or_else(|| {
        let given = word.value.as_deref().unwrap_or_default();
        no_value(given, &row.name, "the packet has no room for it")
    })
}

/// Why the spec refuses a number: a fraction is at most the whole. A scale that depends on an open
/// erratum refuses nothing.
fn outside(
    spec: &Spec,
    row: &Command,
    number: Number,
    actuator: Option<&Actuator>,
) -> Option<String> {
    let largest = actuator?.full_scale(row.full_scale?);
    let is_outside = f64::from(number).abs() > largest && !spec.depends_on_open(&row.errata);
    is_outside.then(|| {
        let unit = row.unit.as_deref().unwrap_or_default();
        format!("{} may be -{largest} to {largest} {unit}, the full scale", row.name)
    })
}

/// Whether a packet says this; a number that is too large for its bytes comes back as another one.
fn says(innfos: &Innfos, packet: &Packet, message: &Message, actuator: Option<&Actuator>) -> bool {
    let meaning = reference::meaning(innfos, packet, actuator);
    meaning.is_some_and(|meaning| {
        meaning.message == *message || meaning.message.is_near(message, meaning.step)
    })
}

/// The value of a message; `None` if it has none.
fn value(
    innfos: &Innfos,
    row: &Command,
    direction: Direction,
    word: &Word,
    actuator: Option<&Actuator>,
) -> Result<Option<Value>, ComposeError> {
    let (format, text) = match (row.format_in(direction), word.value.as_deref()) {
        (None, None) => return Ok(None),
        (None, Some(text)) => {
            return Err(no_value(text, &row.name, format!("a {direction} has no value here")));
        }
        (Some(_), None) => {
            let message = format!("a {direction} has a value here: {}=VALUE", word.name);
            return Err(ComposeError::Missing(message));
        }
        (Some(format), Some(text)) => (format, text),
    };
    let value = match format {
        Format::Flag => {
            let flag = FLAGS.into_iter().find(|(name, _)| *name == as_word(text));
            let known = || FLAGS.map(|(name, _)| name.to_owned()).to_vec();
            let (_, flag) = flag.ok_or_else(|| unknown("flag", text, known()))?;
            Value::Name(flag.to_owned())
        }
        Format::Mode => Value::Name(
            named("mode", text, innfos.modes.rows.iter(), |row| &row.name)?.name.clone(),
        ),
        Format::Alarms => {
            let alarm = |name| named("alarm", name, innfos.alarms.rows.iter(), |row| &row.name);
            let alarms = text.split('+').filter(|name| !name.is_empty());
            let names: Result<_, _> = alarms.map(|name| Ok(alarm(name)?.name.clone())).collect();
            Value::Flags(names?)
        }
        Format::Iq8 | Format::Iq24 | Format::Scaled => {
            if row.full_scale.is_some() && actuator.is_none() {
                return Err(needs_actuator(innfos));
            }
            Value::Number(amount(row, text)?)
        }
        Format::Mac => {
            let problem = format!("give its bytes: 0x{:02X} data=HEX", row.code);
            return Err(no_value(text, &row.name, problem));
        }
    };
    Ok(Some(value))
}

/// A number in the command's unit, which may stand after it.
fn amount(row: &Command, text: &str) -> Result<Number, ComposeError> {
    let own = row.unit.as_deref().unwrap_or_default();
    let amount = number::quantity(text)
        .filter(|(_, unit)| unit.is_empty() || number::is_unit(unit, own))
        .and_then(|(amount, _)| Number::try_from(amount).ok());
    let problem = || {
        let unit = if own.is_empty() { String::new() } else { format!(" of {own}") };
        no_value(text, &row.name, format!("it is a number{unit}"))
    };
    amount.ok_or_else(problem)
}

fn needs_actuator(innfos: &Innfos) -> ComposeError {
    let names: Vec<_> = innfos.actuators.rows.iter().map(|row| as_word(&row.name)).collect();
    let message = format!(
        "the value is a fraction of the actuator's full scale; add --actuator, one of {}",
        names.join(", ")
    );
    ComposeError::Missing(message)
}
