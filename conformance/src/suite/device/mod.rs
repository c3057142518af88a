//! Checks of a device on its port, one module per wire: packets are sent to it, and what comes back is
//! looked at.
//!
//! Nothing is demanded that waits for silence to show: after what must not be answered comes a request that
//! must, and only its answer may be there. All bytes come from the reference model.

pub(crate) mod dynamixel2;
pub(crate) mod innfos;
mod steps;

use std::borrow::Cow;
use std::ops::RangeInclusive;
use std::time::Duration;

use actucheck_spec::Spec;
use actucheck_spec::model;
use actucheck_spec::wire::{self, Packet};

use super::Author;
use super::check::Demand;
use super::plan::Family;
use crate::adapter::{Asked, Permissions, Question, Reported, Wire};
use crate::bus;
use crate::journal::Place;

/// A device that is checked, and what else is on its line.
#[derive(Clone, Debug)]
pub struct Target<'a> {
    /// Its ID or its address.
    pub id: u8,
    /// Its control table, if it is known.
    pub device: Option<&'a model::Device>,
    /// Another device on the line that may be asked too.
    pub neighbour: Option<Neighbour<'a>>,
    /// The IDs of all devices on the line, by rising ID.
    pub present: Vec<u8>,
}

/// Another device on the line of the one that is checked.
#[derive(Clone, Copy, Debug)]
pub struct Neighbour<'a> {
    /// Its ID or its address.
    pub id: u8,
    /// Its control table, if it may be written to: it told the model number that the table has.
    pub device: Option<&'a model::Device>,
}

impl<'a> Target<'a> {
    /// A device with ID 1 that is alone on its line.
    #[must_use]
    pub fn alone(device: Option<&'a model::Device>) -> Self {
        Self { id: 1, device, neighbour: None, present: vec![1] }
    }

    /// An ID that no device on the line has.
    pub(crate) fn absent(&self, wire: Wire) -> u8 {
        let is_absent = |id: &u8| !self.present.contains(id) && *id != self.id;
        ids(wire).find(is_absent).unwrap_or(*ids(wire).end())
    }

    /// The same device with its neighbour, and the control table of that if it may be written to.
    #[must_use]
    pub fn with_neighbour(mut self, id: u8, device: Option<&'a model::Device>) -> Self {
        self.neighbour = Some(Neighbour { id, device });
        if let Err(place) = self.present.binary_search(&id) {
            self.present.insert(place, id);
        }
        self
    }
}

/// What a wire has for devices.
struct Own {
    wire: Wire,
    families: for<'a> fn(Author<'a>, &Target<'a>) -> Vec<Family<'a>>,
    /// What an answer says of each device that it is from.
    reported: fn(&Packet) -> Vec<Reported>,
    /// What comes before everything else, if anything does. All devices are looked for after it.
    greeting: Option<fn() -> Packet>,
    /// The packet that asks whether a device is there.
    hello: fn(u8) -> Packet,
    /// The packet that asks all devices whether they are there.
    hello_all: fn() -> Packet,
    /// What a device says of itself in the answer to that.
    identity: fn(&Reported) -> Identity,
    /// How much longer the answer to these bytes may take than to others.
    takes: fn(&[u8]) -> Duration,
    /// What changes registers, if its devices have some.
    instructions: Option<Instructions>,
    /// What its devices hold if they have no control tables: first whether the shaft may turn, then all that
    /// is set back.
    kept: Option<fn(&Spec) -> Vec<Place>>,
    /// What any requests that only read must come to.
    conversation: Option<Conversation>,
    /// The registers of the neighbour that checks write to, if some do.
    written_beside: Option<WrittenBeside>,
}

/// The registers of the neighbour that checks write to.
type WrittenBeside = for<'a> fn(Author<'a>, &Target<'a>) -> Vec<&'a model::Register>;

/// Writes a question and what must come back, of requests that are each sent in pieces.
type Conversation = fn(
    Author<'_>,
    (&Target<'_>, &Permissions),
    &[Vec<Vec<u8>>],
) -> Option<(String, Question, Demand)>;

/// The packets by which registers are read and set back.
#[derive(Clone, Copy, Debug)]
pub struct Instructions {
    /// Reads so many bytes of a device from an address on.
    pub read: fn(u8, u16, u16) -> Packet,
    /// Writes bytes to a device from an address on.
    pub write: fn(u8, u16, &[u8]) -> Packet,
    /// Lets a device carry out the write that waits, if writes may.
    pub action: Option<fn(u8) -> Packet>,
    /// Restarts a device, if a packet can.
    pub reboot: Option<fn(u8) -> Packet>,
    /// What was read, in the data of an answer.
    pub held: fn(&[u8]) -> &[u8],
}

/// What a device says of itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Identity {
    /// Its model number.
    pub model_number: Option<u16>,
    /// The version of its firmware.
    pub firmware_version: Option<u8>,
}

