//! What packets say: commands with their values by name or in the document's unit.

mod basics;

use actucheck_spec::wire::innfos::reference::{self, Meaning};
use actucheck_spec::wire::innfos::{Actuator, Command, Format, FullScale, Operation, Packet};
use actucheck_spec::wire::{Direction, Message, Number, Value};

pub(super) use self::basics::family as basics;
pub(in crate::suite::codec) use self::basics::rests_on;
use super::tables;
use crate::adapter::{Output, Question, Told};
use crate::names::as_word;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::{Family, Group};
use crate::suite::{Author, hex};

/// The question for what a frame says, and the one for the frame that says it.
const BOTH: [&str; 2] = ["/message", "/message-frame"];
const READ: [&str; 1] = ["/message"];

/// Models of different full scales.
const MODELS: [&str; 2] = ["QDD Pro-8108-50", "QDD-3510-6"];

/// The motor speed that the document calls the full scale of every model (§Protocol example and
/// §IQmath Introduction).
const SPEED_OF_ALL: f64 = 6000.0;

/// Every command of the tables with the values of its format.
pub(super) fn family(author: Author<'_>, direction: Direction) -> Family<'_> {
    let prefix = format!("innfos.message.{direction}.");
    Family::new(prefix.clone(), move || {
        let prefix = prefix.clone();
        let said = tables::all(author, direction).flat_map(move |packet| all_of(author, &packet));
        said.map(move |said| {
            let Packet { command, data, .. } = &said.packet;
            let model = said.actuator.map(|model| format!(".{}", name(model))).unwrap_or_default();
            let stem = format!("{prefix}{command:02x}.{}{model}", hex(data));
            let names = if said.has_one_packet(author) { &BOTH[..] } else { &READ };
            Group::new(stem, names, move |stem| said.checks(author, stem, said.requirement()))
        })
    })
}

/// A model's name for an id.
fn name(model: &Actuator) -> String {
    as_word(&model.name)
}

/// A packet, its row, and the model that it is about if its value is a fraction of a full scale.
pub(super) struct Said<'a> {
    packet: Packet,
    row: &'a Command,
    actuator: Option<&'a Actuator>,
}

/// A packet with each value to try.
fn all_of<'a>(author: Author<'a>, packet: &Packet) -> Vec<Said<'a>> {
    let innfos = tables::rows(author);
    let Some(row) = innfos.command(packet.command) else { return Vec::new() };
    let all = match row.format_in(packet.direction) {
        None => vec![Vec::new()],
        Some(format) => values(author, row, format),
    };
    let of = |data: Vec<u8>| Packet { data: data.into(), ..packet.clone() };
    let of_models = all.into_iter().map(of).flat_map(|packet| of_each_model(author, &packet));
    of_models.collect()
}

/// A packet with each model that matters.
pub(super) fn of_each_model<'a>(author: Author<'a>, packet: &Packet) -> Vec<Said<'a>> {
    let innfos = tables::rows(author);
    let Some(row) = innfos.command(packet.command) else { return Vec::new() };
    let models = innfos.actuators.rows.iter().filter(|row| MODELS.contains(&row.name.as_str()));
    let is_relative = row.full_scale.is_some() && row.format_in(packet.direction) == row.format;
    let models: Vec<_> = if is_relative { models.map(Some).collect() } else { vec![None] };
    let said = |actuator| Said { packet: packet.clone(), row, actuator };
    let meant = models.into_iter().map(said).filter(|said| said.meaning(author).is_some());
    meant.collect()
}

