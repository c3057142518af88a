//! What there is not: addresses without a register, and instructions that no document defines.

use actucheck_spec::model::Device;

use super::{Talk, asked, code, error, instruction, named};
use crate::suite::check::Check;

/// Codes that no document defines.
pub(crate) const UNDEFINED: [u8; 5] = [0x09, 0x11, 0x40, 0x7F, 0xA0];

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let undefined = UNDEFINED.map(|code| {
        talk.check(
            named(&format!("refused.instruction-{code:02x}/answer")),
            &["status-packet.error.instruction"],
            vec![asked(instruction(talk.id(), code, Vec::new()), 1)],
            vec![vec![vec![talk.refusal(error::INSTRUCTION)]]],
        )
    });
    let parameters = talk.record(
        named("refused.ping-with-parameters/answer"),
        &["ping.parameters"],
        vec![talk.packet_then_ping(instruction(talk.id(), code::PING, vec![0]))],
        "How does it answer a Ping with a parameter?",
    );
    let short = talk.record(
        named("refused.read-without-length/answer"),
        &["read.parameters"],
        vec![talk.packet_then_ping(instruction(talk.id(), code::READ, vec![0, 0]))],
        "How does it answer a Read without its length?",
    );
    let addresses = talk.target.device.map(|device| addresses(talk, device));
    let more = [parameters, short].into_iter().chain(addresses.into_iter().flatten());
    undefined.into_iter().chain(more).collect()
}

fn addresses(talk: &Talk<'_>, device: &Device) -> Vec<Check> {
    let empty = device.registers.first().map(|register| {
        talk.record(
            named("refused.no-bytes/answer"),
            &["read.parameters"],
            vec![talk.packet_then_ping(talk.read(register.address, 0))],
            "How does it answer a Read of no bytes?",
        )
    });
    let mut checks: Vec<_> = empty.into_iter().collect();
    // A table that is not complete tells nothing about other addresses.
    if !device.complete {
        return checks;
    }
    let refused = |id: String, requirement, address, length| {
        talk.check(
            named(&id),
            &[requirement],
            vec![asked(talk.read(address, length), 1)],
            vec![vec![vec![talk.refusal(error::ACCESS)]]],
        )
    };
    let mut ends = device.registers.iter().map(|register| register.address + register.kind.size());
    let begins = device.registers.iter().skip(1).map(|register| register.address);
    let gaps = ends.clone().zip(begins).filter(|(end, begin)| end < begin);
    checks.extend(gaps.map(|(gap, _)| {
        refused(format!("refused.address-{gap}/answer"), "status-packet.error.read-access", gap, 1)
    }));
    if let (Some(end), Some(last)) = (ends.next_back(), device.registers.last()) {
        let size = last.kind.size();
        let beyond = "read.beyond";
        checks.push(refused("refused.beyond-the-end/answer".to_owned(), beyond, end, 1));
        checks.push(refused(
            "refused.over-the-end/answer".to_owned(),
            beyond,
            last.address,
            size + 1,
        ));
        checks.push(refused("refused.last-address/answer".to_owned(), beyond, u16::MAX, 1));
        // Its parameters are FF FF FD 00, so that the packet is stuffed.
        checks.push(refused("refused.stuffed-address/answer".to_owned(), beyond, u16::MAX, 0xFD));
    }
    checks
}
