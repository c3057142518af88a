//! What is written is told again, and what is not answered. With the power off nothing comes of a value, and
//! nothing is stored but by the command that stores.

use actucheck_spec::Spec;
use actucheck_spec::wire::innfos::{Command, Format, Operation};

use super::{Talk, asked, code, with_data};
use crate::adapter::{Asked, Bits, Permission, Permissions};
use crate::journal::Place;
use crate::suite::check::Check;
use crate::suite::wanted::{Like, Part};

/// The power of the motor, and its mode, which no check of values writes.
pub(super) const POWER: &str = "Power state";
const MODE: &str = "Mode";
/// Above every temperature at which a board works: 80.5 and 100.0 °C, low bits of both bytes among them.
const TWO_BYTES: [[u8; 2]; 2] = [[0x50, 0x80], [0x64, 0x00]];
/// 0.25 and 0.5, and what is as far below zero.
const POSITIVE: [[u8; 4]; 2] = [[0x00, 0x40, 0x00, 0x00], [0x00, 0x80, 0x00, 0x00]];
const NEGATIVE: [[u8; 4]; 2] = [[0xFF, 0xC0, 0x00, 0x00], [0xFF, 0x80, 0x00, 0x00]];
/// The ends of what a gain may be.
const GAINS: [[u8; 4]; 2] = [[0x80, 0x00, 0x00, 0x00], [0x7F, 0xFF, 0xFF, 0xFF]];
/// 40 J and 80 J, times 75.225.
const ENERGIES: [[u8; 4]; 2] = [[0x00, 0x00, 0x0B, 0xC1], [0x00, 0x00, 0x17, 0x82]];

/// A step, and what must come back.
type Step = (Asked, Vec<Vec<Like>>);

/// The commands that write a value, and those that read it.
pub(super) fn pairs(spec: &Spec) -> impl Iterator<Item = (&Command, &Command)> {
    let commands = &spec.wires.innfos.content.commands;
    let writes = commands.iter().filter(|row| {
        row.operation == Operation::Write && row.request > 0 && !row.reply.is_empty()
    });
    writes.filter_map(|write| {
        let is_its = |row: &&Command| row.operation == Operation::Read && row.name == write.name;
        Some((write, commands.iter().find(is_its)?))
    })
}

/// The values that are kept while an actuator is written to: each with the command that writes it in the high
/// byte of its number, and the command that reads it in the low one. The first is whether the motor has power.
pub(in crate::suite::device) fn kept(spec: &Spec) -> Vec<Place> {
    let place = |(write, read): (&Command, &Command)| Place {
        name: write.name.clone(),
        address: u16::from_be_bytes([write.code, read.code]),
        size: write.request,
    };
    let mut places: Vec<_> =
        pairs(spec).filter(|(write, _)| write.name != MODE).map(place).collect();
    places.sort_by_key(|place| place.name != POWER);
    places
}

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let pairs =
        pairs(talk.author.spec).filter(|(write, _)| write.name != POWER && write.name != MODE);
    let values = pairs.filter_map(|(write, read)| of_pair(talk, write, read));
    values.chain(byte_order(talk)).chain(with_crc(talk)).collect()
}

/// Goals, which nobody answers, and commands without data, which are.
pub(super) fn commands(talk: &Talk<'_>) -> Vec<Check> {
    let goals = code::GOALS.map(|command| {
        let step = talk.packet_then_hello(with_data(talk.id(), command, &[0; 4]));
        talk.demands(
            [Permission::WriteRam, Permission::Motion].into(),
            &format!("command.{command:02x}/silence"),
            "innfos.reply.always",
            vec![(step, vec![vec![talk.alive()]])],
        )
    });
    let finished = [(code::CLEAR_ALARMS, Permission::Reboot), (code::SAVE, Permission::Eeprom)];
    let finished = finished.map(|(command, needs)| {
        let step = (asked(talk.ask(command), 1), vec![vec![done(talk, command)]]);
        talk.demands(
            [needs].into(),
            &format!("command.{command:02x}/answer"),
            "innfos.write.result",
            vec![no_alarm(talk), step],
        )
    });
    goals.into_iter().chain(finished).collect()
}

