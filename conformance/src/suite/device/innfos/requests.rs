//! What must come back after any datagrams that only read, or write where that is allowed, as the document says it of
//! each of them. What it leaves unspecified is not asked.

use std::collections::BTreeMap;

use actucheck_spec::model::Fault;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::reference::{PREFIX, decode, packets_anywhere};
use actucheck_spec::wire::innfos::{Operation, Packet, WIRE};

use super::board::{found, greeted};
use super::{ALL, Talk, asked, changes, code, reads, writes};
use crate::adapter::{Asked, Permission, Permissions, Question};
use crate::suite::Author;
use crate::suite::check::Demand;
use crate::suite::codec::innfos::tables;
use crate::suite::device::Target;
use crate::suite::wanted::{Like, Part, Wanted};

/// The first byte of a frame, and where its command is.
const HEADER: u8 = 0xEE;
const COMMAND: usize = 2;

/// What stays as it is while nobody writes it: by the command that reads it, where it is known from, if it is.
type Held = BTreeMap<u8, Option<Known>>;

/// Where it is known from what a value is.
enum Known {
    /// A step told it.
    Told(usize),
    /// It was written, and this requirement says that it is told again.
    Written(Vec<u8>, &'static str),
}

/// The requirement, the step, and the rows that may answer it.
type Due = (&'static str, Asked, Vec<Vec<Like>>);

/// See [`super::super::conversation`].
pub(in crate::suite::device) fn conversation(
    author: Author<'_>,
    (target, allowed): (&Target<'_>, &Permissions),
    requests: &[Vec<Vec<u8>>],
) -> Option<(String, Question, Demand)> {
    let talk = Talk { author, target: target.clone() };
    let kept = writes::kept(author.spec).into_iter().skip(1);
    let mut held: Held = kept.map(|place| (place.address.to_be_bytes()[1], None)).collect();
    let (mut steps, mut wanted, mut requirement) = (Vec::new(), Vec::new(), None);
    let (may_write, mut needs) = (allowed.has(Permission::WriteRam), Permissions::READ);
    if may_write {
        let (asked, rows) = writes::no_alarm(&talk);
        steps.push(asked);
        wanted.push(Wanted(rows));
    }
    for datagrams in requests {
        // What comes of a frame in two datagrams is unspecified.
        let [datagram] = datagrams.as_slice() else { return None };
        if may_change(&talk, datagram) {
            if !may_write || !is_harmless(&talk, datagram) {
                return None;
            }
            needs = [Permission::WriteRam].into();
        }
        let (name, asked, rows) = due(&talk, datagram, steps.len(), &mut held)?;
        requirement = Some(name);
        steps.push(asked);
        wanted.push(Wanted(rows));
    }
    let question = Question::Device { wire: WIRE, needs, neighbour: None, steps };
    Some((requirement?.to_owned(), question, Demand::Answer(wanted)))
}

/// Whether something in a datagram could be taken for a command that does not only read: at its beginning,
/// whatever its header is, or behind a header anywhere in it.
fn may_change(talk: &Talk<'_>, datagram: &[u8]) -> bool {
    let rows = &tables::rows(talk.author).commands;
    let reads =
        |code: &u8| rows.iter().any(|row| row.code == *code && row.operation == Operation::Read);
    let headers = datagram.windows(COMMAND + 1).filter(|bytes| bytes.starts_with(&[HEADER]));
    let mut commands = headers.filter_map(<[u8]>::last).chain(datagram.get(COMMAND));
    commands.any(|code| !reads(code))
}

/// Whether a datagram is a write that does nothing by itself, and nothing in it could be taken for another.
fn is_harmless(talk: &Talk<'_>, datagram: &[u8]) -> bool {
    let Ok(packet) = decode(Direction::Request, datagram) else { return false };
    let is_hidden = datagram.get(1..).is_some_and(|rest| rest.contains(&HEADER));
    !is_hidden && packet.address != ALL && written(talk, &packet).is_some()
}

/// What a request writes, if it may.
fn written(talk: &Talk<'_>, packet: &Packet) -> Option<changes::Place> {
    let place = changes::place_of(talk.author.spec, packet.command);
    place.filter(|place| place.takes(&packet.data.0))
}

/// What must answer a datagram, if the document says it.
fn due(talk: &Talk<'_>, datagram: &[u8], step: usize, held: &mut Held) -> Option<Due> {
    let packet = match decode(Direction::Request, datagram) {
        Ok(packet) => packet,
        Err(fault) => return damaged(talk, datagram, fault),
    };
    match (packet.address, packet.command) {
        (ALL, code::HANDSHAKE) if packet.data.is_empty() => {
            Some(("innfos.transport.handshake", asked(packet, 1), vec![vec![greeted()]]))
        }
        (ALL, code::QUERY) if packet.data.is_empty() => {
            let present = &talk.target.present;
            Some(("innfos.transport.query", asked(packet, present.len()), found(present)?))
        }
        (ALL, _) => None,
        (id, _) if id == talk.id() => match written(talk, &packet) {
            Some(place) => Some(write(talk, packet, &place, held)),
            None => read(talk, packet, step, held),
        },
        (id, _) if talk.target.present.contains(&id) => None,
        _ => {
            let step = talk.packet_then_hello(packet);
            Some(("innfos.frame.address", step, vec![vec![talk.alive()]]))
        }
    }
}

/// A datagram that is no frame is not answered, and the sign of life after it is.
fn damaged(talk: &Talk<'_>, datagram: &[u8], fault: Fault) -> Option<Due> {
    // Between other bytes a frame may be found or not.
    if !packets_anywhere(Direction::Request, datagram).is_empty() {
        return None;
    }
    let requirement = match fault {
        Fault::Header => "innfos.frame.header",
        // It has no data, and something where the end must be.
        Fault::Tail if datagram.get(3..PREFIX) == Some(&[0, 0]) && datagram.len() > PREFIX + 1 => {
            "innfos.frame.no-data"
        }
        Fault::Tail => "innfos.frame.tail",
        Fault::Crc => return None,
        _ => "innfos.frame.length",
    };
    Some((requirement, talk.then_hello(datagram.to_vec()), vec![vec![talk.alive()]]))
}

/// The answer to a command that writes a value of the actuator.
fn write(talk: &Talk<'_>, packet: Packet, place: &changes::Place, held: &mut Held) -> Due {
    held.insert(place.read, Some(Known::Written(packet.data.0.clone(), place.told)));
    let answer = writes::done(talk, packet.command);
    ("innfos.write.result", asked(packet, 1), vec![vec![answer]])
}

/// The answer to a command that reads from the actuator.
fn read(talk: &Talk<'_>, packet: Packet, step: usize, held: &mut Held) -> Option<Due> {
    let code = packet.command;
    if matches!(code, code::HANDSHAKE | code::QUERY) || !packet.data.is_empty() {
        return None;
    }
    let row = tables::rows(talk.author).command(code)?;
    if code == code::SIGN_OF_LIFE {
        return Some(("innfos.handshake.ready", asked(packet, 1), vec![vec![talk.alive()]]));
    }
    let (mut requirement, mut part) = reads::value(row).or_else(|| reads::size(talk, row))?;
    if let Some(earlier) = held.get_mut(&code) {
        match earlier {
            // Behind the command.
            Some(Known::Told(step)) => {
                part = Part::Same { step: *step, from: 1, count: part.size() };
            }
            Some(Known::Written(data, told)) => {
                (requirement, part) = (*told, Part::Bytes(data.clone().into()));
            }
            None => *earlier = Some(Known::Told(step)),
        }
    }
    let answer = talk.answer(code, vec![part]);
    Some((requirement, asked(packet, 1), vec![vec![answer]]))
}
