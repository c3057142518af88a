//! Packets at the limits that an implementation states, and above them: a packet of the limit's size
//! is built and read, and a longer one is refused. The greatest length that a packet can have is
//! a limit for all.

use actucheck_spec::model::Fault;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, PATTERN, PREFIX};

use super::LARGEST;
use super::kind::Kind;
use crate::adapter::{Called, Limits, Output, Question};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::{Family, Group};

/// Bytes of a packet apart from its body.
const AROUND: usize = PREFIX + 2;

/// A limit must be at least this many bytes more than the shortest packets.
const LEAST: usize = AROUND + 16;

const REQUIREMENT: &str = "dynamixel2.packet.length.limit";

/// Sizes of packets compared with the limit. Some libraries write one byte more than they may.
const SIZES: [(&str, isize); 5] =
    [("below", -1), ("at", 0), ("above", 1), ("above-by-2", 2), ("above-by-100", 100)];

/// Who has the limit.
#[derive(Clone, Copy)]
enum End {
    Send,
    Receive,
}

pub(super) fn families(author: Author<'_>, limits: Limits) -> Vec<Family<'_>> {
    let ends = [(End::Send, limits.send()), (End::Receive, limits.receive())];
    let mut families = vec![Family::of("dynamixel2.limit.length-field.", move || {
        Kind::ALL.into_iter().flat_map(|kind| beyond_length(&author, kind)).collect()
    })];
    families.extend(ends.into_iter().filter_map(|(end, limit)| {
        // The length field is the limit of those whose own one is above it.
        let limit = limit.filter(|limit| *limit >= LEAST)?.min(LARGEST);
        Some(family(author, end, limit))
    }));
    families
}

/// Packets whose length has no room in its field, one of them only with stuffing.
fn beyond_length(author: &Author<'_>, kind: Kind) -> [Check; 2] {
    let longest = LARGEST - AROUND;
    let plain = kind.with_body(longest + 1, None);
    let stuffed = kind.with_body(longest, Some(longest - PATTERN.len()));
    [("plain", plain), ("stuffed", stuffed)].map(|(name, packet)| {
        let id = format!("dynamixel2.limit.length-field.{kind}.{name}/encode");
        let packet = Called::from(packet);
        let build = Question::Encode { wire: author.wire, packet };
        author.check(id, REQUIREMENT, build, Demand::Reject(Fault::Oversize))
    })
}

fn family(author: Author<'_>, end: End, limit: usize) -> Family<'_> {
    let (prefix, names): (_, &'static [&'static str]) = match end {
        End::Send => ("dynamixel2.limit.send.", &["/encode"]),
        End::Receive => ("dynamixel2.limit.receive.", &["/decode", "/stream"]),
    };
    Family::new(prefix, move || {
        let sizes = SIZES.into_iter().filter_map(move |(name, more)| {
            let size = limit.checked_add_signed(more).filter(|size| *size <= LARGEST)?;
            Some((name, size))
        });
        sizes.flat_map(move |(name, size)| {
            let kinds = Kind::ALL.into_iter();
            let each = kinds.flat_map(|kind| [(kind, false), (kind, true)]);
            each.map(move |(kind, is_stuffed)| {
                let how = if is_stuffed { "stuffed" } else { "plain" };
                let stem = format!("{prefix}{name}.{kind}.{how}");
                Group::new(stem, names, move |stem| {
                    let packet = of_size(kind, size, is_stuffed);
                    checks(&author, stem, end, &packet, size > limit)
                })
            })
        })
    })
}

/// A packet of this size, with stuffing at its end if it is stuffed.
fn of_size(kind: Kind, size: usize, is_stuffed: bool) -> Packet {
    let length = size.saturating_sub(AROUND + usize::from(is_stuffed));
    kind.with_body(length, is_stuffed.then(|| length.saturating_sub(PATTERN.len())))
}

fn checks(author: &Author<'_>, stem: &str, end: End, packet: &Packet, is_over: bool) -> Vec<Check> {
    let wire = author.wire;
    let frame = reference::encode(packet).unwrap_or_default();
    let packet = packet.clone().into();
    let direction = wire.direction(&packet);
    let demand =
        |output| if is_over { Demand::Reject(Fault::Oversize) } else { Demand::Yield(output) };
    let requirement = if is_over { REQUIREMENT } else { "dynamixel2.packet.length" };
    match end {
        End::Send => {
            let build = Question::Encode { wire, packet: Called::from(packet) };
            let bytes = demand(Output::Bytes(frame.into()));
            vec![author.check(format!("{stem}/encode"), requirement, build, bytes)]
        }
        End::Receive => {
            let bytes = frame.clone().into();
            let read = Question::Decode { wire, bytes, context: direction.into() };
            let chunks = vec![frame.into()];
            let find = Question::Stream { wire, chunks, direction: Some(direction) };
            let found = if is_over { Vec::new() } else { vec![packet.clone()] };
            let found = Demand::Yield(Output::Packets(found));
            let read = author.check(
                format!("{stem}/decode"),
                requirement,
                read,
                demand(Output::Packet(packet)),
            );
            // Nothing is found of what is over the limit, whether or not it can be read.
            let requires = (!is_over).then(|| format!("{stem}/decode"));
            let find = author.check(format!("{stem}/stream"), requirement, find, found);
            vec![read, Check { requires, ..find }]
        }
    }
}
