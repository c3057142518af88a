//! Frames that break one rule each.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::Packet;
use actucheck_spec::wire::innfos::reference::{self, TAIL};

use super::{LENGTH, decode, tables, unspecified};
use crate::suite::check::Check;
use crate::suite::plan::Family;
use crate::suite::{Author, changed};

/// A name, the bytes, and the requirement if it is not the one of the fault.
type Damaged = (String, Vec<u8>, Option<&'static str>);

pub(super) fn families(author: Author<'_>, direction: Direction) -> [Family<'_>; 3] {
    let prefix = format!("innfos.negative.{direction}.");
    let (each_bit, each_command) = (prefix.clone(), prefix.clone());
    [
        Family::of(prefix.clone(), move || {
            checks(&author, direction, &prefix, bit_by_bit(&unspecified::example(direction)))
        }),
        Family::of(each_bit.clone(), move || {
            let codes = tables::of_each_size(direction).iter();
            // The example above has the size of the last one.
            let packets = codes.rev().skip(1).rev();
            let packets = packets.filter_map(|code| tables::of_command(author, direction, *code));
            let checks = packets.flat_map(|packet| {
                let prefix = format!("{each_bit}{:02x}.", packet.command);
                checks(&author, direction, &prefix, bit_by_bit(&packet))
            });
            checks.collect()
        }),
        Family::of(each_command.clone(), move || {
            let checks = tables::all(author, direction).flat_map(|packet| {
                let prefix = format!("{each_command}{:02x}.", packet.command);
                checks(&author, direction, &prefix, rule_by_rule(&packet))
            });
            checks.collect()
        }),
    ]
}

/// Replies with one byte, which lack the CRC of a request, are read as requests.
pub(super) fn replies_as_requests(author: Author<'_>) -> Family<'_> {
    let prefix = "innfos.negative.reply-as-request.";
    Family::of(prefix, move || {
        let both = tables::all(author, Direction::Request).filter(|packet| packet.data.len() == 1);
        let damaged = both.map(|request| {
            let name = format!("{:02x}", request.command);
            let reply = Packet { direction: Direction::Reply, ..request };
            let frame = reference::encode(&reply).unwrap_or_default();
            (name, frame, Some("innfos.crc.request"))
        });
        checks(&author, Direction::Request, prefix, damaged.collect())
    })
}

fn checks(
    author: &Author<'_>,
    direction: Direction,
    prefix: &str,
    damaged: Vec<Damaged>,
) -> Vec<Check> {
    let check = |(name, bytes, own): Damaged| {
        let (requirement, demand) = unspecified::reading(author, direction, &bytes);
        let question = decode(author, direction, &bytes);
        let id = format!("{prefix}{name}/decode");
        author.check(id, own.unwrap_or(requirement), question, demand)
    };
    damaged.into_iter().map(check).collect()
}

/// Each flipped bit, each missing end, and an extra byte at either end.
fn bit_by_bit(packet: &Packet) -> Vec<Damaged> {
    let frame = reference::encode(packet).unwrap_or_default();
    let mut damaged = Vec::new();
    for at in 0..frame.len() {
        for bit in 0..8 {
            let flipped = changed(&frame, at, |byte| byte ^ 1 << bit);
            damaged.push((format!("flip-{at}-{bit}"), flipped, None));
        }
        damaged.push((format!("cut-at-{at}"), frame.get(..at).unwrap_or_default().to_vec(), None));
    }
    damaged.push(("byte-more".to_owned(), [frame.as_slice(), &[TAIL]].concat(), None));
    damaged.push(("byte-before".to_owned(), [&[0x00], frame.as_slice()].concat(), None));
    damaged
}

/// Each rule of a frame broken once. What depends on the command should not be what keeps it.
fn rule_by_rule(packet: &Packet) -> Vec<Damaged> {
    let frame = reference::encode(packet).unwrap_or_default();
    let last = frame.len().saturating_sub(1);
    let start = reference::PREFIX + packet.data.len();
    let crc = frame.get(start..last).unwrap_or_default();
    let with_crc = |crc: &[u8]| [frame.get(..start).unwrap_or_default(), crc, &[TAIL]].concat();
    let mut damaged = vec![
        ("header", changed(&frame, 0, |_| 0xEF), None),
        ("length-more", changed(&frame, LENGTH + 1, |length| length + 1), None),
        ("end", changed(&frame, last, |_| 0xEE), None),
        ("without-end", frame.get(..last).unwrap_or_default().to_vec(), None),
    ];
    if packet.data.is_empty() {
        let rule = Some("innfos.frame.no-data");
        damaged.push(("with-crc", with_crc(&reference::crc(&[]).to_le_bytes()), rule));
    } else {
        damaged.push(("length-less", changed(&frame, LENGTH + 1, |length| length - 1), None));
        let mut swapped = frame.clone();
        swapped.swap(LENGTH, LENGTH + 1);
        damaged.push(("length-low-byte-first", swapped, None));
    }
    if let [first, second] = *crc {
        let of_frame = reference::crc(frame.get(..start).unwrap_or_default());
        let rule = match packet.direction {
            Direction::Request => "innfos.crc.request",
            Direction::Reply => "innfos.crc.reply",
        };
        damaged.push(("crc", with_crc(&[first ^ 1, second]), None));
        damaged.push(("crc-high-byte-first", with_crc(&[second, first]), None));
        damaged.push(("crc-of-all", with_crc(&of_frame.to_le_bytes()), None));
        damaged.push(("crc-zero", with_crc(&[0, 0]), None));
        damaged.push(("without-crc", with_crc(&[]), Some(rule)));
    }
    damaged.into_iter().map(|(name, bytes, rule)| (name.to_owned(), bytes, rule)).collect()
}