/// The wires whose devices are checked.
static WIRES: [Own; 2] = [
    Own {
        wire: wire::dynamixel2::WIRE,
        families: dynamixel2::families,
        reported: dynamixel2::reported,
        greeting: None,
        hello: dynamixel2::hello,
        hello_all: dynamixel2::hello_all,
        takes: |_| Duration::ZERO,
        identity: dynamixel2::identity,
        instructions: Some(dynamixel2::INSTRUCTIONS),
        kept: None,
        conversation: Some(dynamixel2::conversation),
        written_beside: Some(dynamixel2::written_beside),
    },
    Own {
        wire: wire::innfos::WIRE,
        families: innfos::families,
        reported: innfos::reported,
        greeting: Some(innfos::greeting),
        hello: innfos::hello,
        hello_all: innfos::hello_all,
        takes: innfos::takes,
        identity: innfos::identity,
        instructions: Some(innfos::INSTRUCTIONS),
        kept: Some(innfos::kept),
        conversation: Some(innfos::conversation),
        written_beside: None,
    },
];

fn own(wire: Wire) -> Option<&'static Own> {
    WIRES.iter().find(|own| own.wire == wire)
}

/// Whether devices on this wire are checked.
#[must_use]
pub fn is_checked(wire: Wire) -> bool {
    own(wire).is_some()
}

/// The IDs or addresses that a device on this wire may have.
#[must_use]
pub fn ids(wire: Wire) -> RangeInclusive<u8> {
    bus::ids(wire)
}

/// Whether devices on this wire have control tables.
#[must_use]
pub fn has_tables(wire: Wire) -> bool {
    bus::has_tables(wire)
}

/// Whether packets on this wire are datagrams, so that no serial port has them.
#[must_use]
pub fn has_datagrams(wire: Wire) -> bool {
    bus::has_datagrams(wire)
}

/// Every check of a device, in a fixed order: the basic ones first.
pub(super) fn families<'a>(author: Author<'a>, target: &Target<'a>) -> Vec<Family<'a>> {
    own(author.wire).map_or_else(Vec::new, |own| (own.families)(author, target))
}

/// What an answer says of each device that it is from.
#[must_use]
pub fn reported(wire: Wire, packet: &Packet) -> Vec<Reported> {
    own(wire).map_or_else(Vec::new, |own| (own.reported)(packet))
}

/// The packet that comes before everything else, if one does. After it all devices are looked for.
#[must_use]
pub fn greeting(wire: Wire) -> Option<Packet> {
    Some((own(wire)?.greeting?)())
}

/// How much longer the answer to these bytes may take than to others.
#[must_use]
pub fn takes(wire: Wire, bytes: &[u8]) -> Duration {
    own(wire).map_or(Duration::ZERO, |own| (own.takes)(bytes))
}

/// The packet that asks whether a device is there.
#[must_use]
pub fn hello(wire: Wire, id: u8) -> Option<Packet> {
    own(wire).map(|own| (own.hello)(id))
}

/// The packet that asks all devices whether they are there.
#[must_use]
pub fn hello_all(wire: Wire) -> Option<Packet> {
    own(wire).map(|own| (own.hello_all)())
}

/// What a device says of itself in its answer to such a packet.
#[must_use]
pub fn identity(wire: Wire, answer: &Reported) -> Identity {
    own(wire).map(|own| (own.identity)(answer)).unwrap_or_default()
}

/// The packets by which registers of this wire's devices are read and set back.
#[must_use]
pub fn instructions(wire: Wire) -> Option<&'static Instructions> {
    own(wire)?.instructions.as_ref()
}

/// What devices of this wire hold, if they have no control tables: first whether the shaft may turn, then all
/// that is set back.
#[must_use]
pub fn kept(wire: Wire, spec: &Spec) -> Option<Vec<Place>> {
    own(wire)?.kept.map(|kept| kept(spec))
}

/// The registers of a device's neighbour that checks write to, where that is allowed.
#[must_use]
pub fn written_beside<'a>(
    spec: &'a Spec,
    wire: Wire,
    target: &Target<'a>,
) -> Vec<&'a model::Register> {
    let written = own(wire).and_then(|own| own.written_beside);
    written.map_or_else(Vec::new, |written| written(Author { spec, wire }, target))
}

/// The requirement that the last of these requests is about, the question that asks them all, and what must
/// come back; each request is the pieces that are sent. `None` if one of them might change something that it may
/// not, or if the documents leave unspecified what answers it.
pub(crate) fn conversation(
    author: Author<'_>,
    device: (&Target<'_>, &Permissions),
    requests: &[Vec<Vec<u8>>],
) -> Option<(String, Question, Demand)> {
    (own(author.wire)?.conversation?)(author, device, requests)
}

/// The ids of the basic checks that an answer rests on: that the device answers at all, and for each call
/// that it answers such a call.
pub(super) fn rests_on(
    wire: Wire,
    steps: &[Asked],
) -> impl Iterator<Item = Cow<'static, str>> + use<'_> {
    let calls = steps.iter().filter_map(|step| step.packet.as_ref()?.call.as_ref());
    let hello = hello(wire, 0).and_then(|hello| Some(wire.call(&hello)?.name));
    hello.into_iter().chain(calls.map(|call| call.name)).map(move |name| basic(wire, name).into())
}

/// The id of the basic check of a call.
fn basic(wire: Wire, call: &str) -> String {
    format!("{wire}.device.basic.{}/answer", call.replace('_', "-"))
}
