//! Status packets with other bytes around them, where every reading of the documents finds the
//! packets. Each stream is cut at every place.

use actucheck_spec::wire::Direction;

use super::{Cut, FOUND, Kind, frame};
use crate::suite::check::Check;
use crate::suite::plan::Family;
use crate::suite::{Author, changed};

pub(super) fn family(author: Author<'_>) -> Family<'_> {
    Family::of("dynamixel2.stream.", move || checks(&author))
}

fn checks(author: &Author<'_>) -> Vec<Check> {
    let good = frame(&Kind::Status.packet(&[0xA6, 0x00, 0x00, 0x00]));
    let stuffed = frame(&Kind::Status.packet(&[0xFF, 0xFF, 0xFD, 0xFF]));
    let bad = changed(&good, good.len() - 1, |byte| byte ^ 1);
    let scenarios: [(&str, Vec<Vec<u8>>); 11] = [
        ("good-good", vec![good.clone(), stuffed.clone()]),
        ("bad-crc-good", vec![bad.clone(), good.clone()]),
        ("good-bad-crc-good", vec![good.clone(), bad.clone(), stuffed.clone()]),
        ("bad-crc-twice-good", vec![bad.clone(), bad, good.clone()]),
        ("zeros-good", vec![vec![0; 5], good.clone()]),
        ("ff-good", vec![vec![0xFF; 5], good.clone()]),
        ("ff-ff-good", vec![vec![0xFF, 0xFF], good.clone()]),
        ("header-start-good", vec![vec![0xFF, 0xFF, 0xFD], good.clone()]),
        ("stuffed-header-good", vec![vec![0xFF, 0xFF, 0xFD, 0xFD], good.clone()]),
        ("wrong-reserved-good", vec![vec![0xFF, 0xFF, 0xFD, 0x01], good.clone()]),
        ("good-noise-good", vec![good, vec![0x12, 0xFD, 0x34], stuffed]),
    ];
    let mut checks = Vec::new();
    for (name, parts) in scenarios {
        let id = format!("dynamixel2.stream.{name}");
        let requirement = match name {
            "stuffed-header-good" => "dynamixel2.receive.header.stuffed",
            _ => FOUND,
        };
        let streamed =
            |id, cut: Cut| author.streamed(id, requirement, Direction::Reply, &cut.chunks(&parts));
        let first = format!("{id}/stream");
        checks.push(streamed(first.clone(), Cut::ByPart));
        let places = (1..parts.concat().len()).map(Cut::At);
        checks.extend(places.chain([Cut::Every(1)]).map(|cut| Check {
            requires: Some(first.clone()),
            ..streamed(format!("{id}/{}", cut.name()), cut)
        }));
    }
    checks
}
