//! The adapter protocol, version 1: the requests and replies between the suite and an adapter, one
//! JSON object per line.

use std::fmt;

use actucheck_spec::model::{Fault, HexBytes};
use actucheck_spec::wire::{Call, Direction, Fast, Packet};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The version of the adapter protocol that this suite speaks.
pub const VERSION: u32 = 1;

pub use actucheck_spec::wire::Wire;

/// What the suite says to an adapter, as it is sent over the pipe, without its id.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "op", rename_all = "lowercase")]
pub enum Request<'a> {
    /// Who are you, and what can you do?
    Hello {
        /// The versions of the adapter protocol that the suite speaks.
        protocol: &'a [u32],
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
        /// For a fast status packet: the request that it answers.
        #[serde(skip_serializing_if = "Option::is_none")]
        fast: Option<Fast>,
        /// The direction of the frame, if the frame itself does not state it.
        #[serde(skip_serializing_if = "Option::is_none")]
        kind: Option<Direction>,
    },
    /// The valid packets of a stream.
    Stream {
        /// The wire.
        wire: Wire,
        /// The stream in chunks; on a wire of datagrams each chunk is one.
        chunks: Vec<HexBytes>,
        /// The direction of the frames, if the frames themselves do not state it.
        #[serde(skip_serializing_if = "Option::is_none")]
        kind: Option<Direction>,
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
        }
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
            | Self::Stream { wire, .. } => *wire,
        }
    }
}

/// As it is sent over the pipe, without its id.
impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&json(self)?)
    }
}

/// A packet, with the call that sends it for libraries that have calls instead of packets.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Called {
    /// The packet.
    #[serde(flatten)]
    pub packet: Packet,
    /// The same request as a call; only for instruction packets that have one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub call: Option<Call>,
}

impl<'de> Deserialize<'de> for Called {
    /// The call is derived from the packet again, as it has the same content.
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut fields = serde_json::Map::deserialize(deserializer)?;
        let called = fields.remove("call").is_some();
        let packet: Packet =
            serde_json::from_value(Value::Object(fields)).map_err(serde::de::Error::custom)?;
        let call = called.then(|| packet.wire().call(&packet)).flatten();
        Ok(Self { packet, call })
    }
}

impl<P: Into<Packet>> From<P> for Called {
    fn from(packet: P) -> Self {
        let packet = packet.into();
        Self { call: packet.wire().call(&packet), packet }
    }
}

/// An adapter's answer to `hello`.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct Hello {
    /// The version of the adapter protocol that it speaks.
    pub protocol: u32,
    /// The implementation that it wraps.
    pub implementation: Implementation,
    /// The wires that it offers.
    pub wires: Vec<String>,
    /// The ops that it offers.
    pub ops: Vec<String>,
    /// The maximum number of outstanding requests.
    #[serde(default = "one")]
    pub max_in_flight: usize,
    /// The limits of the implementation.
    #[serde(default)]
    pub limits: Limits,
}

const fn one() -> usize {
    1
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
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
pub struct Limits {
    /// Size in bytes of the longest frame that it builds or reads.
    pub max_packet: Option<usize>,
}

/// Why bytes or a packet are rejected.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Rejection {
    /// What is wrong.
    pub class: Fault,
    /// An explanation in words.
    #[serde(default)]
    pub detail: String,
}

/// The result of a successful op.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Output {
    /// Of `crc`.
    Crc(u64),
    /// Of `stuff`, `unstuff` and `encode`.
    Bytes(HexBytes),
    /// Of `decode`.
    Packet(Packet),
    /// Of `stream`.
    Packets(Vec<Packet>),
}

impl Output {
    /// Of `stream`, the packets of one wire.
    pub fn packets<P: Into<Packet>>(packets: impl IntoIterator<Item = P>) -> Self {
        Self::Packets(packets.into_iter().map(Into::into).collect())
    }

    /// Reads the `ok` object of a reply to `op`.
    ///
    /// # Errors
    /// What is wrong with the object.
    pub fn read(op: &Question, ok: Value) -> Result<Self, serde_json::Error> {
        #[derive(Deserialize)]
        struct Crc {
            crc: u64,
        }
        #[derive(Deserialize)]
        struct Bytes {
            bytes: HexBytes,
        }
        #[derive(Deserialize)]
        struct One {
            packet: Packet,
        }
        #[derive(Deserialize)]
        struct Many {
            packets: Vec<Packet>,
        }
        Ok(match op {
            Question::Crc { .. } => Self::Crc(serde_json::from_value::<Crc>(ok)?.crc),
            Question::Decode { .. } => Self::Packet(serde_json::from_value::<One>(ok)?.packet),
            Question::Stream { .. } => Self::Packets(serde_json::from_value::<Many>(ok)?.packets),
            _ => Self::Bytes(serde_json::from_value::<Bytes>(ok)?.bytes),
        })
    }
}

/// Writes a CRC as a hexadecimal number, bytes in hex, and packets as JSON.
impl fmt::Display for Output {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Crc(crc) => write!(f, "{crc:#06X}"),
            Self::Bytes(bytes) => bytes.fmt(f),
            Self::Packet(packet) => f.write_str(&json(packet)?),
            Self::Packets(packets) => f.write_str(&json(packets)?),
        }
    }
}

fn json(value: &impl Serialize) -> Result<String, fmt::Error> {
    serde_json::to_string(value).map_err(|_| fmt::Error)
}
