//! The wires that probes are drawn of. A new one has a line in [`ALL`].

use actucheck_spec::wire::{Packet, Wire};
use proptest::prelude::BoxedStrategy;

use super::probe::{Named, Probe};
use super::{dynamixel2, innfos};
use crate::adapter::Question;
use crate::suite::Author;
use crate::suite::check::Demand;

const ALL: [Probes; 2] = [dynamixel2::PROBES, innfos::PROBES];

/// What is asked on a wire.
#[derive(Clone, Copy)]
pub(super) struct Probes {
    pub(super) wire: Wire,
    /// Draws packets.
    pub(super) packet: fn() -> BoxedStrategy<Named>,
    /// Draws packets of which streams are made.
    pub(super) streamed: fn() -> BoxedStrategy<Packet>,
    /// The question of a probe; `None` if the documents leave the right answer unspecified.
    pub(super) question: fn(&Author<'_>, &Probe) -> Option<Asked>,
}

/// A requirement, what is asked, and what is right.
pub(super) type Asked = (String, Question, Demand);

/// The probes of a wire; `None` if there are none yet.
pub(super) fn of(wire: Wire) -> Option<Probes> {
    ALL.into_iter().find(|probes| probes.wire == wire)
}
