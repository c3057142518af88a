//! Questions that the document leaves unspecified. The answers are not judged; they are the
//! subject's profile.

use actucheck_spec::model::Fault;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::{Packet, reference};

use super::{BEHIND, LENGTH, decode, encode, stream, tables};
use crate::adapter::Output;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::Family;
use crate::suite::{Author, changed};

/// The most data, in bytes, that a length allows.
const LARGEST: usize = 65_535;

/// Questions about packets in this direction. `limit` is the size of the longest frame that
/// the subject states to take.
pub(super) fn family(author: Author<'_>, direction: Direction, limit: Option<usize>) -> Family<'_> {
    Family::of(format!("innfos.open.{direction}."), move || {
        let mut checks = behind_damage(&author, direction);
        checks.extend(two_frames(&author, direction));
        let strangers = match direction {
            Direction::Request => strange_requests(),
            Direction::Reply => strange_replies(),
        };
        let strangers = strangers.into_iter().chain(long(direction, limit));
        checks.extend(strangers.flat_map(|stranger| strange(&author, direction, &stranger)));
        if direction == Direction::Reply {
            checks.push(short_reply_with_crc(&author));
        }
        checks
    })
}

/// What reading these bytes must yield, and the requirement that says so.
pub(super) fn reading(
    author: &Author<'_>,
    direction: Direction,
    bytes: &[u8],
) -> (&'static str, Demand) {
    let found = reference::packets_anywhere(direction, bytes);
    match (reference::decode(direction, bytes), found.into_iter().next()) {
        (Ok(packet), _) if reference::is_in_tables(tables::rows(*author), &packet) => {
            // The CRC covers the data alone: a changed address or command is not noticed.
            ("innfos.frame.layout", Demand::Yield(Output::Packet(packet.into())))
        }
        (Ok(packet), _) => {
            let question = "Is a packet read that is in no table?";
            ("innfos.frame.layout", read_or_not(question, packet))
        }
        (Err(_), Some(packet)) => {
            let question = "Is a frame read with other bytes before or after it?";
            ("innfos.frame.layout", read_or_not(question, packet))
        }
        (Err(fault), None) => (requirement_of(fault), Demand::Reject(fault)),
    }
}

fn requirement_of(fault: Fault) -> &'static str {
    match fault {
        Fault::Header => "innfos.frame.header",
        Fault::Tail => "innfos.frame.tail",
        Fault::Crc => "innfos.crc.verify",
        _ => "innfos.frame.length",
    }
}

fn read_or_not(question: &str, packet: Packet) -> Demand {
    Demand::record(question, [("reads it", Output::Packet(packet.into()))])
}

/// A packet with data, to be damaged or to stand after damage.
pub(super) fn example(direction: Direction) -> Packet {
    let data = vec![0x01, 0x02, 0x03, 0x04].into();
    let command = match direction {
        Direction::Request => 0x0A,
        Direction::Reply => 0x06,
    };
    Packet { direction, address: 6, command, data }
}

/// A valid frame after other bytes in one datagram.
fn behind_damage(author: &Author<'_>, direction: Direction) -> Vec<Check> {
    let good = reference::encode(&example(direction)).unwrap_or_default();
    let flipped = |at: usize| changed(&good, at, |byte| byte ^ 1);
    let cut = good.get(..good.len() - 1).unwrap_or_default().to_vec();
    let scenarios = [
        ("garbage", vec![0x00, 0x01]),
        ("wrong-header", flipped(0)),
        ("wrong-length", flipped(LENGTH + 1)),
        ("wrong-crc", flipped(good.len() - 2)),
        ("wrong-tail", flipped(good.len() - 1)),
        ("cut", cut),
    ];
    let check = |(name, damage): (&str, Vec<u8>)| {
        let datagram = [damage, good.clone()].concat();
        let ways = [
            ("it is found", reference::packets_anywhere(direction, &datagram)),
            (
                "the datagram is dropped from the damage on",
                reference::packets(direction, &datagram),
            ),
        ];
        let ways = ways.map(|(name, packets)| (name, Output::packets(packets)));
        let question = format!(
            "What becomes of a good frame in a datagram behind {}?",
            name.replace('-', " ")
        );
        let id = format!("innfos.open.{direction}.behind-{name}/stream");
        let op = stream(author, direction, vec![datagram]);
        author.check(id, "innfos.frame.layout", op, Demand::record(&question, ways))
    };
    scenarios.map(check).into()
}

/// Two valid frames in one datagram.
fn two_frames(author: &Author<'_>, direction: Direction) -> Vec<Check> {
    let packets = tables::of_each_size(direction).iter();
    let packets = packets.filter_map(|code| tables::of_command(*author, direction, *code));
    let check = |packet: Packet| {
        let frame = reference::encode(&packet).unwrap_or_default();
        let op = stream(author, direction, vec![[frame.as_slice(), &frame].concat()]);
        let times = |count| Output::packets(vec![packet.clone(); count]);
        let ways = [("finds both", 2), ("finds the first", 1), ("finds neither", 0)];
        let ways = ways.map(|(name, count)| (name, times(count)));
        let id = format!("innfos.open.{direction}.two-frames.size-{}/stream", packet.data.len());
        let question = "What becomes of two good frames in a datagram?";
        author.check(id, "innfos.frame.layout", op, Demand::record(question, ways))
    };
    packets.map(check).collect()
}

/// A packet that the document's tables do not have.
struct Stranger {
    /// The end of its checks' ids.
    name: String,
    /// What is strange about it.
    with: &'static str,
    address: u8,
    command: u8,
    data: Vec<u8>,
}

