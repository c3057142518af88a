//! Recognises another host that sends on the same line.

use std::io;

use actucheck_spec::wire::{Direction, Packet, Wire};

use crate::adapter::{Asked, Heard};

/// What was sent in a conversation, and whether all came that was awaited.
#[derive(Debug, Default)]
pub(super) struct Own {
    sent: Vec<Packet>,
    is_answered: bool,
}

impl Own {
    pub(super) fn of(wire: Wire, steps: &[Asked], heard: &[Heard]) -> Self {
        let pieces = steps.iter().flat_map(|step| &step.send);
        let sent = pieces.flat_map(|piece| piece.bytes.0.clone()).collect();
        let is_answered = steps
            .iter()
            .zip(heard)
            .all(|(step, heard)| step.packets(wire, &heard.received()).len() >= step.awaits);
        Self { sent: requests(wire, sent), is_answered }
    }

    /// Looks whether an instruction came that another host must have sent.
    ///
    /// Firmware may put a wrong instruction into its answers, and an adapter may give back what was sent. So
    /// an instruction is another host's only if it is for a device that nothing was sent to, or if every
    /// answer came beside it, and it is a call that was not made.
    ///
    /// # Errors
    /// If one came.
    pub(super) fn look(&self, wire: Wire, came: Vec<u8>) -> io::Result<()> {
        // Where a packet does not tell its direction, nobody can say who sent it.
        if !wire.tells_direction() {
            return Ok(());
        }
        let name = |packet: &Packet| {
            wire.call(packet).filter(|call| !call.is_general).map(|call| call.name)
        };
        let is_others = |packet: &Packet| {
            let is_asked = self.sent.iter().any(|sent| wire.device(sent) == wire.device(packet));
            let call = name(packet);
            let is_made = self.sent.iter().any(|sent| name(sent) == call);
            !is_asked || (self.is_answered && call.is_some() && !is_made)
        };
        if requests(wire, came).iter().any(is_others) {
            return Err(io::Error::other(
                "another host sends on this line; stop it, and run this again, as the answers are not to one of them",
            ));
        }
        Ok(())
    }
}

fn requests(wire: Wire, bytes: Vec<u8>) -> Vec<Packet> {
    let mut packets = wire.stream(&[bytes.into()], Some(Direction::Request));
    packets.retain(|packet| packet.direction() == Direction::Request);
    packets
}