/// Nothing works while there is an alarm.
pub(super) fn no_alarm(talk: &Talk<'_>) -> Step {
    let what = "an actuator without an alarm".to_owned();
    // The command comes before the two bytes of the alarms.
    let has = Bits { lowest: 8, width: 16, one_of: vec![0] };
    let none = Part::Given { what, size: 3, has: has.clone() };
    let answer = Like { id: talk.id(), error: None, data: Some(vec![none]) };
    let step = Asked { only_if: Some(has), ..asked(talk.ask(code::ALARMS), 1) };
    (step, vec![vec![answer]])
}

pub(super) fn done(talk: &Talk<'_>, command: u8) -> Like {
    talk.answer(command, vec![Part::Bytes(vec![super::YES].into())])
}

fn sets(talk: &Talk<'_>, write: &Command, value: &[u8]) -> Step {
    let packet = with_data(talk.id(), write.code, value);
    (asked(packet, 1), vec![vec![done(talk, write.code)]])
}

fn tells(talk: &Talk<'_>, read: &Command, value: &[u8]) -> Step {
    let answer = talk.answer(read.code, vec![Part::Bytes(value.to_vec().into())]);
    (asked(talk.ask(read.code), 1), vec![vec![answer]])
}

/// Two values of a command, and the requirement that says that they are told again; `None` of one whose values do
/// something.
pub(super) fn values(write: &Command) -> Option<(&'static str, Vec<Vec<u8>>)> {
    let is_lower = write.name.contains("lower");
    let is_gain = write.name.ends_with(" P") || write.name.ends_with(" I");
    Some(match write.format? {
        Format::Flag => ("innfos.write.result", vec![vec![1], vec![0]]),
        Format::Iq8 => ("innfos.value.iq8", TWO_BYTES.map(Vec::from).into()),
        Format::Scaled => ("innfos.write.sizes", ENERGIES.map(Vec::from).into()),
        Format::Iq24 if is_gain => ("innfos.value.gain", GAINS.map(Vec::from).into()),
        Format::Iq24 => {
            let is_output = write.name.contains("loop output");
            let row = if is_output { "innfos.value.output-limit" } else { "innfos.value.iq24" };
            (row, if is_lower { NEGATIVE } else { POSITIVE }.map(Vec::from).into())
        }
        Format::Mode | Format::Alarms | Format::Mac => return None,
    })
}

/// Two values of a command, there and back.
fn of_pair(talk: &Talk<'_>, write: &Command, read: &Command) -> Option<Check> {
    let (requirement, values) = values(write)?;
    let both = values.iter().flat_map(|value| [sets(talk, write, value), tells(talk, read, value)]);
    let steps = [no_alarm(talk)].into_iter().chain(both).collect();
    let ram = Permissions::from([Permission::WriteRam]);
    Some(talk.demands(ram, &format!("written.{:02x}/kept", write.code), requirement, steps))
}

/// A protection temperature of 80 °C, which with its bytes swapped is a third of a degree, raises no alarm.
fn byte_order(talk: &Talk<'_>) -> Option<Check> {
    let (write, _) = pairs(talk.author.spec).find(|(write, _)| write.code == code::PROTECTION)?;
    let none = talk.answer(code::ALARMS, vec![Part::Bytes(vec![0, 0].into())]);
    let steps = vec![
        no_alarm(talk),
        sets(talk, write, &[0x50, 0x00]),
        (asked(talk.ask(code::ALARMS), 1), vec![vec![none]]),
    ];
    let ram = Permissions::from([Permission::WriteRam]);
    Some(talk.demands(ram, "written.byte-order/no-alarm", "innfos.value.byte-order", steps))
}

/// A request with a single byte has a CRC.
fn with_crc(talk: &Talk<'_>) -> Option<Check> {
    let mut flags = pairs(talk.author.spec)
        .filter(|(write, _)| write.format == Some(Format::Flag) && write.name != POWER);
    let (write, read) = flags.next()?;
    let steps = vec![no_alarm(talk), sets(talk, write, &[1]), tells(talk, read, &[1])];
    let ram = Permissions::from([Permission::WriteRam]);
    Some(talk.demands(ram, "written.crc-of-a-byte/kept", "innfos.crc.request", steps))
}
