//! The actuators that answer the query.

use super::{
    ECHO, ID, NO_ANSWER, OTHER_ID, QUERY, READ_POSITION, TAIL, all, answered, burst, found, later,
    recorded, reply, request,
};
use crate::adapter::{Burst, Reported};
use crate::suite::check::Check;
use crate::suite::due::Due;
use crate::suite::{Author, changed};

const MAC: [u8; 4] = [0x01, 0x64, 0x5A, 0xDF];
const OTHER_MAC: [u8; 4] = [0x01, 0x64, 0x5B, 0x10];
/// How long a board takes to find its actuators.
const TIME_MS: u32 = 500;

const TRANSPORT: &str = "innfos.transport.query";

/// What is returned of each.
pub(super) fn checks(author: Author<'_>) -> Vec<Check> {
    let (one, other) = (reply(ID, QUERY, &MAC), reply(OTHER_ID, QUERY, &OTHER_MAC));
    let position = reply(ID, READ_POSITION, &[0x00, 0x12, 0x34, 0x56]);
    let last = other.len().saturating_sub(1);
    let damaged = changed(&other, last, |byte| byte ^ 0x10);
    let partly = |devices: &[Reported]| Due {
        partly: true,
        or: NO_ANSWER.to_vec(),
        ..all(devices.to_vec())
    };
    let (first, both) = ([found(ID, &MAC)], [found(ID, &MAC), found(OTHER_ID, &OTHER_MAC)]);
    let check = |name: &str, requirement, played: Vec<Burst>, due| {
        let steps = vec![answered(request(0, QUERY, &[]), played)];
        author.returned(format!("innfos.host.query.{name}/result"), requirement, steps, due)
    };
    let at_once =
        |frames: &[&Vec<u8>]| frames.iter().map(|frame| burst(frame.as_slice())).collect();
    let judged = [
        ("two", TRANSPORT, at_once(&[&one, &other]), all(both.clone())),
        ("swapped", TRANSPORT, at_once(&[&other, &one]), all(both.clone())),
        ("other-command", ECHO, at_once(&[&position, &one, &other]), partly(&both)),
        ("damaged", TAIL, at_once(&[&one, &damaged]), partly(&first)),
    ];
    let mut checks: Vec<_> = judged
        .into_iter()
        .map(|(name, requirement, played, due)| check(name, requirement, played, due))
        .collect();
    let six = reply(ID, QUERY, &[0x01, 0x64, 0x5A, 0xDF, 0x00, 0x00]);
    let open = [
        ("six-bytes", "whose answer has six bytes", at_once(&[&six])),
        ("doubled", "that an actuator answers twice", at_once(&[&one, &one])),
        (
            "same-datagram",
            "that two actuators answer in a datagram",
            vec![burst([one, other.clone()].concat())],
        ),
        ("slow", "that is answered after half a second", vec![later(TIME_MS, other)]),
        ("silence", "that nothing answers", Vec::new()),
    ];
    checks.extend(open.into_iter().map(|(name, what, played)| {
        let check = check(name, "innfos.transport.query-time", played, all(first.clone()));
        recorded(check, &format!("What does a query return {what}?"))
    }));
    checks
}
