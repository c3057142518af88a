//! Reads what an adapter answers. A run and the check of an adapter read it here, so that both call
//! the same wrong.

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{self, Message, Packet, Wire};
use serde::{Deserialize, Deserializer};
use serde_json::Value;
use thiserror::Error;

#[cfg(unix)]
use super::Reported;
use super::value::Given;
use super::{Exchanged, Greeting, Output, Question, Told, VERSIONS};
use crate::legible::{LONGEST_TEXT, legible};

/// The most bytes of an `ok` whose form is looked at. No right one is nearly as long. A longer one
/// is read without that, as anything of it that is kept takes much more memory than its text.
const LONGEST_OK: usize = 1 << 20;

/// Why an `ok` is outside the adapter protocol.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{what}")]
pub struct Misfit {
    /// What is wrong.
    pub what: String,
    /// How to mend it.
    pub mend: String,
}

impl Misfit {
    fn new(what: impl AsRef<str>, mend: impl Into<String>) -> Self {
        Self { what: legible(what.as_ref(), LONGEST_TEXT), mend: mend.into() }
    }
}

impl Output {
    /// Reads the `ok` of a reply to a question.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(question: &Question, ok: &str) -> Result<Self, Misfit> {
        if ok.len() <= LONGEST_OK {
            return Self::of(question, &object(ok)?);
        }
        let mut text = serde_json::Deserializer::from_str(ok);
        typed(question, &mut text).map_err(|error| unfit(question.name(), &error))
    }

    /// The same for an `ok` whose fields are read already.
    pub(super) fn of(question: &Question, ok: &Value) -> Result<Self, Misfit> {
        let output = typed(question, ok.clone()).map_err(|error| unfit(question.name(), &error))?;
        lowercase(ok)?;
        let packets = match &output {
            Self::Crc(crc) if *crc > u64::from(u16::MAX) => {
                return Err(Misfit::new(
                    format!("the CRC {crc} has more than 16 bits"),
                    "answer with the CRC's value as a number, not with its bytes",
                ));
            }
            Self::Packet(packet) => std::slice::from_ref(packet),
            Self::Packets(packets) => packets,
            Self::Crc(_)
            | Self::Bytes(_)
            | Self::Value(_)
            | Self::Message(_)
            | Self::Conversation(_)
            | Self::Line(_) => &[],
        };
        if packets.iter().any(|packet| packet.wire() != question.wire()) {
            return Err(Misfit::new("the packet is of a kind that this wire has not", kinds()));
        }
        Ok(output)
    }
}

impl Greeting {
    /// Reads the `ok` of a reply to `hello`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn read(ok: &str) -> Result<Self, Misfit> {
        Self::of(&object(ok)?)
    }

    /// The same for an `ok` whose fields are read already.
    pub(super) fn of(ok: &Value) -> Result<Self, Misfit> {
        let greeting = Self::deserialize(ok).map_err(|error| {
            Misfit::new(
                format!("`ok` is incomplete: {error}"),
                "tell `protocol`, `implementation` with `name`, `version` and `language`, \
                 `roles`, `wires` and `ops`; `max_in_flight` and `limits` if there is something \
                 to tell",
            )
        })?;
        if VERSIONS.contains(&greeting.protocol) {
            return Ok(greeting);
        }
        let spoken = VERSIONS.map(|version| version.to_string()).join(" and ");
        Err(Misfit::new(
            format!(
                "it speaks version {} of the adapter protocol, this suite speaks {spoken}",
                greeting.protocol
            ),
            "answer with one of the versions that the request offers",
        ))
    }
}

/// Reads the `ok` of a reply to `call`: what the library's user gets of each device.
///
/// # Errors
/// What is wrong with it.
#[cfg(unix)]
pub(crate) fn devices(ok: &str) -> Result<Vec<Reported>, Misfit> {
    #[derive(Deserialize)]
    struct Devices {
        devices: Vec<Reported>,
    }
    let ok = object(ok)?;
    lowercase(&ok)?;
    let devices = Devices::deserialize(&ok).map_err(|error| unfit("call", &error));
    devices.map(|Devices { devices }| devices)
}

