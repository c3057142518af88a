//! Every ID: those that a packet may have are built and read, the others are refused.

use actucheck_spec::model::Fault;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, BROADCAST, STATUS};

use super::BOTH_WAYS;
use crate::adapter::{Output, Question};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::{Family, Group};

/// The IDs that no packet may have.
const NO_IDS: [u8; 2] = [253, 255];

/// The data of the status packets.
const DATA: u8 = 0x2A;

pub(super) fn families(author: Author<'_>) -> [Family<'_>; 2] {
    [
        Family::new("dynamixel2.id.", move || ids(author)),
        // They were recorded once, before they were judged, and ids are permanent.
        Family::of("dynamixel2.open.id.", move || {
            NO_IDS.into_iter().flat_map(|id| refused(&author, id)).collect()
        }),
    ]
}

fn ping(id: u8) -> Packet {
    Packet::Instruction { id, instruction: 0x01, params: Vec::new().into() }
}

fn status(id: u8) -> Packet {
    Packet::Status { id, error: 0, params: vec![DATA].into() }
}

fn ids(author: Author<'_>) -> impl Iterator<Item = Group<'_>> {
    let pings = (0..=252).chain([BROADCAST]).map(move |id| {
        Group::new(format!("dynamixel2.id.{id}.ping"), &BOTH_WAYS, move |stem| {
            author.both_ways(stem, "dynamixel2.packet.id.range", &ping(id))
        })
    });
    let statuses = (0..=252).map(move |id| {
        Group::new(format!("dynamixel2.id.{id}.status"), &BOTH_WAYS, move |stem| {
            author.both_ways(stem, "dynamixel2.status-packet.layout", &status(id))
        })
    });
    pings.chain(statuses)
}

/// Packets with an ID that no packet may have: a sender builds none, and a receiver leaves them
/// alone.
fn refused(author: &Author<'_>, id: u8) -> Vec<Check> {
    let wire = author.wire;
    let ping = ("ping", ping(id), vec![0x01]);
    let status = ("status", status(id), vec![STATUS, 0, DATA]);
    let mut checks = Vec::new();
    for (name, packet, body) in [ping, status] {
        let stem = format!("dynamixel2.open.id.{id}.{name}");
        let refused = || Demand::Reject(Fault::Id);
        let packet = packet.into();
        let direction = wire.direction(&packet);
        let build = Question::Encode { wire, packet: packet.into() };
        let frame = reference::frame(id, &body);
        let read =
            Question::Decode { wire, bytes: frame.clone().into(), context: direction.into() };
        let (range, valid) = ("dynamixel2.packet.id.range", "dynamixel2.receive.id");
        checks.push(author.check(format!("{stem}/encode"), range, build, refused()));
        checks.push(author.check(format!("{stem}/decode"), valid, read, refused()));
        let chunks = vec![frame.into()];
        let find = Question::Stream { wire, chunks, direction: Some(direction) };
        let nothing = Demand::Yield(Output::Packets(Vec::new()));
        checks.push(author.check(format!("{stem}/stream"), valid, find, nothing));
    }
    checks
}
