//! Each command that reads, and commands and data that there are not.

use actucheck_spec::wire::innfos::{Command, Format, Operation};

use super::{FLAGS, Talk, asked, bytes_of, code, with_data};
use crate::adapter::Bits;
use crate::suite::check::Check;
use crate::suite::codec::innfos::tables;
use crate::suite::wanted::Part;

/// The modes of Appendix B.
const MODES: std::ops::RangeInclusive<u64> = 1..=8;
/// 1.0 as a value of four bytes.
const WHOLE: i64 = 1 << 24;
/// Codes that no table has.
const UNKNOWN: [u8; 4] = [0x01, 0x03, 0x40, 0xC0];
/// Commands that only write, whose data is missing here.
const WITHOUT_DATA: [u8; 3] = [0x07, 0x0A, 0x61];

const MEANING: &str = "innfos.tables.meaning";
const SIZES: &str = "innfos.read.sizes";

/// The size of each answer, and what it may hold.
pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let rows = tables::rows(talk.author).commands.iter();
    let reads = rows.filter(|row| row.operation == Operation::Read);
    // The board has these, and the basic check has the sign of life.
    let others = [code::HANDSHAKE, code::QUERY, code::SIGN_OF_LIFE];
    let own = reads.filter(|row| !others.contains(&row.code));
    own.flat_map(|row| of_row(talk, row)).collect()
}

/// Whether an erratum says which of two texts tells what the command is about.
fn has_two_texts(talk: &Talk<'_>, row: &Command) -> bool {
    let meaning = talk.author.spec.requirement(MEANING);
    meaning.is_some_and(|meaning| meaning.errata.iter().any(|id| row.errata.contains(id)))
}

fn of_row(talk: &Talk<'_>, row: &Command) -> Vec<Check> {
    let answered = |about: &str, (requirement, part): (&str, Part)| {
        let name = format!("read.{:02x}/{about}", row.code);
        let wanted = vec![vec![vec![talk.answer(row.code, vec![part])]]];
        talk.check(&name, requirement, vec![asked(talk.ask(row.code), 1)], wanted)
    };
    let size = size(talk, row).map(|due| answered("size", due));
    size.into_iter().chain(value(row).map(|due| answered("value", due))).collect()
}

/// How long the data of an answer is, and the requirement that says so.
pub(super) fn size(talk: &Talk<'_>, row: &Command) -> Option<(&'static str, Part)> {
    let requirement = match row.format {
        Some(Format::Alarms) => "innfos.alarms.bits",
        _ if row.code == code::POSITION => "innfos.reply.always",
        _ if row.code == code::SPEED => "innfos.crc.reply",
        _ if has_two_texts(talk, row) => MEANING,
        _ => SIZES,
    };
    Some((requirement, Part::Any(usize::from(*row.reply.first()?))))
}

/// What the data of an answer may be, and the requirement that says so, if one does.
pub(super) fn value(row: &Command) -> Option<(&'static str, Part)> {
    let one_of =
        |one_of: Vec<u64>| Part::Bits { size: 1, has: Bits { lowest: 0, width: 8, one_of } };
    let relative = || Part::Between { size: 4, lowest: -WHOLE, highest: WHOLE };
    match row.format {
        Some(Format::Flag) => Some(("innfos.flag.values", one_of(FLAGS.to_vec()))),
        Some(Format::Mode) => Some(("innfos.mode.values", one_of(MODES.collect()))),
        _ if row.name == "Current" => Some(("innfos.value.relative", relative())),
        _ if row.name.contains("loop output") => Some(("innfos.value.output-limit", relative())),
        _ => None,
    }
}

/// What the tables do not have, after which the actuator is still there.
pub(super) fn unknown(talk: &Talk<'_>) -> Vec<Check> {
    let unknown = UNKNOWN.map(|command| {
        talk.record(
            &format!("unknown.command-{command:02x}/answer"),
            "innfos.reply.always",
            talk.packet_then_hello(talk.ask(command)),
            &format!("How does it answer the command 0x{command:02X}, which no table has?"),
        )
    });
    let missing = WITHOUT_DATA.map(|command| {
        talk.record(
            &format!("unknown.without-data-{command:02x}/answer"),
            "innfos.write.sizes",
            talk.packet_then_hello(talk.ask(command)),
            &format!("How does it answer the write 0x{command:02X} without its data?"),
        )
    });
    let read = with_data(talk.id(), code::POSITION, &[0]);
    let with_data = talk.record(
        "unknown.read-with-data/answer",
        "innfos.read.sizes",
        talk.packet_then_hello(read.clone()),
        "How does it answer a read that has data?",
    );
    let mut bytes = bytes_of(&read);
    // The first byte of the CRC is behind the data.
    if let Some(byte) = bytes.get_mut(6) {
        *byte ^= 1;
    }
    let damaged = talk.record(
        "unknown.read-with-damaged-data/answer",
        "innfos.crc.verify",
        talk.then_hello(bytes),
        "How does it answer a read that has data with a wrong CRC?",
    );
    unknown.into_iter().chain(missing).chain([with_data, damaged]).collect()
}

/// Sentences about every frame that the answer to a read shows.
pub(super) fn sentences(talk: &Talk<'_>) -> Vec<Check> {
    let sentences = ["packets", "crc.value", "crc.byte-order"].map(|sentence| {
        let answer = talk.answer(code::POSITION, vec![Part::Any(4)]);
        talk.check(
            &format!("sentence.{}/shown", sentence.replace('.', "-")),
            &format!("innfos.{sentence}"),
            vec![asked(talk.ask(code::POSITION), 1)],
            vec![vec![vec![answer]]],
        )
    });
    sentences.into()
}
