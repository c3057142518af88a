//! The adapter protocol: the requests and replies between the suite and an adapter, one JSON object
//! per line. This is version 4; [`Request::in_version`] writes the requests of version 1. Those of
//! version 3 are the same, without the op `device`, and those of version 2 without the ops for ports too.

use std::fmt;

use actucheck_spec::model::{Fault, HexBytes, Role};
use actucheck_spec::wire::{Context, Direction, Form};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::called::Called;
use super::device::{Asked, Permissions};
use super::host::{CallTo, Exchange, Step};
use super::message::Told;
use super::value::{Given, RegisterOf};

/// The newest version of the adapter protocol.
pub const VERSION: u32 = 4;

/// The versions of the adapter protocol that this suite speaks.
pub const VERSIONS: [u32; 4] = [1, 2, 3, VERSION];

pub use actucheck_spec::wire::Wire;

/// What the suite says to an adapter, as it is sent over the pipe, without its id.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(tag = "op", rename_all = "lowercase")]
pub enum Request<'a> {
    /// Who are you, and what can you do?
    Hello {
        /// The versions of the adapter protocol that the suite speaks.
        protocol: &'a [u32],
    },
    /// Open a port, and close the one that is open.
    Open {
        /// The wire that is spoken there.
        wire: Wire,
        /// The path of a terminal; `tcp://HOST:PORT` or `udp://HOST:PORT` for a socket; `memory` for the
        /// adapter's own port, of which only `exchange` makes use.
        port: &'a str,
        /// The rate in bit/s, if the port has one.
        baud: u32,
    },
    /// Make a call through the port.
    Call {
        /// The wire.
        wire: Wire,
        /// The call.
        call: &'a CallTo,
    },
    /// Make a call through the port in memory.
    Exchange(&'a Exchange<'a>),
    /// Close the port.
    Close {
        /// The wire.
        wire: Wire,
    },
    /// Take bytes as a device, and say what the device sends.
    Device {
        /// The wire that is spoken.
        wire: Wire,
        /// How many milliseconds nothing passed on the line before these bytes.
        after_ms: u64,
        /// The bytes, which may be a part of a packet, or several.
        bytes: &'a HexBytes,
    },
    /// An op that no version of the protocol has.
    #[serde(rename = "no-such-op")]
    Invented,
    /// The end.
    Bye,
    /// A question about packets.
    #[serde(untagged)]
    Ask(&'a Question),
}

impl Request<'_> {
    /// The request as a JSON object in this version of the adapter protocol.
    #[must_use]
    pub fn in_version(&self, version: u32) -> String {
        // Every request has string keys only, so it can be written as JSON.
        match self {
            Self::Ask(question) if version == 1 => question.in_version_1(),
            request => json(request).unwrap_or_default(),
        }
    }
}

/// What is asked about the packets of a wire.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "op", rename_all = "lowercase")]
pub enum Question {
    /// The CRC of some bytes.
    Crc {
        /// Which CRC.
        wire: Wire,
        /// The bytes.
        bytes: HexBytes,
    },
    /// Byte stuffing added to a body.
    Stuff {
        /// The wire.
        wire: Wire,
        /// The body without stuffing.
        bytes: HexBytes,
    },
    /// Byte stuffing removed from a body.
    Unstuff {
        /// The wire.
        wire: Wire,
        /// The body with stuffing.
        bytes: HexBytes,
    },
    /// The bytes of a packet.
    Encode {
        /// The wire.
        wire: Wire,
        /// The packet.
        packet: Called,
    },
    /// The packet that the bytes encode.
    Decode {
        /// The wire.
        wire: Wire,
        /// One whole frame and nothing after it.
        bytes: HexBytes,
        /// Its direction, and for a fast status packet the request that it answers.
        #[serde(flatten)]
        context: Context,
    },
    /// The valid packets of a stream.
    Stream {
        /// The wire.
        wire: Wire,
        /// The stream in chunks; on a wire of datagrams each chunk is one.
        chunks: Vec<HexBytes>,
        /// The direction of the packets.
        #[serde(alias = "kind", skip_serializing_if = "Option::is_none")]
        direction: Option<Direction>,
    },
    /// The meaning of the bytes of a register, or the bytes of a meaning.
    Value {
        /// The wire.
        wire: Wire,
        /// The register.
        #[serde(flatten)]
        of: RegisterOf,
        /// The form of the value.
        #[serde(flatten)]
        form: Form,
        /// What is given. The rest is the answer.
        #[serde(flatten)]
        given: Given,
    },
    /// What a packet says, or the packet that says it.
    Message {
        /// The wire.
        wire: Wire,
        /// The form of the value, if there is one.
        #[serde(flatten)]
        form: Option<Form>,
        /// The actuator's model, if the full scale of the value is the model's.
        #[serde(skip_serializing_if = "Option::is_none")]
        actuator: Option<String>,
        /// What is given. The rest is the answer.
        #[serde(flatten)]
        told: Told,
    },
    /// What becomes of calls on a line that plays a script. No adapter gets it: it is asked for one call
    /// after the other, with the ops `open`, `call` or `exchange`, and `close`.
    #[schemars(skip)]
    Converse {
        /// The wire.
        wire: Wire,
        /// The calls, and what the line does.
        steps: Vec<Step>,
    },
    /// What a device answers on its port. No adapter gets it.
    #[schemars(skip)]
    Device {
        /// The wire.
        wire: Wire,
        /// What it may do to the device.
        #[serde(default)]
        needs: Permissions,
        /// Another device that is written to.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        neighbour: Option<u8>,
        /// What is sent, and how much is awaited.
        steps: Vec<Asked>,
    },
}

