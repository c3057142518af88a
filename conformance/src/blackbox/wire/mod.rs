//! The wires with probes. A new wire has a line in [`ALL`].

mod dynamixel2;
mod innfos;

use actucheck_spec::wire::{Packet, Wire};
use proptest::prelude::BoxedStrategy;

use super::probe::{Named, Probe};
use crate::adapter::Question;
use crate::suite::Author;
use crate::suite::check::Demand;

const ALL: [Probes; 2] = [dynamixel2::PROBES, innfos::PROBES];

/// The probes of a wire.
#[derive(Clone, Copy)]
pub(crate) struct Probes {
    pub(crate) wire: Wire,
    /// Generates packets.
    pub(crate) packet: fn() -> BoxedStrategy<Named>,
    /// Generates packets for streams.
    pub(crate) streamed: fn() -> BoxedStrategy<Packet>,
    /// The question of a probe; `None` if the documents leave the right answer unspecified.
    pub(crate) question: fn(&Author<'_>, &Probe) -> Option<Asked>,
}

/// A requirement, the question, and the right answer.
pub(crate) type Asked = (String, Question, Demand);

/// The probes of a wire; `None` if there are none yet.
pub(crate) fn of(wire: Wire) -> Option<Probes> {
    ALL.into_iter().find(|probes| probes.wire == wire)
}
