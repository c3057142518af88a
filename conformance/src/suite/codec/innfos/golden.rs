//! The test vectors: packets that the document prints, and packets that were worked out from it.

use actucheck_spec::model::{Citation, Fault, Outcome, Vector};
use actucheck_spec::wire::{Packet, innfos};

use super::{decode, encode, open};
use crate::adapter::{Output, Question};
use crate::suite::Author;
use crate::suite::check::{Check, Demand, Way};
use crate::suite::codec::dynamixel2::golden::{demand, way};

pub(super) fn checks(author: &Author<'_>) -> Vec<Check> {
    let vectors = author.spec.vectors().filter(|(file, _)| file.wire == author.wire);
    let vectors: Vec<_> = vectors.map(|(file, vector)| (&file.source, vector)).collect();
    let mut checks = Vec::new();
    for (source, vector) in &vectors {
        let source = vector.source.as_ref().unwrap_or(source);
        let own = vector.requirement.as_deref().unwrap_or("innfos.packets");
        let mut add = |name: &str, requirement: &str, op, demand| {
            let check = author.check(format!("{}/{name}", vector.id), requirement, op, demand);
            checks.push(Check { source: source.clone(), ..check });
        };
        if let Some(packet) = &vector.packet {
            if let Some((op, demand)) = crc(author, packet) {
                add("crc", "innfos.crc.value", op, demand);
            }
            let others = others(vector, packet, &vectors);
            let built = demand(author.spec, vector, frame(vector), others);
            add("encode", own, encode(author, packet), built);
            let read = demand(author.spec, vector, Output::Packet(packet.clone()), Vec::new());
            add("decode", own, decode(author, packet.direction(), vector.frame()), read);
        } else if let (Some(kind), Some(fault)) = (vector.direction, vector.fault) {
            // The document does not say what bytes behind a frame are.
            let demand = match fault {
                Fault::Trailing => open::reading(author, kind, vector.frame()).1,
                fault => Demand::Reject(fault),
            };
            add("decode", own, decode(author, kind, vector.frame()), demand);
        }
        if let (Some(printed), Some(fault), Some(packet)) =
            (vector.defective(), vector.printed_fault, &vector.packet)
        {
            let op = decode(author, packet.direction(), printed);
            add("decode-printed", "innfos.defects", op, Demand::Reject(fault));
        }
    }
    checks
}

/// The other valid frames of a packet, if the document has several readings.
fn others(vector: &Vector, packet: &Packet, all: &[(&Citation, &Vector)]) -> Vec<Way> {
    let others = all.iter().map(|(_, other)| *other).filter(|other| {
        other.id != vector.id
            && other.result == Outcome::Acceptable
            && other.packet.as_ref() == Some(packet)
    });
    others.map(|other| way(other, frame(other))).collect()
}

fn frame(vector: &Vector) -> Output {
    Output::Bytes(vector.frame().to_vec().into())
}

/// The CRC of a packet's data.
fn crc(author: &Author<'_>, packet: &Packet) -> Option<(Question, Demand)> {
    let Packet::Innfos(innfos::Packet { data, .. }) = packet else { return None };
    let op = Question::Crc { wire: author.wire, bytes: data.clone() };
    let numbers = author.wire.checksum(data).into_iter().map(Output::Crc);
    (!data.is_empty()).then(|| (op, Demand::YieldOneOf(numbers.collect())))
}
