//! Checks of a host, one module per wire: it makes calls, on a line that plays a script.
//!
//! For each call a basic check looks at what the host puts on the line, and one at what it returns of a
//! right answer. All other checks rest on those of their calls.

pub(crate) mod dynamixel2;
pub(crate) mod innfos;

use std::borrow::Cow;

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{self, Call, Direction};

use super::Author;
use super::check::{Check, Demand};
use super::due::Due;
use super::plan::Family;
use crate::adapter::{Burst, Called, Course, Question, Reported, Step, Trouble, Wire};

/// The checks of a wire's hosts.
struct Checks {
    wire: Wire,
    /// The families, the basic ones first.
    families: for<'a> fn(Author<'a>) -> Vec<Family<'a>>,
    /// The calls whose basic checks a call rests on, as their ids name them, the most basic first.
    rests_on: fn(&Call) -> Vec<String>,
    /// Whether a host may send this at any time, beside what it is asked for.
    is_aside: fn(&[u8]) -> bool,
}

/// The wires whose hosts are checked.
const WIRES: [Checks; 2] = [
    Checks {
        wire: wire::dynamixel2::WIRE,
        families: dynamixel2::families,
        rests_on: dynamixel2::rests_on,
        is_aside: |_| false,
    },
    Checks {
        wire: wire::innfos::WIRE,
        families: innfos::families,
        rests_on: innfos::rests_on,
        is_aside: innfos::is_aside,
    },
];

/// What the basic checks of a call are about: what is sent, and what is returned.
const BASIC: [&str; 2] = ["sent", "result"];

/// What else than an answer may be reported where what comes is none.
const NO_ANSWER: [Trouble; 2] = [Trouble::Corrupt, Trouble::Timeout];

fn of_wire(wire: Wire) -> Option<&'static Checks> {
    WIRES.iter().find(|checks| checks.wire == wire)
}

/// Every check of a host, in a fixed order: the basic ones first.
pub(super) fn families(author: Author<'_>) -> Vec<Family<'_>> {
    of_wire(author.wire).map_or_else(Vec::new, |checks| (checks.families)(author))
}

/// The ids of the basic checks of the calls that are made.
pub(super) fn rests_on(
    wire: Wire,
    steps: &[Step],
) -> impl Iterator<Item = Cow<'static, str>> + use<'_> {
    let calls = steps.iter().filter_map(|step| step.packet.call.as_ref());
    let named = calls.flat_map(move |call| {
        of_wire(wire).map(|checks| (checks.rests_on)(call)).unwrap_or_default()
    });
    named.flat_map(move |stem| BASIC.map(|about| basic(wire, &stem, about).into()))
}

/// What a host puts on the line for a call that sends `frame`, without what it may send at any time.
pub(super) fn sent(wire: Wire, frame: &[u8], course: &Course) -> Vec<u8> {
    let is_aside = |bytes: &[u8]| of_wire(wire).is_some_and(|checks| (checks.is_aside)(bytes));
    let sent = course.line.iter().filter(|passed| passed.direction == Direction::Request);
    let own = sent.filter(|passed| passed.bytes.0 == frame || !is_aside(&passed.bytes));
    own.flat_map(|passed| passed.bytes.0.clone()).collect()
}

/// The id of a basic check of a call.
fn basic(wire: Wire, stem: &str, about: &str) -> String {
    format!("{wire}.host.basic.{stem}/{about}")
}

impl Author<'_> {
    /// Looks at what a host puts on the line for its last call.
    fn sent(&self, id: String, requirement: &str, steps: Vec<Step>) -> Check {
        let question = Question::Converse { wire: self.wire, steps };
        self.check(id, requirement, question, Demand::Send)
    }

    /// Looks at what a host returns of its last call.
    fn returned(&self, id: String, requirement: &str, steps: Vec<Step>, due: Due) -> Check {
        let question = Question::Converse { wire: self.wire, steps };
        self.check(id, requirement, question, Demand::Return(due))
    }
}

/// Bytes at once.
fn burst(bytes: impl Into<Vec<u8>>) -> Burst {
    later(0, bytes)
}

/// Bytes after some milliseconds.
fn later(after_ms: u32, bytes: impl Into<Vec<u8>>) -> Burst {
    Burst { after_ms, bytes: bytes.into().into() }
}

/// A call, and what answers it each time that it is sent.
fn step(packet: impl Into<wire::Packet>, answers: Vec<Vec<Burst>>) -> Step {
    Step { packet: Called::from(packet), answers, late: HexBytes::default(), hurries: false }
}

/// What a device's answer says that holds data.
fn data(id: u8, data: &[u8]) -> Reported {
    Reported { id, data: Some(data.to_vec().into()), ..Reported::default() }
}

/// These devices are returned, and no error.
fn all(devices: impl Into<Vec<Reported>>) -> Due {
    Due { devices: Some(devices.into()), ..Due::default() }
}

/// The call tells of no device, or fails: a host need not await an answer that has no data.
fn untold() -> Due {
    Due { or: NO_ANSWER.to_vec(), ..all([]) }
}

/// The call fails, as it has no answer.
fn failed() -> Due {
    Due { or: NO_ANSWER.to_vec(), ..Due::default() }
}