/// Reads the `ok` of a reply to `exchange`: what was sent, and what was returned.
///
/// # Errors
/// What is wrong with it.
pub(crate) fn exchanged(ok: &str) -> Result<Exchanged, Misfit> {
    let ok = object(ok)?;
    lowercase(&ok)?;
    if ok.get("devices").is_some() && ok.get("err").is_some() {
        return Err(Misfit::new(
            "`ok` has `devices` and `err`",
            "answer with `devices` if the call succeeded, and with `err` if it failed",
        ));
    }
    Exchanged::deserialize(&ok).map_err(|error| unfit("exchange", &error))
}

/// The fields of an `ok`.
pub(super) fn object(ok: &str) -> Result<Value, Misfit> {
    if ok.len() > LONGEST_OK {
        return Err(Misfit::new(
            format!("`ok` has {} bytes", ok.len()),
            "answer with what was asked only: no right answer is nearly as long",
        ));
    }
    // It was read before, but not the values in it: a number may be too large for any type.
    match serde_json::from_str(ok) {
        Ok(fields @ Value::Object(_)) => Ok(fields),
        Ok(_) => Err(Misfit::new(
            "`ok` is no object",
            "put the result under its name into `ok`, such as {\"crc\": 1}",
        )),
        Err(error) => Err(Misfit::new(
            format!("`ok` can't be read: {error}"),
            "write it with a library for JSON",
        )),
    }
}

/// Reads the fields that the question asks for.
fn typed<'de, D: Deserializer<'de>>(question: &Question, ok: D) -> Result<Output, D::Error> {
    #[derive(Deserialize)]
    struct Crc {
        crc: u64,
    }
    #[derive(Deserialize)]
    struct Bytes {
        bytes: HexBytes,
    }
    #[derive(Deserialize)]
    struct One {
        packet: Packet,
    }
    #[derive(Deserialize)]
    struct Many {
        packets: Vec<Packet>,
    }
    #[derive(Deserialize)]
    struct Meaning {
        value: wire::Value,
    }
    #[derive(Deserialize)]
    struct Said {
        message: Message,
    }
    let fits = |form: &wire::Form, value: &wire::Value| {
        if form.fits(value) {
            return Ok(());
        }
        Err(serde::de::Error::custom(format_args!("`value` must have {form}")))
    };
    Ok(match question {
        Question::Message { form, told: Told::Frame { .. }, .. } => {
            let Said { message } = Said::deserialize(ok)?;
            if let (Some(form), Some(value)) = (form, &message.value) {
                fits(form, value)?;
            }
            Output::Message(message)
        }
        Question::Value { form, given: Given::Bytes(_), .. } => {
            let Meaning { value } = Meaning::deserialize(ok)?;
            fits(form, &value)?;
            Output::Value(value)
        }
        Question::Crc { .. } => Output::Crc(Crc::deserialize(ok)?.crc),
        Question::Decode { .. } => Output::Packet(One::deserialize(ok)?.packet),
        Question::Stream { .. } => Output::Packets(Many::deserialize(ok)?.packets),
        _ => Output::Bytes(Bytes::deserialize(ok)?.bytes),
    })
}

fn unfit(op: &str, error: &impl std::fmt::Display) -> Misfit {
    Misfit::new(
        format!("`ok` does not fit {op}: {error}"),
        "`actucheck adapter guide` has a table of what `ok` holds",
    )
}

/// The kinds of packets of the wires.
fn kinds() -> String {
    let kinds = Wire::ALL.map(|wire| format!("on {wire} `kind` is {}", wire.kinds().join(" or ")));
    kinds.join(", ")
}

/// Whether the bytes in an object are written as the adapter protocol requires.
fn lowercase(value: &Value) -> Result<(), Misfit> {
    let bytes = |name: &str| matches!(name, "bytes" | "params" | "data" | "mac");
    match value {
        Value::Object(fields) => fields.iter().try_for_each(|(name, value)| match value {
            Value::String(text) if bytes(name) => digits(name, text),
            value => lowercase(value),
        }),
        Value::Array(values) => values.iter().try_for_each(lowercase),
        _ => Ok(()),
    }
}

fn digits(name: &str, text: &str) -> Result<(), Misfit> {
    let wrong = |digit: &char| !matches!(digit, '0'..='9' | 'a'..='f');
    match text.chars().find(wrong) {
        Some(digit) => Err(Misfit::new(
            format!("`{name}` has a `{digit}` in it"),
            "write bytes as lowercase hex digits, two a byte, with nothing between them",
        )),
        None => Ok(()),
    }
}
