//! What a device is asked on its port, and what came of it.

use std::collections::BTreeSet;
use std::fmt;

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::{Direction, Fast, Packet, Wire};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Called, Passed};

/// What a check may do to a device beside reading from it, and sending what must be refused.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
#[serde(rename_all = "kebab-case")]
pub enum Permission {
    /// It writes registers of the RAM area while torque is off, and sets them back.
    WriteRam,
    /// It writes registers of the EEPROM area, which wear, and sets them back. ID and rate are never
    /// written.
    Eeprom,
    /// It restarts the device, which forgets how many turns it has made.
    Reboot,
    /// It sets the device back to factory settings, and restores what it held. ID and rate are set back only if
    /// they are those of the factory already.
    Reset,
    /// It stores the control table in the device's backup area. What was stored there can't be read before, so it is
    /// not set back.
    Backup,
    /// It switches torque on and off, and sends the shaft a few degrees on and back.
    Motion,
}

impl Permission {
    /// All of them, from the least harmful on.
    pub const ALL: [Self; 6] =
        [Self::WriteRam, Self::Eeprom, Self::Reboot, Self::Reset, Self::Backup, Self::Motion];

    /// The word that the command line has for it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::WriteRam => "write-ram",
            Self::Eeprom => "eeprom",
            Self::Reboot => "reboot",
            Self::Reset => "reset",
            Self::Backup => "backup",
            Self::Motion => "motion",
        }
    }
}

/// What a check needs, or a run may do. Without any it reads, and nothing changes.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct Permissions(BTreeSet<Permission>);

impl Permissions {
    /// To read, and nothing more.
    pub const READ: Self = Self(BTreeSet::new());

    /// Those that are not among others.
    #[must_use]
    pub fn without(&self, others: &Self) -> Self {
        Self(self.0.difference(&others.0).copied().collect())
    }

    /// Whether this one is among them.
    #[must_use]
    pub fn has(&self, permission: Permission) -> bool {
        self.0.contains(&permission)
    }

    /// Whether nothing may change.
    #[must_use]
    pub fn only_read(&self) -> bool {
        self.0.is_empty()
    }
}

impl<const N: usize> From<[Permission; N]> for Permissions {
    fn from(permissions: [Permission; N]) -> Self {
        Self(permissions.into())
    }
}

impl FromIterator<Permission> for Permissions {
    fn from_iter<T: IntoIterator<Item = Permission>>(permissions: T) -> Self {
        Self(permissions.into_iter().collect())
    }
}

/// As the command line takes them, such as `write-ram,eeprom`; `read` if there are none.
impl fmt::Display for Permissions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words: Vec<_> = self.0.iter().map(|permission| permission.word()).collect();
        f.pad(&if words.is_empty() { "read".to_owned() } else { words.join(",") })
    }
}

/// Bytes for a device, and how many packets are awaited after them.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Asked {
    /// The instruction packet that is looked at, in words. What is damaged is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub packet: Option<Called>,
    /// If one packet of several devices answers: what it is asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fast: Option<Fast>,
    /// All that is sent.
    pub send: Vec<Piece>,
    /// How many packets must come after the last piece.
    pub awaits: usize,
    /// How often all is sent again if they do not come.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub again: u32,
    /// It is sent again too until the answer has no error and holds this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub until: Option<Bits>,
    /// Nothing more is sent if the answer has an error, or does not hold this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub only_if: Option<Bits>,
    /// What is sent is a Write of this number instead.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sum: Option<Sum>,
}

/// Bits of the number that the data of an answer are, low byte first.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Bits {
    /// The lowest of the bits.
    pub lowest: u8,
    /// How many bits they are.
    pub width: u8,
    /// The values that they may have, shifted down to bit 0.
    pub one_of: Vec<u64>,
}

impl Bits {
    /// Whether a number has them.
    #[must_use]
    pub fn are_in(&self, bytes: &[u8]) -> bool {
        let number =
            bytes.iter().rev().fold(0_u64, |number, byte| (number << 8) | u64::from(*byte));
        let ones = 1_u64.checked_shl(self.width.into()).map_or(u64::MAX, |end| end - 1);
        self.one_of.contains(&(number.checked_shr(self.lowest.into()).unwrap_or_default() & ones))
    }
}

/// A number that is written: what an earlier answer told, and more. Without that answer nothing is written.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Sum {
    /// The ID of the device.
    pub id: u8,
    /// The address that it is written to.
    pub address: u16,
    /// The step whose first answer has four bytes, low byte first: a signed number. The first step is 0.
    pub step: usize,
    /// How much more is written.
    pub by: i32,
}

impl Sum {
    /// The bytes of it, if the answer was such a number.
    #[must_use]
    pub fn bytes(&self, told: &[u8]) -> Option<[u8; 4]> {
        let told = i32::from_le_bytes(told.try_into().ok()?);
        Some(told.saturating_add(self.by).to_le_bytes())
    }
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
const fn is_zero(number: &u32) -> bool {
    *number == 0
}

impl Asked {
    /// The answers in what came back. One that several devices share is known by what it answers.
    pub(crate) fn packets(&self, wire: Wire, bytes: &[u8]) -> Vec<Packet> {
        let shared = self.fast.clone().map(|fast| wire.decode(bytes, &fast.into()));
        if let Some(Ok(packet)) = shared {
            return vec![packet];
        }
        let mut packets = wire.stream(&[bytes.to_vec().into()], Some(Direction::Reply));
        // What is sent may come back.
        packets.retain(|packet| packet.direction() == Direction::Reply);
        packets
    }
}

/// Bytes that are sent at once.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct Piece {
    /// The pause before them.
    #[serde(default)]
    pub after: Pause,
    /// The bytes.
    pub bytes: HexBytes,
}

/// A pause between bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Pause {
    /// None.
    #[default]
    None,
    /// A moment, in which the bytes before it arrive alone.
    Moment,
    /// As long as the device takes for an answer, and longer.
    Answer,
    /// So many milliseconds, in which a shaft turns.
    Ms(u16),
}

/// What passed on the line in a step. It is the same as another if the same bytes came back, whatever
/// time they took.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Heard {
    /// The bytes, in order.
    pub line: Vec<Passed>,
    /// Bytes that are not among them, as there were too many.
    #[serde(default, skip_serializing_if = "is_none")]
    pub more: usize,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
const fn is_none(number: &usize) -> bool {
    *number == 0
}

impl PartialEq for Heard {
    fn eq(&self, other: &Self) -> bool {
        self.received() == other.received() && self.more == other.more
    }
}

impl Eq for Heard {}

impl Heard {
    /// The bytes that came.
    #[must_use]
    pub fn received(&self) -> Vec<u8> {
        let came = self.line.iter().filter(|passed| passed.direction == Direction::Reply);
        came.flat_map(|passed| passed.bytes.0.clone()).collect()
    }
}

/// A line for each step, with what was sent and what came.
pub(super) fn told(steps: &[Heard]) -> String {
    let told = |step: &Heard| {
        let passed = step.line.iter().map(|Passed { at_ms, direction, bytes }| {
            let arrow = if *direction == Direction::Request { "->" } else { "<-" };
            format!("{arrow} {bytes} at {at_ms} ms")
        });
        let more = (step.more > 0).then(|| format!("and {} bytes more", step.more));
        passed.chain(more).collect::<Vec<_>>().join(", ")
    };
    steps.iter().map(told).collect::<Vec<_>>().join("; ")
}
