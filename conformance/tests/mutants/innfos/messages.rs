//! Mutants that take what a packet says for something else.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use actucheck::adapter::{Output, Question, Told};
use actucheck_spec::Spec;
use actucheck_spec::wire::innfos::{Actuator, Format, Innfos, Packet, reference};
use actucheck_spec::wire::{Direction, Message, Number, Value};

use super::super::{Mutant, Wrong, bytes};

pub(super) static VALUES: [Mutant; 13] = [
    Mutant {
        name: "reads IQ24 values as IQ8",
        blames: "innfos.value.iq24",
        wrong: Wrong::Answers(|op| read(op, Format::Iq24, |number| number * 65_536.0)),
        found_by: "innfos.message.reply.15.01000000/message",
        found_by_documents: true,
    },
    Mutant {
        name: "builds IQ24 values in IQ23",
        blames: "innfos.value.iq24",
        wrong: Wrong::Answers(|op| build(op, Format::Iq24, |raw| raw / 2)),
        found_by: "innfos.message.request.0e.01000000/message-frame",
        found_by_documents: true,
    },
    Mutant {
        name: "reads IQ8 values as whole numbers",
        blames: "innfos.value.iq8",
        wrong: Wrong::Answers(|op| read(op, Format::Iq8, |number| number * 256.0)),
        found_by: "innfos.message.reply.5f.0100/message",
        found_by_documents: false,
    },
    Mutant {
        name: "loses the sign of IQ24 values",
        blames: "innfos.value.position",
        wrong: Wrong::Answers(|op| {
            read(op, Format::Iq24, |number| if number < 0.0 { number + 256.0 } else { number })
        }),
        found_by: "innfos.message.request.0a.fe000000/message",
        found_by_documents: false,
    },
    Mutant {
        name: "loses the sign of temperatures",
        blames: "innfos.value.iq8",
        wrong: Wrong::Answers(|op| {
            read(op, Format::Iq8, |number| if number < 0.0 { number + 256.0 } else { number })
        }),
        found_by: "innfos.iq.temperature-below-zero/message",
        found_by_documents: false,
    },
    Mutant {
        name: "cuts numbers off to four digits",
        blames: "innfos.value.iq24",
        wrong: Wrong::Answers(|op| {
            read(op, Format::Iq24, |number| (number * 10_000.0).trunc() / 10_000.0)
        }),
        found_by: "innfos.iq.largest/message",
        found_by_documents: false,
    },
    Mutant {
        name: "sends the low byte of values first",
        blames: "innfos.value.byte-order",
        wrong: Wrong::Answers(|op| build(op, Format::Iq24, |raw| (raw << 32).swap_bytes())),
        found_by: "innfos.message.request.0a.00123456/message-frame",
        found_by_documents: true,
    },
    Mutant {
        name: "gives the stall energy as it is on the wire",
        blames: "innfos.value.stall-energy",
        wrong: Wrong::Answers(|op| read(op, Format::Scaled, |number| number * 75.225)),
        found_by: "innfos.iq.stall-energy/message",
        found_by_documents: false,
    },
    Mutant {
        name: "takes every model's current for a fraction of 33 A",
        blames: "innfos.value.relative",
        wrong: Wrong::Answers(|op| {
            let Question::Message { actuator: Some(model), .. } = op else { return None };
            if model == "QDD-3510-6" { read(op, Format::Iq24, |number| number * 2.0) } else { None }
        }),
        found_by: "innfos.message.reply.04.00800000.qdd-3510-6/message",
        found_by_documents: false,
    },
    Mutant {
        name: "counts modes from 0",
        blames: "innfos.mode.values",
        wrong: Wrong::Answers(|op| build(op, Format::Mode, |code| code - 1)),
        found_by: "innfos.message.request.07.08/message-frame",
        found_by_documents: true,
    },
    Mutant {
        name: "takes 0 for success",
        blames: "innfos.write.result",
        wrong: Wrong::Answers(|op| {
            let (mut message, _) = said(op, Format::Flag)?;
            if message.direction == Direction::Request {
                return None;
            }
            let Some(Value::Name(name)) = &message.value else { return None };
            let other = if name == "yes" { "no" } else { "yes" };
            message.value = Some(Value::Name(other.to_owned()));
            Some(Output::Message(message))
        }),
        found_by: "innfos.message.reply.fe.00/message",
        found_by_documents: true,
    },
    Mutant {
        name: "names the alarm beside the one that is set",
        blames: "innfos.alarms.bits",
        wrong: Wrong::Answers(|op| {
            let (mut message, _) = said(op, Format::Alarms)?;
            let rows = &spec().wires.innfos.content.alarms.rows;
            let Some(Value::Flags(names)) = &mut message.value else { return None };
            let beside = |name: &String| {
                let at = rows.iter().position(|row| row.name == *name)?;
                Some(rows.get(at + 1)?.name.clone())
            };
            *names = names.iter().filter_map(beside).collect();
            Some(Output::Message(message))
        }),
        found_by: "innfos.message.reply.ff.0004/message",
        found_by_documents: false,
    },
    Mutant {
        name: "does not tell of alarms without a name",
        blames: "innfos.alarms.other",
        wrong: Wrong::Answers(|op| {
            let (mut message, innfos) = said(op, Format::Alarms)?;
            let named: BTreeSet<_> = innfos.alarms.rows.iter().map(|row| &row.name).collect();
            let Some(Value::Flags(names)) = &mut message.value else { return None };
            names.retain(|name| named.contains(name));
            Some(Output::Message(message))
        }),
        found_by: "innfos.message.reply.ff.0800/message",
        found_by_documents: false,
    },
];

