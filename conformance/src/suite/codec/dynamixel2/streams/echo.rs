//! Echoes: on a half-duplex line a host may hear what it sends before it hears the answer.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::BROADCAST;

use super::{Cut, FOUND, Kind, decoded, frame, question};
use crate::adapter::Output;
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::plan::Family;

/// What a host sends: name, ID, instruction and parameters. No document has the last instruction.
const SENT: [(&str, u8, u8, &[u8]); 6] = [
    ("ping", 1, 0x01, &[]),
    ("read", 1, 0x02, &[0x84, 0x00, 0x04, 0x00]),
    ("write", 1, 0x03, &[0x74, 0x00, 0x05]),
    ("reboot", 1, 0x08, &[]),
    ("sync-read", BROADCAST, 0x82, &[0x84, 0x00, 0x04, 0x00, 1]),
    ("instruction-54", 1, 0x54, &[0x00, 0x2A]),
];

pub(super) fn family(author: Author<'_>) -> Family<'_> {
    Family::of("dynamixel2.stream.echo.", move || {
        SENT.iter().flat_map(|sent| checks(&author, sent)).collect()
    })
}

/// The answer is found after the echo. The echo may be found too, but it is no status packet.
fn checks(
    author: &Author<'_>,
    (name, id, instruction, params): &(&str, u8, u8, &[u8]),
) -> Vec<Check> {
    let params = params.to_vec().into();
    let echo = Packet::Instruction { id: *id, instruction: *instruction, params };
    let answer = Kind::Status.numbered(7);
    let frames = [frame(&echo), frame(&answer)];
    let stem = format!("dynamixel2.stream.echo.{name}/");
    let demand = Demand::YieldOneOf(vec![
        Output::packets([answer.clone()]),
        Output::packets([echo, answer.clone()]),
    ]);
    let mut checks = vec![decoded(author, format!("{stem}decode"), &answer, &frame(&answer))];
    for cut in [Cut::Whole, Cut::ByPart, Cut::Every(1)] {
        let required = if matches!(cut, Cut::Whole) { "decode" } else { "whole" };
        let id = format!("{stem}{}", cut.name());
        let question = question(author, Direction::Reply, &cut.chunks(&frames));
        let requirement = match cut {
            Cut::Whole => "dynamixel2.status-packet.layout",
            _ => FOUND,
        };
        let check = author.check(id, requirement, question, demand.clone());
        checks.push(Check { requires: Some(format!("{stem}{required}")), ..check });
    }
    checks
}
