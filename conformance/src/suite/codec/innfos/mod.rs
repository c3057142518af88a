//! Checks of the INNFOS Ethernet protocol.
//!
//! - basics: single sentences, on which every other check rests;
//! - vectors: the test vectors;
//! - packets: packets of the document's tables, with every address, every command and the bytes that
//!   could be mistaken for the ends of a frame;
//! - messages: what these packets say, by name or in the document's unit;
//! - damaged: frames that break one rule each;
//! - unspecified: questions that the document leaves unspecified, such as packets that no table has.

pub(super) mod basics;
mod damaged;
pub(super) mod messages;
mod packets;
pub(in crate::suite) mod tables;
mod unspecified;
mod vectors;

use actucheck_spec::wire::innfos::Packet;
use actucheck_spec::wire::{Direction, Packet as AnyPacket};

use crate::adapter::Question;
use crate::suite::plan::Family;
use crate::suite::{Author, Options};

/// The place of the length, high byte first.
const LENGTH: usize = 3;
/// Bytes of a frame after the data: CRC and last byte.
const BEHIND: usize = 3;

pub(super) fn families<'a>(author: Author<'a>, options: &Options) -> Vec<Family<'a>> {
    let limit = options.limits.receive();
    let mut families = vec![messages::basics(author)];
    families.push(Family::of("", move || vectors::checks(&author)));
    for direction in Direction::ALL {
        families.extend(packets::families(author, direction));
        families.push(messages::family(author, direction));
        families.extend(damaged::families(author, direction));
        families.push(unspecified::family(author, direction, limit));
    }
    families.push(damaged::replies_as_requests(author));
    families
}

fn encode(author: &Author<'_>, packet: &AnyPacket) -> Question {
    Question::Encode { wire: author.wire, packet: packet.clone().into() }
}

fn decode(author: &Author<'_>, direction: Direction, bytes: &[u8]) -> Question {
    let bytes = bytes.to_vec().into();
    Question::Decode { wire: author.wire, bytes, context: direction.into() }
}

/// Each of `datagrams` is one.
fn stream(author: &Author<'_>, direction: Direction, datagrams: Vec<Vec<u8>>) -> Question {
    let chunks = datagrams.into_iter().map(Into::into).collect();
    Question::Stream { wire: author.wire, chunks, direction: Some(direction) }
}

/// The requirement on the data and the CRC of a packet; `other` if only the usual ones apply.
fn requirement_of(packet: &Packet, other: &'static str) -> &'static str {
    match (packet.direction, packet.data.len()) {
        (_, 0) => "innfos.frame.no-data",
        (Direction::Request, 1) => "innfos.crc.request",
        (Direction::Reply, 1) => "innfos.crc.reply",
        _ => other,
    }
}
