//! Answers to a write that are damaged, of something else, or none.

use super::{
    ECHO, ID, OTHER_ID, READ_POSITION, SWITCH, TAIL, all, answered, bare, datagram, recorded,
    reply, request, untold,
};
use crate::suite::check::Check;
use crate::suite::{Author, changed};

const RESULT: &str = "innfos.write.result";

/// What is returned of each.
pub(super) fn checks(author: Author<'_>) -> Vec<Check> {
    let right = reply(ID, SWITCH, &[0x01]);
    let last = right.len().saturating_sub(1);
    let with_crc = [right.get(..last).unwrap_or_default(), &[0x7E, 0x80, 0xED]].concat();
    let check = |name: &str, requirement, answer: &[u8], due| {
        let steps = vec![answered(request(ID, SWITCH, &[0x01]), datagram(answer))];
        author.returned(format!("innfos.host.write.{name}/result"), requirement, steps, due)
    };
    let no_success = [
        ("wrong-header", "innfos.frame.header", changed(&right, 0, |byte| byte ^ 0x10)),
        ("wrong-end", TAIL, changed(&right, last, |byte| byte ^ 0x10)),
        ("without-end", TAIL, right.get(..last).unwrap_or_default().to_vec()),
        ("other-device", ECHO, reply(OTHER_ID, SWITCH, &[0x01])),
        ("other-command", ECHO, reply(ID, READ_POSITION, &[0x00, 0x12, 0x34, 0x56])),
        ("no-byte", RESULT, reply(ID, SWITCH, &[])),
        ("two-bytes", RESULT, reply(ID, SWITCH, &[0x01, 0x01])),
    ];
    let mut checks: Vec<_> = no_success
        .iter()
        .map(|(name, requirement, answer)| check(name, *requirement, answer, untold()))
        .collect();
    let open = [
        ("result-02", "whose answer is neither 0 nor 1", reply(ID, SWITCH, &[0x02])),
        ("with-crc", "whose answer of one byte has a CRC", with_crc),
        ("silence", "that nothing answers", Vec::new()),
    ];
    checks.extend(open.iter().map(|(name, what, answer)| {
        let check = check(name, RESULT, answer, all([bare(ID)]));
        recorded(check, &format!("What does a write return {what}?"))
    }));
    checks
}
