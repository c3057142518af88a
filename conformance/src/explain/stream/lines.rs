//! A stream for programs: an object on each line.

use std::collections::BTreeMap;
use std::time::Duration;

use actucheck_spec::model::HexBytes;
use actucheck_spec::schema::of_written;
use actucheck_spec::wire::{Direction, Packet, Wire};
use schemars::JsonSchema;
use serde::Serialize;

use super::{Event, Heard, Place, Role, Summary, Turn};
use crate::capture::Form;
use crate::explain::mistake::Fit;
use crate::explain::{Asked, Row, Warning, explain};

/// Version of the lines. It changes when a field is removed or gets another meaning.
pub const VERSION: u32 = 1;

/// A line.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(tag = "line", rename_all = "kebab-case")]
pub enum Line {
    /// The first line.
    Header {
        /// Version of the lines.
        version: u32,
        /// The form that the input was read in, as `--input` names it; `bus` if it is no input, but what
        /// passes on a virtual bus.
        form: &'static str,
        /// The wire.
        wire: Wire,
    },
    /// A port of a virtual bus.
    Port {
        /// `pty`, `tcp` or `udp`.
        kind: &'static str,
        /// Its path or address.
        address: String,
        /// The symbolic link that leads to it; null if there is none.
        link: Option<String>,
    },
    /// A packet.
    Packet(Box<Said>),
    /// Bytes that are no packet.
    Skipped {
        /// Where they begin.
        #[serde(flatten)]
        place: Where,
        /// Which way they went; null if that is not known.
        direction: Option<Direction>,
        /// How many there are.
        count: u64,
        /// The first of them: all, unless there are very many.
        bytes: HexBytes,
        /// Why no packet begins there.
        reason: String,
        /// What else is known about them.
        notes: Vec<String>,
        /// The mistakes that may explain them, the likeliest first. None is certain.
        fits: Vec<Fit>,
        /// Their fields as far as they can be read, if they begin like a packet and fields are shown.
        #[serde(skip_serializing_if = "Option::is_none")]
        fields: Option<Vec<Column>>,
    },
    /// Devices that did not answer.
    Silent {
        /// Where the request begins.
        to: u64,
        /// The request's name.
        name: &'static str,
        /// The devices.
        devices: Vec<u8>,
    },
    /// What the input says, such as a framing error.
    Note {
        /// How many bytes are before it.
        at: u64,
        /// The text.
        note: String,
    },
    /// The last line.
    Summary {
        /// Packets by the word for their kind.
        packets: BTreeMap<&'static str, u64>,
        /// Bytes that are no packet, by reason.
        skipped: BTreeMap<String, Runs>,
        /// The devices that packets were for or from.
        devices: Vec<Seen>,
        /// Warnings, by the id of the requirement.
        warnings: BTreeMap<&'static str, u64>,
        /// Requests that came twice in a row.
        echoes: u64,
        /// Packets that are not valid as answers to their requests.
        wrong: u64,
        /// Answers that did not come.
        silent: u64,
        /// Times to answer; null if there is none.
        answers: Option<Times>,
    },
}

/// A place in the input.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Where {
    /// How many bytes are before it.
    at: u64,
    /// The line of the input, from 1; null if it has no lines.
    input_line: Option<u64>,
    /// Its time in seconds; null if the input has no times.
    time: Option<f64>,
}

/// A packet.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Said {
    /// Where it begins.
    #[serde(flatten)]
    place: Where,
    /// Which way it went; null if that is not known.
    direction: Option<Direction>,
    /// Its bytes.
    bytes: HexBytes,
    /// The packet object of the adapter protocol; null if its request is needed to read it, or it
    /// is not valid as an answer to that.
    packet: Option<Packet>,
    /// The word for its kind.
    kind: &'static str,
    /// The packet in a sentence.
    title: Option<String>,
    /// The device that it is for or from; null if that is no single one.
    device: Option<u8>,
    /// The control table of that device, `none` if the user wants none; null if it is not known.
    table: Option<&'static str>,
    /// What it has to do with the packets before it.
    role: Part,
    /// What else is known about it.
    notes: Vec<String>,
    /// What is wrong in its meaning.
    warnings: Vec<Warning>,
    /// Its fields, if they are shown.
    #[serde(skip_serializing_if = "Option::is_none")]
    fields: Option<Vec<Column>>,
}

/// What a packet has to do with those before it.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
#[serde(tag = "is", rename_all = "kebab-case")]
pub enum Part {
    /// It asks.
    Request,
    /// The same bytes as the request before it: an echo, or the request again.
    Echo,
    /// It answers.
    Answer {
        /// Where the request begins.
        to: u64,
        /// The request's name.
        name: &'static str,
        /// Seconds from the end of the request; null if there are no times.
        after: Option<f64>,
    },
    /// It answers a request that is not in the stream.
    Unasked,
    /// The bytes do not tell whether it asks or answers.
    Unknown,
}

