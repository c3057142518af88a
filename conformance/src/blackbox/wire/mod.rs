//! The wires with probes. A new wire has a line in [`ALL`].

mod dynamixel2;
mod innfos;

use actucheck_spec::Spec;
use actucheck_spec::wire::{Direction, Packet, Wire};
use proptest::prelude::BoxedStrategy;

use super::ask::Request;
use super::probe::Probe;
use super::talk::{Exchange, Talk};
use crate::adapter::{Hello, Limits, Permissions, Question};
use crate::suite::Author;
use crate::suite::check::Demand;
use crate::suite::device::Target;

const ALL: [Probes; 2] = [dynamixel2::PROBES, innfos::PROBES];

/// The probes of a wire.
#[derive(Clone, Copy)]
pub(crate) struct Probes {
    pub(crate) wire: Wire,
    /// Generates packets for an adapter with these limits.
    pub(crate) packet: fn(&Spec, &Limits) -> BoxedStrategy<Packet>,
    /// Generates packets of one direction for streams.
    pub(crate) streamed: fn(&Spec, &Limits, Direction) -> BoxedStrategy<Packet>,
    /// Generates what may come between the packets of a stream.
    pub(crate) noise: fn() -> BoxedStrategy<Vec<u8>>,
    /// The kind of a packet, in words.
    pub(crate) name: fn(&Spec, &Packet) -> String,
    /// Smaller packets of the same kind.
    pub(crate) smaller: fn(&Packet) -> Vec<Packet>,
    /// The requirement on packets that are too long.
    pub(crate) limit: &'static str,
    /// The question of a probe; `None` if the documents leave the right answer unspecified.
    pub(crate) question: fn(&Author<'_>, &Probe) -> Option<Asked>,
    /// Conversations of hosts; `None` if there are none yet.
    pub(crate) host: Option<HostProbes>,
    /// Generates requests to a device; `None` if there are none yet.
    pub(crate) requests: Option<Requests>,
}

/// Generates requests to a device.
pub(crate) type Requests = fn(Author<'_>, &Target<'_>, &Permissions) -> BoxedStrategy<Vec<Request>>;

/// Conversations of hosts on a wire.
#[derive(Clone, Copy)]
pub(crate) struct HostProbes {
    /// Generates conversations for a host that says `hello`; `None` if it has no call that is asked.
    pub(crate) talk: fn(&Spec, &Hello) -> Option<BoxedStrategy<Talk>>,
    /// The same exchange with plainer packets, in the call and in its answers alike.
    pub(crate) smaller: fn(&Exchange) -> Vec<Exchange>,
}

/// A requirement, the question, and the right answer.
pub(crate) type Asked = (String, Question, Demand);

/// The probes of a wire; `None` if there are none yet.
pub(crate) fn of(wire: Wire) -> Option<Probes> {
    ALL.into_iter().find(|probes| probes.wire == wire)
}
