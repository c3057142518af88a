//! What a host is asked: calls on a line that plays a script, and what came of them.

use std::fmt;

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{Call, Direction};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Called, Hello, Wire};
use crate::legible::{LONGEST_TEXT, legible};

impl Hello {
    /// Whether it opens a port and makes calls.
    #[must_use]
    pub fn is_host(&self) -> bool {
        self.offers("open") && ["call", "exchange"].iter().any(|op| self.offers(op))
    }
}

/// A call of a host, and what the line does about it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Step {
    /// The packet that the call sends.
    pub packet: Called,
    /// What the line plays when it hears the packet: the first time, the second time, and so on. After
    /// that it is silent.
    pub answers: Vec<Vec<Burst>>,
    /// What comes after the call has returned, and before the next one.
    #[serde(default, skip_serializing_if = "is_empty")]
    pub late: HexBytes,
    /// Whether the next call follows at once, whatever is still on its way. Else it follows when all has
    /// come.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub hurries: bool,
}

fn is_empty(bytes: &HexBytes) -> bool {
    bytes.is_empty()
}

/// Bytes that the line plays.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Burst {
    /// How many milliseconds after the packet was heard.
    #[serde(default)]
    pub after_ms: u32,
    /// The bytes.
    pub bytes: HexBytes,
}

/// The call of an adapter's op `call`.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct CallTo {
    /// The call.
    #[serde(flatten)]
    pub call: Call,
    /// The ID or the address that the packet goes to.
    pub device: u8,
}

/// A call on a port in memory, and what the line does about it: the fields of the op `exchange`.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Exchange<'a> {
    /// The wire.
    pub wire: Wire,
    /// The call.
    pub call: CallTo,
    /// The packet that the line answers; empty if the call has more data than a packet can.
    pub frame: HexBytes,
    /// What the line plays when it hears the packet: the first time, the second time, and so on. After
    /// that it is silent.
    pub answers: &'a [Vec<Burst>],
    /// What comes after the call has returned, and before the next one.
    pub late: &'a HexBytes,
    /// Whether the next call follows at once, whatever is still on its way. Else it follows when all has
    /// come.
    pub hurries: bool,
}

/// What came of a call on a port in memory: the `ok` of `exchange`. Its times are those of the adapter's
/// clock.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct Exchanged {
    /// What the library sent, in order.
    pub sent: Vec<Sent>,
    /// How many milliseconds the call took.
    pub ms: u64,
    /// What it returned.
    #[serde(flatten)]
    pub returned: Returned,
}

/// Bytes that a library sent on a port in memory.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
pub struct Sent {
    /// How many milliseconds after the call began.
    pub at_ms: u64,
    /// The bytes.
    pub bytes: HexBytes,
}

/// What became of a step. It is the same as another if the same was sent and returned, whatever time it
/// took.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Course {
    /// The bytes on the line, in order.
    pub line: Vec<Passed>,
    /// Bytes that are not among them, as there were too many.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub more: usize,
    /// How many milliseconds the call took.
    pub ms: u64,
    /// Whether the machine was too busy for the line, so that the host may have missed an answer.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub late: bool,
    /// What the call returned.
    #[serde(flatten)]
    pub returned: Returned,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
const fn is_zero(number: &usize) -> bool {
    *number == 0
}

impl PartialEq for Course {
    fn eq(&self, other: &Self) -> bool {
        let returned = match (&self.returned, &other.returned) {
            (Returned::Err(error), Returned::Err(other)) => error.class == other.class,
            (returned, other) => returned == other,
        };
        returned && self.sent() == other.sent()
    }
}

impl Eq for Course {}

impl Course {
    /// The bytes that the host put on the line.
    #[must_use]
    pub fn sent(&self) -> Vec<u8> {
        let sent = self.line.iter().filter(|passed| passed.direction == Direction::Request);
        sent.flat_map(|passed| passed.bytes.0.clone()).collect()
    }
}

/// Bytes that passed on the line.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Passed {
    /// How many milliseconds after the call was asked.
    pub at_ms: u64,
    /// Which way.
    pub direction: Direction,
    /// The bytes.
    pub bytes: HexBytes,
}

/// What a call returned.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Returned {
    /// What the library's user gets, an entry a device that answered.
    Devices(Vec<Reported>),
    /// The library's error.
    Err(CallError),
}

