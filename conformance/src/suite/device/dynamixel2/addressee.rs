//! Who is meant: other IDs, IDs that nobody may have, and the broadcast ID.

use super::{BROADCAST, Talk, asked, code, error, frame, instruction, named, ping};
use crate::suite::check::Check;
use crate::suite::wanted::{Like, Part};

pub(super) fn checks(talk: &Talk<'_>) -> Vec<Check> {
    let absent = talk.absent();
    let mut silent = vec![(
        "other-id.ping",
        "packet.id.addressee|packet.addressee",
        talk.packet_then_ping(ping(absent)),
    )];
    // The reference model builds no packets with these IDs, as no packet may have them.
    for (name, id) in [("id-253.ping", 253), ("id-255.ping", 255)] {
        silent.push((name, "packet.id.range|id.range", talk.then_ping(frame(id, &[code::PING]))));
    }
    let undefined = instruction(BROADCAST, 0x09, Vec::new());
    silent.push((
        "broadcast.instruction-09",
        "response.broadcast.silence|response.broadcast",
        talk.packet_then_ping(undefined),
    ));
    if let Some(register) = talk.target.device.and_then(|device| device.registers.first()) {
        let range = [register.address, register.kind.size()].map(u16::to_le_bytes).concat();
        silent.push((
            "other-id.read",
            "packet.id.addressee|packet.addressee",
            talk.packet_then_ping(instruction(absent, code::READ, range.clone())),
        ));
        silent.push((
            "broadcast.read",
            "read.broadcast",
            talk.packet_then_ping(instruction(BROADCAST, code::READ, range)),
        ));
    }
    let silent = silent.into_iter().map(|(name, requirements, step)| {
        let requirements: Vec<_> = requirements.split('|').collect();
        talk.check(
            named(&format!("addressee.{name}/silence")),
            &requirements,
            vec![step],
            vec![vec![vec![talk.pong()]]],
        )
    });
    silent.chain([everybody(talk)]).collect()
}

/// Every device answers a Ping to the broadcast ID, by rising ID.
fn everybody(talk: &Talk<'_>) -> Check {
    let pong = |id: &u8| Like { id: *id, error: Some(error::NONE), data: Some(vec![Part::Any(3)]) };
    let present = &talk.target.present;
    talk.check(
        named("addressee.broadcast.ping/answers"),
        &["ping.broadcast"],
        vec![asked(ping(BROADCAST), present.len())],
        vec![vec![present.iter().map(pong).collect()]],
    )
}