impl Question {
    /// The name of its op in the adapter protocol.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Crc { .. } => "crc",
            Self::Stuff { .. } => "stuff",
            Self::Unstuff { .. } => "unstuff",
            Self::Encode { .. } => "encode",
            Self::Decode { .. } => "decode",
            Self::Stream { .. } => "stream",
            Self::Value { .. } => "value",
            Self::Message { .. } => "message",
            Self::Converse { .. } => "call",
            Self::Device { .. } => "device",
        }
    }

    /// Version 1 has no general calls. It has no direction, but for wires whose frames do not state
    /// theirs a `kind`.
    fn in_version_1(&self) -> String {
        let mut question = self.clone();
        if let Self::Encode { packet, .. } = &mut question {
            packet.call.take_if(|call| call.is_general);
        }
        let direction = match &mut question {
            Self::Decode { context, .. } => context.direction.take(),
            Self::Stream { direction, .. } => direction.take(),
            _ => None,
        };
        let request = json(&question).unwrap_or_default();
        match (direction, request.strip_suffix('}')) {
            (Some(direction), Some(fields)) if !self.wire().tells_direction() => {
                format!("{fields},\"kind\":\"{direction}\"}}")
            }
            _ => request,
        }
    }

    /// The direction of the packets; `None` if the question has none or does not say.
    #[must_use]
    pub fn direction(&self) -> Option<Direction> {
        match self {
            Self::Encode { packet, .. } => Some(packet.packet.direction()),
            Self::Decode { context, .. } => context.direction,
            Self::Stream { direction, .. } => *direction,
            Self::Message { told, .. } => Some(told.direction()),
            Self::Value { .. }
            | Self::Crc { .. }
            | Self::Stuff { .. }
            | Self::Unstuff { .. }
            | Self::Converse { .. }
            | Self::Device { .. } => None,
        }
    }

    /// The role that does this: a host builds requests and reads replies, and a device builds
    /// replies and reads requests. `None` if both do.
    #[must_use]
    pub fn role(&self) -> Option<Role> {
        match self {
            Self::Converse { .. } => return Some(Role::Host),
            Self::Device { .. } => return Some(Role::Device),
            _ => {}
        }
        let builds = matches!(
            self,
            Self::Encode { .. }
                | Self::Value { given: Given::Value(_), .. }
                | Self::Message { told: Told::Message { .. }, .. }
        );
        self.direction().map(|direction| match (direction, builds) {
            (Direction::Request, true) | (Direction::Reply, false) => Role::Host,
            (Direction::Request, false) | (Direction::Reply, true) => Role::Device,
        })
    }

    /// The wire of the question.
    #[must_use]
    pub const fn wire(&self) -> Wire {
        match self {
            Self::Crc { wire, .. }
            | Self::Stuff { wire, .. }
            | Self::Unstuff { wire, .. }
            | Self::Encode { wire, .. }
            | Self::Decode { wire, .. }
            | Self::Stream { wire, .. }
            | Self::Value { wire, .. }
            | Self::Message { wire, .. }
            | Self::Converse { wire, .. }
            | Self::Device { wire, .. } => *wire,
        }
    }
}

/// As it is sent over the pipe, without its id.
impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&json(self)?)
    }
}

/// What an adapter says of itself; see [`super::Greeting::meant`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hello {
    /// The version of the adapter protocol that it speaks.
    pub protocol: u32,
    /// The implementation that it wraps.
    pub implementation: Implementation,
    /// The wires that it offers.
    pub wires: Vec<String>,
    /// The ops that it offers.
    pub ops: Vec<String>,
    /// The roles that it plays.
    pub roles: Vec<Role>,
    /// The calls that there are, if it says so.
    pub calls: Option<Vec<String>>,
    /// The maximum number of outstanding requests.
    pub max_in_flight: usize,
    /// The limits of the implementation.
    pub limits: Limits,
}

/// An implementation under test.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Implementation {
    /// Its name.
    pub name: String,
    /// Its version.
    pub version: String,
    /// The language that it is written in.
    pub language: String,
    /// Where to find it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub url: Option<String>,
}

/// The limits of an implementation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, JsonSchema)]
pub struct Limits {
    /// Size in bytes of the longest frame that it builds or reads. Version 1 has no other limit;
    /// in version 2 the limit for one of them only comes before it.
    pub max_packet: Option<usize>,
    /// Size in bytes of the longest frame that it builds.
    pub max_send: Option<usize>,
    /// Size in bytes of the longest frame that it reads.
    pub max_receive: Option<usize>,
}

impl Limits {
    /// Size in bytes of the longest frame that it builds.
    #[must_use]
    pub fn send(&self) -> Option<usize> {
        self.max_send.or(self.max_packet)
    }

    /// Size in bytes of the longest frame that it reads.
    #[must_use]
    pub fn receive(&self) -> Option<usize> {
        self.max_receive.or(self.max_packet)
    }
}

/// Why bytes or a packet are rejected.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Rejection {
    /// What is wrong.
    pub class: Fault,
    /// An explanation in words.
    #[serde(default)]
    pub detail: String,
}

pub(super) fn json(value: &impl Serialize) -> Result<String, fmt::Error> {
    serde_json::to_string(value).map_err(|_| fmt::Error)
}
