//! Whether an answer has the right form. Its value is the library's responsibility.

use serde_json::Value;

use super::Problem;
use crate::adapter::{Greeting, Output, Question, VERSIONS, Wire};

/// Reads the `ok` object of `hello`.
pub(super) fn hello(ok: &Value) -> Result<Greeting, Problem> {
    let greeting: Greeting = serde_json::from_value(ok.clone()).map_err(|error| {
        Problem::ending(
            format!("`ok` is incomplete: {error}"),
            "tell `protocol`, `implementation` with `name`, `version` and `language`, `roles`, \
             `wires` and `ops`; `max_in_flight` and `limits` if there is something to tell",
        )
    })?;
    if !VERSIONS.contains(&greeting.protocol) {
        return Err(Problem::ending(
            format!("it speaks version {} of the adapter protocol", greeting.protocol),
            "answer with one of the versions that the request offers",
        ));
    }
    Ok(greeting)
}

/// Reads the `ok` object of a reply to a question.
pub(super) fn output(op: &Question, ok: &Value) -> Result<Output, Problem> {
    let output = Output::read(op, ok.clone()).map_err(|error| {
        Problem::new(
            format!("`ok` does not fit {}: {error}", op.name()),
            "`actucheck adapter guide` has a table of what `ok` holds",
        )
    })?;
    lowercase(ok)?;
    let packets = match &output {
        Output::Crc(crc) if *crc > u64::from(u16::MAX) => {
            return Err(Problem::new(
                format!("the CRC {crc} has more than 16 bits"),
                "answer with the CRC's value as a number, not with its bytes",
            ));
        }
        Output::Packet(packet) => std::slice::from_ref(packet),
        Output::Packets(packets) => packets,
        Output::Crc(_) | Output::Bytes(_) | Output::Value(_) | Output::Message(_) => &[],
    };
    if packets.iter().any(|packet| packet.wire() != op.wire()) {
        return Err(Problem::new("the packet is of a kind that this wire has not", kinds()));
    }
    Ok(output)
}

/// The kinds of packets of the wires.
fn kinds() -> String {
    let kinds = Wire::ALL.map(|wire| format!("on {wire} `kind` is {}", wire.kinds().join(" or ")));
    kinds.join(", ")
}

/// Whether the bytes in an object are written as the adapter protocol requires.
fn lowercase(value: &Value) -> Result<(), Problem> {
    let bytes = |name: &str| matches!(name, "bytes" | "params" | "data");
    match value {
        Value::Object(fields) => fields.iter().try_for_each(|(name, value)| match value {
            Value::String(text) if bytes(name) => digits(name, text),
            value => lowercase(value),
        }),
        Value::Array(values) => values.iter().try_for_each(lowercase),
        _ => Ok(()),
    }
}

fn digits(name: &str, text: &str) -> Result<(), Problem> {
    let wrong = |digit: &char| !matches!(digit, '0'..='9' | 'a'..='f');
    match text.chars().find(wrong) {
        Some(digit) => Err(Problem::new(
            format!("`{name}` has a `{digit}` in it"),
            "write bytes as lowercase hex digits, two a byte, with nothing between them",
        )),
        None => Ok(()),
    }
}
