//! The test vectors: packets that the document prints, and packets that were worked out from it.

use actucheck_spec::model::{Citation, Fault, Outcome, Vector};
use actucheck_spec::wire::{Packet, innfos};

use super::{decode, encode, messages, unspecified};
use crate::adapter::{Output, Question};
use crate::suite::Author;
use crate::suite::check::{Check, Demand, Way};
use crate::suite::codec::vector::{demand, way};

pub(super) fn checks(author: &Author<'_>) -> Vec<Check> {
    let vectors = author.spec.vectors().filter(|(file, _)| file.wire == author.wire);
    let vectors: Vec<_> = vectors.map(|(file, vector)| (&file.source, vector)).collect();
    let of = |(source, vector): &(&Citation, &Vector)| {
        let source = vector.source.as_ref().unwrap_or(source).clone();
        let checks = of_vector(author, vector, &vectors).into_iter();
        checks.map(move |check| Check { source: source.clone(), ..check })
    };
    vectors.iter().flat_map(of).collect()
}

fn of_vector(author: &Author<'_>, vector: &Vector, all: &[(&Citation, &Vector)]) -> Vec<Check> {
    let mut checks = Vec::new();
    let mut add = |name: &str, requirement: &str, op, demand| {
        checks.push(author.check(format!("{}/{name}", vector.id), requirement, op, demand));
    };
    let own = vector.requirement.as_deref().unwrap_or("innfos.packets");
    if let Some(packet) = &vector.packet {
        if let Some((op, demand)) = crc(author, packet) {
            add("crc", "innfos.crc.value", op, demand);
        }
        // Who builds and reads the bytes need not know what they mean.
        let own = if is_on_values(own) { "innfos.packets" } else { own };
        let others = others(vector, packet, all);
        let built = demand(author.spec, vector, frame(vector), others);
        add("encode", own, encode(author, packet), built);
        let read = demand(author.spec, vector, Output::Packet(packet.clone()), Vec::new());
        add("decode", own, decode(author, packet.direction(), vector.frame()), read);
    } else if let (Some(kind), Some(fault)) = (vector.direction, vector.fault) {
        // The document does not say what bytes after a frame are.
        let demand = match fault {
            Fault::Trailing => unspecified::reading(author, kind, vector.frame()).1,
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
    checks.extend(vector.packet.iter().flat_map(|packet| messages(author, vector, packet)));
    checks
}

/// What a packet says, with the first model if it says a fraction of a full scale.
fn messages(author: &Author<'_>, vector: &Vector, packet: &Packet) -> Vec<Check> {
    let Packet::Innfos(packet) = packet else { return Vec::new() };
    if vector.result == Outcome::Acceptable {
        return Vec::new();
    }
    let said = messages::of_each_model(*author, packet).into_iter().next();
    let own = vector.requirement.as_deref().filter(|own| is_on_values(own));
    let checks = said.map(|said| {
        let requirement = own.unwrap_or_else(|| said.requirement());
        said.checks(*author, &vector.id, requirement)
    });
    checks.unwrap_or_default()
}

/// Whether a requirement is on what the data means.
fn is_on_values(requirement: &str) -> bool {
    requirement.starts_with("innfos.value.") || requirement == "innfos.alarms.bits"
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
