//! A call that is answered right.

use actucheck_spec::wire::dynamixel2::Packet;

use super::{all, burst, failed, status, step, untold};
use crate::adapter::{Burst, Called, Reported, Step};
use crate::suite::due::Due;

/// A call that is answered right.
#[derive(Clone)]
pub(super) struct Right {
    pub(super) packet: Packet,
    /// The answer; empty if there is none.
    pub(super) answer: Vec<u8>,
    pub(super) due: Due,
    /// The requirements on the packet and on the answer.
    pub(super) requirements: [&'static str; 2],
}

impl Right {
    pub(super) fn new(
        packet: Packet,
        answer: Vec<u8>,
        due: Due,
        requirements: [&'static str; 2],
    ) -> Self {
        Self { packet, answer, due, requirements }
    }

    /// A call that is answered without data.
    pub(super) fn done(packet: Packet, requirements: [&'static str; 2]) -> Self {
        let due = all([Reported { id: 1, ..Reported::default() }]);
        Self::new(packet, status(1, 0, &[]), due, requirements)
    }

    pub(super) fn step(&self) -> Step {
        self.answered(match self.answer.as_slice() {
            [] => Vec::new(),
            bytes => vec![burst(bytes)],
        })
    }

    /// The same call, answered otherwise. A host that asks again is answered the same again.
    pub(super) fn answered(&self, played: Vec<Burst>) -> Step {
        step(self.packet.clone(), vec![played.clone(), played.clone(), played])
    }

    /// The call's name in ids.
    pub(super) fn name(&self) -> String {
        let call = Called::from(self.packet.clone()).call;
        call.map_or("", |call| call.name).replace('_', "-")
    }

    /// Whether one device is asked.
    pub(super) fn is_to_one(&self) -> bool {
        matches!(self.packet, Packet::Instruction { id: 1, .. })
    }

    /// What the devices' answers say.
    pub(super) fn devices(&self) -> &[Reported] {
        self.due.devices.as_deref().unwrap_or_default()
    }

    /// What the device's answer says, if one is asked.
    pub(super) fn told(&self) -> Reported {
        self.devices().first().cloned().unwrap_or_default()
    }

    /// Whether the answer says more than that there is one.
    pub(super) fn has_data(&self) -> bool {
        self.devices().iter().any(|device| device.data.is_some() || device.model_number.is_some())
    }

    /// What is due if there is no right answer: a host need not await one that has no data.
    pub(super) fn no_answer(&self) -> Due {
        if self.has_data() { failed() } else { untold() }
    }
}