/// The data to try: the ends, both signs, bytes that differ, and every name.
fn values(author: Author<'_>, row: &Command, format: Format) -> Vec<Vec<u8>> {
    let innfos = tables::rows(author);
    let of = |all: &[&[u8]]| all.iter().map(|data| data.to_vec()).collect();
    match format {
        Format::Flag => of(&[&[0], &[1]]),
        Format::Mode => innfos.modes.rows.iter().map(|row| vec![row.code]).collect(),
        Format::Alarms => {
            let bits = (0..u16::BITS).map(|bit| 1_u16 << bit);
            [0, 0x0005, 0x07FF].into_iter().chain(bits).map(|it| it.to_be_bytes().into()).collect()
        }
        // No bandwidth is negative.
        Format::Iq8 if row.unit.as_deref() == Some("Hz") => {
            of(&[&[0x00, 0x01], &[0x01, 0x00], &[0x12, 0x34], &[0x7F, 0xFF]])
        }
        Format::Iq8 => {
            let bytes: [&[u8]; 5] =
                [&[0x01, 0x00], &[0x12, 0x34], &[0x7F, 0xFF], &[0x80, 0x00], &[0xFF, 0xFF]];
            of(&bytes)
        }
        Format::Iq24 if is_unspecified(author, row, Some(format)) => of(&[&[0x00, 0x80, 0, 0]]),
        // Binary fractions of a full scale, so that no rounding matters.
        Format::Iq24 if row.full_scale.is_some() => {
            of(&[&[0x00, 0x80, 0, 0], &[0x01, 0, 0, 0], &[0xFF, 0, 0, 0], &[0xFF, 0xC0, 0, 0]])
        }
        Format::Iq24 => of(&[
            &[0x01, 0, 0, 0],
            &[0xFE, 0, 0, 0],
            &[0x00, 0x12, 0x34, 0x56],
            &[0x80, 0, 0, 0],
            &[0x7F, 0xFF, 0xFF, 0xFF],
            &[0xFF, 0xFF, 0xFF, 0xFF],
        ]),
        Format::Scaled => of(&[&[0; 4], &[0, 0, 0x0B, 0xC1], &[0, 0x12, 0x34, 0x56]]),
        Format::Mac => Vec::new(),
    }
}

/// Whether the document leaves the scale or the unit of a command's numbers unspecified: a speed is
/// a fraction of the model's full scale or of 6000 RPM, and some rows have no unit.
fn is_unspecified(author: Author<'_>, row: &Command, format: Option<Format>) -> bool {
    let is_number = matches!(format, Some(Format::Iq8 | Format::Iq24 | Format::Scaled));
    is_number
        && author.spec.depends_on_open(&row.errata)
        && (row.unit.is_none() || row.full_scale == Some(FullScale::MotorSpeed))
}