fn spec() -> &'static Spec {
    static SPEC: OnceLock<Spec> = OnceLock::new();
    SPEC.get_or_init(|| Spec::embedded().unwrap())
}

fn model(name: Option<&String>) -> Option<&'static Actuator> {
    spec().wires.innfos.content.actuators.rows.iter().find(|row| Some(&row.name) == name)
}

/// What the frame in a question says, if its value has this format.
fn said(op: &Question, format: Format) -> Option<(Message, &'static Innfos)> {
    let Question::Message { actuator, told: Told::Frame { direction, bytes }, .. } = op else {
        return None;
    };
    let innfos = &spec().wires.innfos.content;
    let packet = reference::decode(*direction, bytes).ok()?;
    let meaning = reference::meaning(innfos, &packet, model(actuator.as_ref()))?;
    let row = innfos.command(packet.command)?;
    (row.format_in(*direction) == Some(format)).then_some((meaning.message, innfos))
}

/// Reads numbers of this format wrongly.
fn read(op: &Question, format: Format, change: fn(f64) -> f64) -> Option<Output> {
    let (mut message, _) = said(op, format)?;
    let Some(Value::Number(number)) = &mut message.value else { return None };
    *number = Number::try_from(change(f64::from(*number))).unwrap();
    Some(Output::Message(message))
}

/// Builds the data of this format, as a whole number, wrongly.
fn build(op: &Question, format: Format, change: fn(i64) -> i64) -> Option<Output> {
    let Question::Message { actuator, told: Told::Message { message }, .. } = op else {
        return None;
    };
    let innfos = &spec().wires.innfos.content;
    let row = innfos.command(message.command)?;
    let packet = reference::packet(innfos, message, model(actuator.as_ref()))?;
    if row.format_in(message.direction) != Some(format) {
        return None;
    }
    let weigh = |number: i64, byte: &u8| number << 8 | i64::from(*byte);
    let raw = change(packet.data.iter().fold(0, weigh)).to_be_bytes();
    let data = raw[raw.len() - packet.data.len()..].to_vec().into();
    Some(bytes(reference::encode(&Packet { data, ..packet })?))
}
