//! What must come back after any datagrams that only read, as the document says it of each of them. What it
//! leaves unspecified is not asked.

use std::collections::BTreeMap;

use actucheck_spec::model::Fault;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::reference::{PREFIX, decode, packets_anywhere};
use actucheck_spec::wire::innfos::{Operation, Packet, WIRE};

use super::board::{found, greeted};
use super::{ALL, Talk, asked, code, reads, writes};
use crate::adapter::{Asked, Permissions, Question};
use crate::suite::Author;
use crate::suite::check::Demand;
use crate::suite::codec::innfos::tables;
use crate::suite::device::Target;
use crate::suite::wanted::{Like, Part, Wanted};

/// The first byte of a frame, and where its command is.
const HEADER: u8 = 0xEE;
const COMMAND: usize = 2;

/// What stays as it is while nobody writes it: by the command that reads it, the step that told it, if one did.
type Held = BTreeMap<u8, Option<usize>>;

/// The requirement, the step, and the rows that may answer it.
type Due = (&'static str, Asked, Vec<Vec<Like>>);

/// See [`super::super::conversation`].
pub(in crate::suite::device) fn conversation(
    author: Author<'_>,
    (target, _): (&Target<'_>, &Permissions),
    requests: &[Vec<Vec<u8>>],
) -> Option<(String, Question, Demand)> {
    let talk = Talk { author, target: target.clone() };
    let kept = writes::kept(author.spec).into_iter().skip(1);
    let mut held: Held = kept.map(|place| (place.address.to_be_bytes()[1], None)).collect();
    let (mut steps, mut wanted, mut requirement) = (Vec::new(), Vec::new(), None);
    for (step, datagrams) in requests.iter().enumerate() {
        // What comes of a frame in two datagrams is unspecified.
        let [datagram] = datagrams.as_slice() else { return None };
        if may_change(&talk, datagram) {
            return None;
        }
        let (name, asked, rows) = due(&talk, datagram, step, &mut held)?;
        requirement = Some(name);
        steps.push(asked);
        wanted.push(Wanted(rows));
    }
    let question =
        Question::Device { wire: WIRE, needs: Permissions::READ, neighbour: None, steps };
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
        (id, _) if id == talk.id() => read(talk, packet, step, held),
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
    let (requirement, mut part) = reads::value(row).or_else(|| reads::size(talk, row))?;
    if let Some(earlier) = held.get_mut(&code) {
        match *earlier {
            // Behind the command.
            Some(step) => part = Part::Same { step, from: 1, count: part.size() },
            None => *earlier = Some(step),
        }
    }
    let answer = talk.answer(code, vec![part]);
    Some((requirement, asked(packet, 1), vec![vec![answer]]))
}