/// A field of a packet.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Column {
    /// Its offset in the packet.
    offset: usize,
    /// Its bytes; those that byte stuffing added are in parentheses.
    bytes: String,
    /// Its name.
    field: String,
    /// Its meaning.
    meaning: String,
}

/// Bytes that are no packet, together.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Runs {
    /// How many runs of bytes.
    runs: u64,
    /// How many bytes.
    bytes: u64,
}

/// A device of a stream.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Seen {
    /// Its ID or address.
    id: u8,
    /// Its model number; null if it did not tell.
    model: Option<u16>,
}

/// Times to answer, in seconds.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Times {
    /// How many there are.
    count: u64,
    /// The shortest.
    shortest: f64,
    /// The longest.
    longest: f64,
    /// The average.
    average: f64,
}

impl Line {
    /// The first line, of an input in a form or of a virtual bus.
    #[must_use]
    pub fn header(wire: Wire, form: Option<Form>) -> Self {
        Self::Header { version: VERSION, form: form.map_or("bus", Form::id), wire }
    }

    /// The line of an event, with the fields of a packet or without.
    #[must_use]
    pub fn of(wire: Wire, event: &Event<'_>, fields: bool) -> Self {
        match event {
            Event::Packet(heard, turn) => Self::Packet(Box::new(said(wire, heard, turn, fields))),
            Event::Skipped(skipped) => Self::Skipped {
                place: skipped.place.into(),
                direction: skipped.context.direction,
                count: skipped.count,
                bytes: skipped.bytes.to_vec().into(),
                reason: skipped.reason.clone(),
                notes: skipped.notes.clone(),
                fits: skipped.fits(wire),
                fields: Some(skipped.fields(wire))
                    .filter(|rows| fields && !rows.is_empty())
                    .map(|rows| rows.into_iter().map(Column::from).collect()),
            },
            Event::Silent(silent) => {
                Self::Silent { to: silent.to, name: silent.name, devices: silent.devices.clone() }
            }
        }
    }

    /// The last line.
    #[must_use]
    pub fn summary(summary: &Summary) -> Self {
        let answers = &summary.answers;
        let times = || Times {
            count: answers.count,
            shortest: answers.shortest.as_secs_f64(),
            longest: answers.longest.as_secs_f64(),
            average: answers.average().as_secs_f64(),
        };
        let runs = |(reason, (runs, bytes)): (&String, &(u64, u64))| {
            (reason.clone(), Runs { runs: *runs, bytes: *bytes })
        };
        let seen = |(id, model)| Seen { id, model };
        Self::Summary {
            packets: summary.packets.iter().copied().collect(),
            skipped: summary.skipped.iter().map(runs).collect(),
            devices: summary.devices.iter().map(seen).collect(),
            warnings: summary.warnings.clone(),
            echoes: summary.echoes,
            wrong: summary.wrong,
            silent: summary.silent,
            answers: (answers.count > 0).then(times),
        }
    }
}

impl From<Place> for Where {
    fn from(place: Place) -> Self {
        let time = place.time.as_ref().map(Duration::as_secs_f64);
        Self { at: place.at, input_line: place.line, time }
    }
}

impl From<Row> for Column {
    fn from(row: Row) -> Self {
        let Row { offset, bytes, field, meaning } = row;
        Self { offset, bytes, field, meaning }
    }
}

impl From<Role> for Part {
    fn from(role: Role) -> Self {
        match role {
            Role::Request => Self::Request,
            Role::Echo => Self::Echo,
            Role::Answer { to, name, after } => {
                Self::Answer { to, name, after: after.as_ref().map(Duration::as_secs_f64) }
            }
            Role::Unasked => Self::Unasked,
            Role::Unknown => Self::Unknown,
        }
    }
}

fn said(wire: Wire, heard: &Heard<'_>, turn: &Turn, fields: bool) -> Said {
    let (context, tables, address) = (turn.context.clone(), &turn.tables, turn.address);
    let packet = wire.decode(heard.bytes, &context).ok();
    let asked = Asked { bytes: heard.bytes, context, tables, address };
    let explanation = explain(wire, &asked).ok();
    let (title, rows) = explanation.map(|shown| (shown.title, shown.rows)).unzip();
    let fields =
        rows.filter(|_| fields).map(|rows: Vec<Row>| rows.into_iter().map(Column::from).collect());
    Said {
        place: heard.place.into(),
        direction: heard.direction,
        bytes: heard.bytes.to_vec().into(),
        packet,
        kind: turn.kind,
        title,
        device: turn.device,
        table: turn.device.and_then(|id| tables.of(id)).map(|table| table.id),
        role: turn.role.into(),
        notes: turn.notes.clone(),
        warnings: turn.warnings.clone(),
        fields,
    }
}

/// The lines' JSON Schema, with its name.
#[must_use]
pub fn schema() -> (&'static str, String) {
    ("stream", of_written::<Line>())
}
