//! Bytes that claim a length which covers good packets: a header that no packet follows, a packet
//! that is cut short, a damaged length.
//!
//! A receiver that loses the packets inside gets a warning. Where the length covers more than the
//! stream has, a receiver may still wait for the rest, so what it finds is recorded.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{self, HEADER, STATUS};

use super::{Cut, KINDS, Kind, Part, Scenario, frame, question};
use crate::adapter::Output;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::Family;
use crate::suite::{Author, changed};

/// The requirement that the packets inside are found.
const RESUMED: &str = "dynamixel2.receive.resume";

pub(super) fn family(author: Author<'_>) -> Family<'_> {
    Family::of("dynamixel2.open.resume.", move || one_by_one(&author))
}

/// Valid packets after a packet with a wrong length.
fn one_by_one(author: &Author<'_>) -> Vec<Check> {
    let good: Vec<u8> = (1..=4).flat_map(|number| frame(&Kind::Status.numbered(number))).collect();
    let bad = frame(&Kind::Status.numbered(9));
    let claims = |length: u16| {
        let [low, high] = length.to_le_bytes();
        [&HEADER[..], &[1, low, high, STATUS, 0]].concat()
    };
    let flipped = changed(&bad, 5, |low| low ^ 0x10);
    let cut = |size: usize| bad.get(..size).unwrap_or_default().to_vec();
    let scenarios: [(&str, &str, Vec<u8>); 7] = [
        ("length-too-long", "a packet whose length, with a bit flipped, covers the next", flipped),
        ("length-never-full", "a packet whose length covers more than comes", claims(0x0FFF)),
        ("length-greatest", "a packet whose length is the greatest", claims(0xFFFF)),
        ("length-0", "a packet whose length is 0", claims(0)),
        ("length-2", "a packet whose length is 2", claims(2)),
        ("cut-in-header", "a packet cut behind its ID", cut(5)),
        ("cut-in-params", "a packet cut in its parameters", cut(11)),
    ];
    let check = |(name, what, bad): (&str, &str, Vec<u8>)| {
        let id = format!("dynamixel2.open.resume.{name}/stream");
        resumed(author, id, what, &[[bad, good.clone()].concat()])
    };
    scenarios.map(check).into()
}

/// A stream of status packets in which the search has to go on after `what`.
pub(in super::super) fn resumed(
    author: &Author<'_>,
    id: String,
    what: &str,
    chunks: &[Vec<u8>],
) -> Check {
    let stream = chunks.concat();
    let packets = reference::packets(&stream);
    let demand = if reference::lacks_bytes(&stream) {
        let ways = [
            ("it finds every whole packet", packets),
            ("behind the bytes that the length covers", reference::packets_behind_lengths(&stream)),
            ("it finds none of the whole packets behind it", Vec::new()),
        ];
        let ways = ways.map(|(name, packets)| (name, Output::packets(packets)));
        Demand::record(&format!("Where does the search go on behind {what}?"), ways)
    } else {
        Demand::Yield(Output::packets(packets))
    };
    author.check(id, RESUMED, question(author, Direction::Reply, chunks), demand)
}

/// Something that claims a length before and between good packets, which follow until the length is
/// full.
pub(super) fn claims() -> Vec<Scenario> {
    /// Where the claim ends: in the first packet after it, at its end, or in later ones.
    const CLAIMS: [(&str, u16); 8] = [
        ("in-the-first", 9),
        ("at-the-end-of-the-first", 0),
        ("a-byte-more", 1),
        ("in-the-second", 24),
        ("in-the-fourth", 57),
        ("of-255", 255),
        ("of-256", 256),
        ("of-1000", 1000),
    ];
    let header = |kind: Kind, (name, claim): (&str, u16)| {
        let packet = frame(&kind.numbered(0)).len();
        let length = match claim {
            // From the end of the first packet.
            0 | 1 => claim + u16::try_from(packet).unwrap_or_default(),
            claim => claim,
        };
        let claim = move || [&HEADER[..], &[1], &length.to_le_bytes()].concat();
        scenario(kind, &format!("header.{name}"), usize::from(length) / packet + 3, claim)
    };
    let all = |kind: Kind| {
        let headers = CLAIMS.into_iter().map(move |claim| header(kind, claim));
        let whole = frame(&kind.numbered(0)).len();
        let cut = (7..whole).map(move |end| {
            let bytes = move || frame(&kind.numbered(0)).into_iter().take(end).collect();
            scenario(kind, &format!("cut-at-{end}"), 4, bytes)
        });
        let damaged = (3..7).map(move |bit| {
            let bytes = move || changed(&frame(&kind.numbered(0)), 5, |low| low ^ 1 << bit);
            scenario(kind, &format!("length-bit-{bit}"), 12, bytes)
        });
        headers.chain(cut).chain(damaged)
    };
    KINDS.into_iter().flat_map(all).collect()
}

/// A good packet, the claim, and as many good packets after it.
fn scenario(
    kind: Kind,
    name: &str,
    behind: usize,
    claim: impl Fn() -> Vec<u8> + Send + 'static,
) -> Scenario {
    const CUTS: &[Cut] = &[Cut::ByPart, Cut::Every(7), Cut::Every(1)];
    let packet = move |number: usize| -> Packet {
        kind.numbered(u8::try_from(number % 200).unwrap_or_default())
    };
    Scenario::new(format!("resume.{kind}.{name}"), RESUMED, CUTS, move || {
        let good = (1..=behind).map(|number| Part::Packet(packet(number)));
        [Part::Packet(packet(0)), Part::Other(claim())].into_iter().chain(good).collect()
    })
}