/// What the library's user gets of a device. What the library does not tell is absent.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Reported {
    /// Its ID or its address.
    pub id: u8,
    /// The bytes that were read.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub data: Option<HexBytes>,
    /// Of `ping`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub model_number: Option<u16>,
    /// Of `ping`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub firmware_version: Option<u8>,
    /// Of a call that looks for devices: by what the device differs from others.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mac: Option<HexBytes>,
    /// The error number of its answer, if the library hands on what a device with an error says.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<u8>,
    /// Whether its answer had the alert.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub alert: Option<bool>,
}

impl Reported {
    /// Whether this is what another one says, as far as the library tells. It must tell the data, or an
    /// error number, beside which data mean nothing.
    #[must_use]
    pub fn fits(&self, right: &Self) -> bool {
        let told = |same: Option<bool>| same.unwrap_or(true);
        let Self { id, data, model_number, firmware_version, mac, error, alert } = self;
        *id == right.id
            && (*data == right.data
                || right.data.is_none() && data.as_ref().is_some_and(is_empty)
                || right.error.is_some())
            && error.unwrap_or_default() == right.error.unwrap_or_default()
            && told(model_number.map(|number| Some(number) == right.model_number))
            && told(firmware_version.map(|version| Some(version) == right.firmware_version))
            && told(mac.as_ref().map(|mac| Some(mac) == right.mac.as_ref()))
            && told(alert.map(|alert| alert == right.alert.unwrap_or_default()))
    }
}

/// An error that a library reports of a call.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct CallError {
    /// What went wrong.
    pub class: Trouble,
    /// An explanation in words.
    #[serde(default)]
    pub detail: String,
}

impl CallError {
    /// The same with an explanation that is legible and short.
    pub(crate) fn legible(self) -> Self {
        Self { detail: legible(&self.detail, LONGEST_TEXT), ..self }
    }
}

/// What went wrong in a call; these are the error classes of the ops of a host.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Trouble {
    /// There was no answer in time.
    Timeout,
    /// What came is no answer to the call: a wrong CRC, ID or length, noise.
    Corrupt,
    /// The device answered with an error number.
    Status,
    /// The library refuses the call, and sends nothing.
    Refused,
    /// The port could not be opened or used.
    Port,
    /// The library does not say what went wrong.
    Unspecified,
    /// An exception that is no error of the library's own. It always fails.
    Internal,
}

/// The word that the adapter protocol has for it.
impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// In words, such as `1: data a6000000`.
impl fmt::Display for Reported {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { id, data, model_number, firmware_version, mac, error, alert } = self;
        let facts = [
            data.as_ref().map(|data| format!("data {data}")),
            model_number.map(|number| format!("model {number}")),
            firmware_version.map(|version| format!("firmware {version}")),
            mac.as_ref().map(|mac| format!("MAC address {mac}")),
            error.map(|error| format!("error {error}")),
            alert.map(|alert| format!("alert {}", if alert { "on" } else { "off" })),
        ];
        let facts: Vec<_> = facts.into_iter().flatten().collect();
        let facts = if facts.is_empty() { "nothing more".to_owned() } else { facts.join(", ") };
        write!(f, "device {id}: {facts}")
    }
}

/// In words, such as `device 1: data a6000000` or `an error (timeout: no answer)`.
impl fmt::Display for Returned {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Devices(devices) if devices.is_empty() => f.write_str("no device"),
            Self::Devices(devices) => {
                let devices: Vec<_> = devices.iter().map(ToString::to_string).collect();
                f.write_str(&devices.join("; "))
            }
            Self::Err(CallError { class, detail }) => write!(f, "an error ({class}: {detail})"),
        }
    }
}

/// What passed on the line in a call, in words.
pub(crate) fn passed(line: &[Passed], more: usize) -> Vec<String> {
    let passed = line.iter().map(|Passed { at_ms, direction, bytes }| {
        let arrow = if *direction == Direction::Request { "->" } else { "<-" };
        format!("{arrow} {bytes} at {at_ms} ms")
    });
    let more = (more > 0).then(|| format!("and {more} bytes more"));
    passed.chain(more).collect()
}

/// A line each for what passed and what was returned, over several steps.
pub(super) fn told(steps: &[Course]) -> String {
    let told = |(place, step): (usize, &Course)| {
        let Course { line, more, returned, ms, .. } = step;
        let mut lines = passed(line, *more);
        lines.push(format!("returned {returned} after {ms} ms"));
        format!("call {}: {}", place + 1, lines.join(", "))
    };
    steps.iter().enumerate().map(told).collect::<Vec<_>>().join("; ")
}
