//! An instruction packet in words, for libraries that have a call an instruction rather than
//! packets.

use schemars::JsonSchema;
use serde::Serialize;

use crate::model::{HexBytes, Packet};

/// A call. Its name is the instruction's; it has the fields that the documents give this
/// instruction's parameters.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Call {
    name: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    address: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    data: Option<HexBytes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    option: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    params: Option<HexBytes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ids: Option<Vec<u8>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    devices: Option<Vec<Target>>,
}

/// One device of a call for several. The data of a write says its own length; a read has no data.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
struct Target {
    id: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    address: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    data: Option<HexBytes>,
}

impl Call {
    /// The call that sends this packet; `None` if it is no instruction packet, has an unknown
    /// instruction, or its parameters do not fit the instruction.
    #[must_use]
    pub fn of(packet: &Packet) -> Option<Self> {
        let Packet::Instruction { instruction, params, .. } = packet else { return None };
        let params = params.0.as_slice();
        match *instruction {
            0x01 => Self::plain("ping", params),
            0x02 => Self::read("read", params),
            0x03 => Self::write("write", params),
            0x04 => Self::write("reg_write", params),
            0x05 => Self::plain("action", params),
            0x06 => Self::factory_reset(params),
            0x08 => Self::plain("reboot", params),
            // The meaning of their bytes is a device's own; a call takes them as they are.
            0x10 => Some(Self::with_params("clear", params)),
            0x20 => Some(Self::with_params("control_table_backup", params)),
            0x82 => Self::sync_read("sync_read", params),
            0x83 => Self::sync_write("sync_write", params),
            0x8A => Self::sync_read("fast_sync_read", params),
            0x8B => Self::sync_write("fast_sync_write", params),
            0x92 => Some(Self::to_each("bulk_read", bulk_read(params)?)),
            0x93 => Some(Self::to_each("bulk_write", bulk_write(params)?)),
            _ => None,
        }
    }

    fn named(name: &'static str) -> Self {
        Self { name, ..Self::default() }
    }

    fn plain(name: &'static str, params: &[u8]) -> Option<Self> {
        params.is_empty().then(|| Self::named(name))
    }

    fn with_params(name: &'static str, params: &[u8]) -> Self {
        Self { params: Some(params.to_vec().into()), ..Self::named(name) }
    }

    fn factory_reset(params: &[u8]) -> Option<Self> {
        let [option] = *params else { return None };
        Some(Self { option: Some(option), ..Self::named("factory_reset") })
    }

    fn read(name: &'static str, params: &[u8]) -> Option<Self> {
        let (address, params) = number(params)?;
        let (length, []) = number(params)? else { return None };
        Some(Self { address: Some(address), length: Some(length), ..Self::named(name) })
    }

    fn write(name: &'static str, params: &[u8]) -> Option<Self> {
        let (address, data) = number(params)?;
        Some(Self { address: Some(address), data: Some(data.to_vec().into()), ..Self::named(name) })
    }

    fn sync_read(name: &'static str, params: &[u8]) -> Option<Self> {
        let (address, params) = number(params)?;
        let (length, ids) = number(params)?;
        let (address, length, ids) = (Some(address), Some(length), Some(ids.to_vec()));
        Some(Self { address, length, ids, ..Self::named(name) })
    }

    fn sync_write(name: &'static str, params: &[u8]) -> Option<Self> {
        let (address, params) = number(params)?;
        let (length, mut rest) = number(params)?;
        let mut devices = Vec::new();
        while let [id, behind @ ..] = rest {
            let (data, next) = behind.split_at_checked(length.into())?;
            let data = Some(data.to_vec().into());
            devices.push(Target { id: *id, data, ..Target::default() });
            rest = next;
        }
        let (address, length) = (Some(address), Some(length));
        Some(Self { address, length, ..Self::to_each(name, devices) })
    }

    fn to_each(name: &'static str, devices: Vec<Target>) -> Self {
        let devices = Some(devices).filter(|devices| !devices.is_empty());
        Self { devices, ..Self::named(name) }
    }
}

fn bulk_read(params: &[u8]) -> Option<Vec<Target>> {
    let mut devices = Vec::new();
    let mut rest = params;
    while let [id, behind @ ..] = rest {
        let (address, behind) = number(behind)?;
        let (length, next) = number(behind)?;
        let (address, length) = (Some(address), Some(length));
        devices.push(Target { id: *id, address, length, data: None });
        rest = next;
    }
    Some(devices)
}

fn bulk_write(params: &[u8]) -> Option<Vec<Target>> {
    let mut devices = Vec::new();
    let mut rest = params;
    while let [id, behind @ ..] = rest {
        let (address, behind) = number(behind)?;
        let (length, behind) = number(behind)?;
        let (data, next) = behind.split_at_checked(length.into())?;
        let data = Some(data.to_vec().into());
        devices.push(Target { id: *id, address: Some(address), length: None, data });
        rest = next;
    }
    Some(devices)
}

/// The first two bytes, low byte first, and what follows them.
fn number(bytes: &[u8]) -> Option<(u16, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    Some((u16::from_le_bytes(*number), rest))
}