impl Said<'_> {
    fn meaning(&self, author: Author<'_>) -> Option<Meaning> {
        reference::meaning(tables::rows(author), &self.packet, self.actuator)
    }

    /// Whether no other packet says the same: several alarms share a name.
    fn has_one_packet(&self, author: Author<'_>) -> bool {
        let meaning = self.meaning(author);
        let packet = meaning.and_then(|meaning| {
            reference::packet(tables::rows(author), &meaning.message, self.actuator)
        });
        packet.as_ref() == Some(&self.packet)
    }

    /// The requirement on what the packet says.
    pub(super) fn requirement(&self) -> &'static str {
        let Packet { direction, data, .. } = &self.packet;
        let row = self.row;
        match row.format_in(*direction) {
            _ if **data == [0x00, 0x12, 0x34, 0x56] || **data == [0x12, 0x34] => {
                "innfos.value.byte-order"
            }
            None => "innfos.frame.no-data",
            Some(Format::Flag) => match (direction, row.operation) {
                (Direction::Reply, Operation::Write) => "innfos.write.result",
                _ => "innfos.flag.values",
            },
            Some(Format::Mode) => "innfos.mode.values",
            Some(Format::Alarms) if data.first().is_some_and(|high| *high > 0x07) => {
                "innfos.alarms.other"
            }
            Some(Format::Alarms | Format::Mac) => "innfos.alarms.bits",
            Some(Format::Iq8) => "innfos.value.iq8",
            Some(Format::Scaled) => "innfos.value.stall-energy",
            Some(Format::Iq24) if row.full_scale == Some(FullScale::Current) => {
                "innfos.value.relative"
            }
            Some(Format::Iq24) if row.unit.as_deref() == Some("R") => "innfos.value.position",
            Some(Format::Iq24) => "innfos.value.iq24",
        }
    }

    /// The packet that is read, and built if no other says the same.
    pub(super) fn checks(&self, author: Author<'_>, stem: &str, requirement: &str) -> Vec<Check> {
        let Some(meaning) = self.meaning(author) else { return Vec::new() };
        let both = self.has_one_packet(author);
        let format = self.row.format_in(self.packet.direction);
        let demands = if is_unspecified(author, self.row, format) {
            self.recorded(author, &meaning)
        } else {
            self.demanded(&meaning)
        };
        let questions = self.questions(author, &meaning);
        let asked = BOTH.into_iter().zip(questions).zip(demands);
        let check = |((name, question), demand)| {
            author.check(format!("{stem}{name}"), requirement, question, demand)
        };
        asked.take(if both { 2 } else { 1 }).map(check).collect()
    }

    fn questions(&self, author: Author<'_>, meaning: &Meaning) -> [Question; 2] {
        let Meaning { message, form, .. } = meaning;
        let frame = Told::Frame { direction: message.direction, bytes: self.frame().into() };
        let message = match (&message.value, self.row.format) {
            (Some(Value::Number(number)), Some(Format::Scaled)) => {
                Message { value: Some(off_whole(*number, meaning.step)), ..message.clone() }
            }
            _ => message.clone(),
        };
        let actuator = self.actuator.map(|model| model.name.clone());
        [frame, Told::Message { message }].map(|told| {
            let (wire, form, actuator) = (author.wire, form.clone(), actuator.clone());
            Question::Message { wire, form, actuator, told }
        })
    }

    fn frame(&self) -> Vec<u8> {
        reference::encode(&self.packet).unwrap_or_default()
    }

    fn demanded(&self, meaning: &Meaning) -> [Demand; 2] {
        let output = Output::Message(meaning.message.clone());
        let read = match half(meaning.step) {
            Some(within) => Demand::Near { output, within },
            None => Demand::Yield(output),
        };
        [read, Demand::Yield(Output::Bytes(self.frame().into()))]
    }

    /// Numbers in a scale that the document leaves unspecified.
    fn recorded(&self, author: Author<'_>, meaning: &Meaning) -> [Demand; 2] {
        let innfos = tables::rows(author);
        let of_all =
            self.actuator.map(|model| Actuator { motor_speed: SPEED_OF_ALL, ..model.clone() });
        let (question, scales) = match &of_all {
            None => ("What is a number without a unit?", vec![("an IQ24 number", None)]),
            Some(of_all) => {
                let of_model = ("a fraction of the model's full scale", self.actuator);
                let of_all = ("a fraction of 6000 RPM", Some(of_all));
                ("What is a speed?", vec![of_model, of_all])
            }
        };
        let read = scales.iter().filter_map(|(name, scale)| {
            let meaning = reference::meaning(innfos, &self.packet, *scale)?;
            Some((*name, Output::Message(meaning.message)))
        });
        let built = scales.iter().filter_map(|(name, scale)| {
            let packet = reference::packet(innfos, &meaning.message, *scale)?;
            Some((*name, Output::Bytes(reference::encode(&packet)?.into())))
        });
        [Demand::record(question, read), Demand::record(question, built)]
    }
}

/// Half a step; `None` for what is no number.
fn half(step: Number) -> Option<Number> {
    let step = f64::from(step);
    (step > 0.0).then(|| Number::try_from(step / 2.0).ok()).flatten()
}

/// A number a quarter of a step above: rounded or cut off, it gives the same whole number. Its
/// factor is no binary fraction, so the product would lie a little above or below.
fn off_whole(number: Number, step: Number) -> Value {
    let above = f64::from(number) + f64::from(step) / 4.0;
    Value::Number(Number::try_from(above).unwrap_or(number))
}
