//! Answers of several devices, damaged or split at each byte.

use super::faults::{CRC, HEADER, LAYOUT, LENGTH, PAUSE_MS, STREAM};
use super::{BROADCAST, NO_ANSWER, Right, burst, frame, later};
use crate::adapter::{Burst, Reported};
use crate::suite::check::Check;
use crate::suite::due::Due;
use crate::suite::{Author, changed};

/// Bytes of a fast status packet before its blocks.
const BEFORE_BLOCKS: usize = 8;

/// What is returned of each.
pub(super) fn checks(author: &Author<'_>, right: &Right) -> Vec<Check> {
    if right.is_to_one() || right.answer.is_empty() {
        return Vec::new();
    }
    let (answer, call) = (&right.answer, right.name());
    let check = |name: String, requirement: &str, played: Vec<Burst>, due: Due| {
        let id = format!("dynamixel2.host.{call}.{name}/result");
        author.returned(id, requirement, vec![right.answered(played)], due)
    };
    let mut checks = Vec::new();
    for place in 0..answer.len() {
        let flipped = vec![burst(changed(answer, place, |byte| byte ^ 0x10))];
        let requirement = if place < 4 { HEADER } else { CRC };
        let rest = Due { partly: true, ..or_none(without(right, place)) };
        checks.push(check(format!("flip-{place:02}"), requirement, flipped, rest));
    }
    for place in 0..answer.len() {
        let (before, after) = answer.split_at(place);
        let rest = Due { partly: is_fast(right), ..or_none(before_cut(right, place)) };
        checks.push(check(format!("cut-{place:02}"), LENGTH, vec![burst(before)], rest));
        if place > 0 {
            let parts = vec![burst(before), later(PAUSE_MS, after)];
            checks.push(check(format!("split-{place:02}"), STREAM, parts, right.due.clone()));
        }
    }
    // The answer is found, but need not be after something that looks like one.
    let or_none = Due { or: NO_ANSWER.to_vec(), ..right.due.clone() };
    for (name, requirement, before, due) in [
        ("noise-before", HEADER, vec![0x00, 0x55, 0xAA], right.due.clone()),
        ("doubled", STREAM, answer.clone(), right.due.clone()),
        ("echo-before", LAYOUT, frame(right.packet.clone()), or_none),
    ] {
        let played = vec![burst([&before[..], answer].concat())];
        checks.push(check(name.to_owned(), requirement, played, due));
    }
    checks
}

/// Whether the devices answer in one packet.
fn is_fast(right: &Right) -> bool {
    right.answer.get(4) == Some(&BROADCAST)
}

/// Where the answer of each device ends.
fn ends(right: &Right) -> Vec<usize> {
    let before = if is_fast(right) { BEFORE_BLOCKS } else { 0 };
    let size = (right.answer.len() - before) / right.devices().len().max(1);
    (1..=right.devices().len()).map(|count| before + count * size).collect()
}

/// The devices whose answers are whole if the byte at a place is damaged. A block's CRC covers all that
/// is before it too.
fn without(right: &Right, place: usize) -> Vec<Reported> {
    let ends = ends(right);
    let struck = ends.iter().position(|end| place < *end).unwrap_or_default();
    let is_whole = |number: usize| number < struck || number > struck && !is_fast(right);
    let devices = right.devices().iter().enumerate();
    devices.filter(|(number, _)| is_whole(*number)).map(|(_, device)| device.clone()).collect()
}

/// The devices whose answers are whole if nothing comes from a place on.
fn before_cut(right: &Right, place: usize) -> Vec<Reported> {
    let devices = right.devices().iter().zip(ends(right));
    devices.filter(|(_, end)| *end <= place).map(|(device, _)| device.clone()).collect()
}

/// These devices, or an error.
fn or_none(devices: Vec<Reported>) -> Due {
    Due { devices: Some(devices), or: NO_ANSWER.to_vec(), ..Due::default() }
}
