//! What a call may return, whatever datagrams come: the reference model looks for its answers in them.

use actucheck_spec::model::Fault;
use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::{Command, Operation, Packet, reference};

use super::{
    ALWAYS, ECHO, NO_ANSWER, QUERY, TAIL, VERIFY, all, bare, data, found, frame, refused, untold,
};
use crate::adapter::Reported;
use crate::suite::due::Due;

const SIZES: &str = "innfos.read.sizes";
const RESULT: &str = "innfos.write.result";
const TRANSPORT: &str = "innfos.transport.query";
/// What an actuator holds when it is asked again, so that one can tell which answer was taken.
const LATER: [u8; 4] = [0x00, 0xB7, 0x12, 0x94];

/// What must come of a call.
pub(crate) struct Expected {
    pub(crate) due: Due,
    /// The requirement on what came.
    pub(crate) requirement: &'static str,
    /// Whether nothing but right answers came.
    pub(crate) is_clean: bool,
    /// The datagram that comes when the host asks again; empty if none does.
    pub(crate) again: Vec<u8>,
}

/// What must come of the call that sends `asked`, a command of this row, when these datagrams come;
/// `None` if that is unspecified.
pub(crate) fn expected(row: &Command, asked: &Packet, datagrams: &[Vec<u8>]) -> Option<Expected> {
    let Came { right, wrong } = Came::of(row, asked, datagrams)?;
    let is_clean = wrong.is_none() && (row.reply.is_empty() || !right.is_empty());
    let mut due = match (row.operation, right.first()) {
        // It is unspecified what a host does with an answer that there is not.
        _ if row.reply.is_empty() => Some(all([])).filter(|_| datagrams.is_empty())?,
        _ if row.code == QUERY => match (&wrong, right.as_slice()) {
            (None, []) => return None,
            (_, right) => Due { partly: wrong.is_some(), ..all(told(right)) },
        },
        (Operation::Read, None) => {
            let later = later(row, asked)?;
            let due = Due { or: NO_ANSWER.to_vec(), ..all([data(later.address, &later.data)]) };
            let requirement = wrong.unwrap_or(ALWAYS);
            return Some(Expected { due, requirement, is_clean, again: frame(&later) });
        }
        (Operation::Read, Some(answer)) => all([data(answer.address, &answer.data)]),
        // So is what silence means after a write.
        (Operation::Write, None) => wrong.map(|_| untold())?,
        (Operation::Write, Some(Packet { data, .. })) if *data.0 == [0] => refused(),
        (Operation::Write, Some(answer)) => all([bare(answer.address)]),
    };
    if wrong.is_some() {
        due.or.extend(NO_ANSWER);
    }
    let again = match (row.code, right.as_slice()) {
        (QUERY, _) => Vec::new(),
        (_, [answer]) => frame(answer),
        _ => datagrams.first().cloned().unwrap_or_default(),
    };
    let clean = match row.operation {
        _ if row.reply.is_empty() => ALWAYS,
        _ if row.code == QUERY => TRANSPORT,
        Operation::Read => SIZES,
        Operation::Write => RESULT,
    };
    Some(Expected { due, requirement: wrong.unwrap_or(clean), is_clean, again })
}

/// The answer to a read that is asked again.
fn later(row: &Command, asked: &Packet) -> Option<Packet> {
    let size = usize::from(row.size_in(Direction::Reply)?);
    let data: Vec<_> = LATER.into_iter().rev().take(size).collect();
    Some(Packet { direction: Direction::Reply, data: data.into(), ..asked.clone() })
}

/// Actuators that answered the query.
fn told(right: &[Packet]) -> Vec<Reported> {
    right.iter().map(|answer| found(answer.address, &answer.data)).collect()
}

/// The document does not say what comes of it.
struct Unspecified;

/// What there is in datagrams for a call.
#[derive(Default)]
struct Came {
    /// The answers, each once.
    right: Vec<Packet>,
    /// The requirement that keeps something else from being an answer.
    wrong: Option<&'static str>,
}

impl Came {
    /// `None` if the document leaves it unspecified what a datagram is.
    fn of(row: &Command, asked: &Packet, datagrams: &[Vec<u8>]) -> Option<Self> {
        let mut came = Self::default();
        for datagram in datagrams {
            if reference::is_short_reply_with_crc(Direction::Reply, datagram) {
                return None;
            }
            let wrong = match reference::decode(Direction::Reply, datagram) {
                Ok(packet) if reference::is_unspecified(&packet) => return None,
                Ok(packet) => came.packet(row, asked, packet).ok()?,
                // A host may find a frame between other bytes, or not.
                Err(_) if !reference::packets_anywhere(Direction::Reply, datagram).is_empty() => {
                    return None;
                }
                Err(Fault::Header) => Some("innfos.frame.header"),
                Err(Fault::Tail) => Some(TAIL),
                Err(Fault::Crc) => Some(VERIFY),
                Err(_) => Some("innfos.frame.length"),
            };
            came.wrong = came.wrong.or(wrong);
        }
        Some(came)
    }

    /// Takes a packet for an answer, or tells the requirement by which it is none.
    fn packet(
        &mut self,
        row: &Command,
        asked: &Packet,
        packet: Packet,
    ) -> Result<Option<&'static str>, Unspecified> {
        let is_query = row.code == QUERY;
        if packet.command != asked.command || !is_query && packet.address != asked.address {
            return Ok(Some(ECHO));
        }
        if row.size_in(Direction::Reply).map(usize::from) != Some(packet.data.len()) {
            let is_other = row.reply.iter().any(|size| usize::from(*size) == packet.data.len());
            let requirement = if row.operation == Operation::Read { SIZES } else { RESULT };
            return if is_other { Err(Unspecified) } else { Ok(Some(requirement)) };
        }
        let is_flag = matches!(packet.data.0.as_slice(), [0 | 1]);
        if row.operation == Operation::Write && !is_flag {
            return Err(Unspecified);
        }
        match self.right.iter().find(|other| other.address == packet.address) {
            // An actuator that is found twice, or that says two things.
            Some(other) if is_query || *other != packet => Err(Unspecified),
            Some(_) => Ok(None),
            None => {
                self.right.push(packet);
                Ok(None)
            }
        }
    }
}
