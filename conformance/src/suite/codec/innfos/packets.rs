//! Packets of the document's tables that are built, read, and received in datagrams.

use actucheck_spec::wire::innfos::{Packet, reference};
use actucheck_spec::wire::{Direction, Packet as AnyPacket};

use super::{decode, encode, requirement_of, stream, tables};
use crate::adapter::Output;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::{Family, Group};
use crate::suite::{Author, hex};

/// Bytes that could be mistaken for the first or last byte of a frame, and two others.
const ALPHABET: [u8; 4] = [0xEE, 0xED, 0x00, 0x01];

/// What a packet's checks are called.
const NAMES: [&str; 3] = ["/encode", "/decode", "/stream"];

pub(super) fn families(author: Author<'_>, direction: Direction) -> [Family<'_>; 4] {
    let of_size = move || {
        let codes = tables::of_each_size(direction).iter();
        codes.filter_map(move |code| tables::of_command(author, direction, *code))
    };
    [
        family(author, direction, "address", "innfos.frame.address", move || {
            let example = of_size().last();
            let packets = (0..=u8::MAX)
                .filter_map(move |address| Some(Packet { address, ..example.clone()? }));
            packets.map(|packet| (format!("{:02x}", packet.address), packet))
        }),
        family(author, direction, "command", "innfos.frame.layout", move || {
            tables::all(author, direction).map(|packet| (format!("{:02x}", packet.command), packet))
        }),
        family(author, direction, "size", "innfos.crc.byte-order", move || {
            of_size().map(|packet| (packet.data.len().to_string(), packet))
        }),
        family(author, direction, "data", "innfos.frame.transparent", move || {
            of_size().flat_map(|example| {
                words(example.data.len())
                    .map(move |data| (hex(&data), Packet { data: data.into(), ..example.clone() }))
            })
        }),
    ]
}

/// Packets, each with its name; those that the tables do not have are left out.
fn family<'a, I>(
    author: Author<'a>,
    direction: Direction,
    what: &'static str,
    requirement: &'static str,
    packets: impl Fn() -> I + Send + Sync + 'a,
) -> Family<'a>
where
    I: Iterator<Item = (String, Packet)> + Send + 'a,
{
    let prefix = format!("innfos.{direction}.{what}.");
    Family::new(prefix.clone(), move || {
        let prefix = prefix.clone();
        let packets = packets();
        let judged =
            packets.filter(move |(_, it)| reference::is_in_tables(tables::rows(author), it));
        judged.map(move |(name, packet)| {
            let build = move |id: &str| checks(&author, id, requirement, packet);
            Group::new(format!("{prefix}{name}"), &NAMES, build)
        })
    })
}

/// Data of this many bytes.
fn words(length: usize) -> impl Iterator<Item = Vec<u8>> {
    (0..1_usize << (2 * length)).map(move |number| {
        let letters = (0..length).map(|place| number >> (2 * place) & 3);
        letters.filter_map(|letter| ALPHABET.get(letter).copied()).collect()
    })
}

/// A packet that is built, read, and received in two datagrams.
fn checks(author: &Author<'_>, id: &str, requirement: &'static str, packet: Packet) -> Vec<Check> {
    let Some(frame) = reference::encode(&packet) else { return Vec::new() };
    let direction = packet.direction;
    let requirement = requirement_of(&packet, requirement);
    let packet = AnyPacket::from(packet);
    let twice = Output::Packets(vec![packet.clone(), packet.clone()]);
    let asked = [
        (encode(author, &packet), Output::Bytes(frame.clone().into())),
        (decode(author, direction, &frame), Output::Packet(packet)),
        (stream(author, direction, vec![frame.clone(), frame]), twice),
    ];
    let mut checks = asked.map(|(question, output)| {
        let id = format!("{id}/{}", question.name());
        author.check(id, requirement, question, Demand::Yield(output))
    });
    let [_, read, found] = &mut checks;
    found.requires = Some(read.id.clone());
    checks.into()
}