impl Stranger {
    fn new(name: &str, with: &'static str, command: u8, data: &[u8]) -> Self {
        Self { name: name.to_owned(), with, address: 6, command, data: data.to_vec() }
    }
}

const COMMAND: &str = "a command that no table has";
const SIZE: &str = "another size of data than its command has";
const FLAG: &str = "a flag that is neither 0 nor 1";

fn strange_requests() -> Vec<Stranger> {
    vec![
        Stranger::new("command-01", COMMAND, 0x01, &[]),
        Stranger::new("command-80", COMMAND, 0x80, &[1, 2]),
        Stranger::new("command-fd", COMMAND, 0xFD, &[1, 2, 3, 4]),
        Stranger::new("size-2-of-06", SIZE, 0x06, &[1, 2]),
        Stranger::new("size-4-of-06", SIZE, 0x06, &[1, 2, 3, 4]),
        Stranger::new("size-0-of-2a", SIZE, 0x2A, &[]),
        Stranger::new("size-2-of-2a", SIZE, 0x2A, &[0, 1]),
        Stranger::new("size-3-of-0a", SIZE, 0x0A, &[1, 2, 3]),
        Stranger::new("size-256-of-0a", SIZE, 0x0A, &[0x5A; 256]),
        Stranger::new("flag-02", FLAG, 0x2A, &[0x02]),
        Stranger::new("flag-ed", FLAG, 0x2A, &[0xED]),
        Stranger::new("flag-ee", FLAG, 0x2A, &[0xEE]),
        Stranger::new("mode-0", "the mode 0", 0x07, &[0]),
        Stranger::new("mode-9", "the mode 9", 0x07, &[9]),
        Stranger::new("address-6-of-44", "the board's command and another address", 0x44, &[]),
    ]
}

fn strange_replies() -> Vec<Stranger> {
    let from_0 =
        Stranger::new("address-0-of-06", "an actuator's command and address 0", 0x06, &[0; 4]);
    vec![
        Stranger::new("command-01", COMMAND, 0x01, &[1]),
        Stranger::new("command-80", COMMAND, 0x80, &[1, 2]),
        Stranger::new("command-fd", COMMAND, 0xFD, &[1, 2, 3, 4]),
        Stranger::new("size-0-of-06", SIZE, 0x06, &[]),
        Stranger::new("size-2-of-06", SIZE, 0x06, &[1, 2]),
        Stranger::new("size-4-of-2a", SIZE, 0x2A, &[0, 0, 0, 1]),
        Stranger::new("size-256-of-06", SIZE, 0x06, &[0x5A; 256]),
        Stranger::new("answer-to-0a", "the answer to a command that has none", 0x0A, &[1]),
        Stranger::new("flag-02", FLAG, 0x2B, &[0x02]),
        Stranger::new("flag-ed", FLAG, 0x2B, &[0xED]),
        Stranger::new("flag-ee", FLAG, 0x2B, &[0xEE]),
        Stranger { address: 0, ..from_0 },
    ]
}

/// As much data as the subject takes; no row has so much.
fn long(direction: Direction, limit: Option<usize>) -> Option<Stranger> {
    let size = limit?.checked_sub(reference::PREFIX + BEHIND)?.min(LARGEST);
    let Packet { command, .. } = example(direction);
    let name = format!("size-{size}-of-{command:02x}");
    (size > 256).then(|| Stranger::new(&name, SIZE, command, &vec![0x5A; size]))
}

/// A strange packet that is to be built and to be read.
fn strange(author: &Author<'_>, direction: Direction, stranger: &Stranger) -> [Check; 2] {
    let Stranger { name, with, address, command, data } = stranger;
    let packet =
        Packet { direction, address: *address, command: *command, data: data.clone().into() };
    let frame = reference::encode(&packet).unwrap_or_default();
    let read = decode(author, direction, &frame);
    let packet = packet.into();
    let build = encode(author, &packet);
    let asked = [
        ("built", "builds it", build, Output::Bytes(frame.into())),
        ("read", "reads it", read, Output::Packet(packet)),
    ];
    asked.map(|(verb, way, op, output)| {
        let id = format!("innfos.open.{direction}.{name}/{}", op.name());
        let question = format!("A {direction} with {with}: is it {verb}?");
        author.check(id, "innfos.frame.layout", op, Demand::record(&question, [(way, output)]))
    })
}

/// The format of a frame has a CRC wherever there is data, but the printed replies with one byte
/// have none.
fn short_reply_with_crc(author: &Author<'_>) -> Check {
    let direction = Direction::Reply;
    let packet = Packet { direction, address: 6, command: 0x2A, data: vec![1].into() };
    let with_crc = Packet { direction: Direction::Request, ..packet.clone() };
    let frame = reference::encode(&with_crc).unwrap_or_default();
    let op = decode(author, direction, &frame);
    let demand = read_or_not("Is a reply with one byte of data and its CRC read?", packet);
    author.check(
        "innfos.open.reply.crc-of-one-byte/decode".to_owned(),
        "innfos.crc.reply",
        op,
        demand,
    )
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests may stop at a surprise

    use super::*;
    use actucheck_spec::Spec;

    #[test]
    fn strangers_are_in_no_table() {
        let spec = Spec::embedded().unwrap();
        let innfos = &spec.wires.innfos.content;
        let of = [(Direction::Request, strange_requests()), (Direction::Reply, strange_replies())];
        for (direction, strangers) in of {
            for Stranger { name, address, command, data, .. } in strangers {
                let packet = Packet { direction, address, command, data: data.into() };
                assert!(!reference::is_in_tables(innfos, &packet), "{name}");
            }
        }
    }
}
