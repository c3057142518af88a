//! What devices answer, as the library's user gets it.

use std::io;

use actucheck_spec::model::HexBytes;
use serde::Serialize;

use super::faults::{Fault, Switch};
use super::inbox::{Packet, Status};
use super::packet::{HEADER, PREFIX, crc, unstuff};

/// The instruction of a status packet.
pub(crate) const STATUS: u8 = 0x55;
const ALERT: u8 = 0x80;

/// What a device has answered.
#[derive(Clone, Default, Serialize)]
#[serde(default)]
pub(crate) struct Device {
    pub(crate) id: u8,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) data: Option<HexBytes>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) model_number: Option<u16>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) firmware_version: Option<u8>,
    /// Its error number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) error: Option<u8>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) alert: Option<bool>,
}

/// Why a call has no result.
#[derive(Serialize)]
pub(crate) struct Failure {
    pub(crate) class: &'static str,
    detail: String,
}

impl Failure {
    pub(crate) fn new(class: &'static str, detail: impl Into<String>) -> Self {
        Self { class, detail: detail.into() }
    }

    /// Whether no answer came that is right.
    pub(crate) fn is_no_answer(&self) -> bool {
        matches!(self.class, "timeout" | "corrupt")
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::new("port", error.to_string())
    }
}

/// What comes of a call.
pub(crate) type Devices = Result<Vec<Device>, Failure>;

/// What a status packet says, if it has so many bytes of data or an error number.
pub(crate) fn judge(on: Switch, status: Status, length: usize) -> Result<Device, Failure> {
    let Status { id, error, mut data } = status;
    let number = if on.is(Fault::AlertAsError) { error } else { error & !ALERT };
    let alert = (error & ALERT != 0 && !on.is(Fault::DropsAlert)).then_some(true);
    if number != 0 && !on.is(Fault::IgnoresError) {
        return Ok(Device { id, error: Some(number), alert, ..Device::default() });
    }
    if on.is(Fault::ErrorByteAsData) {
        data.insert(0, error);
        data.pop();
    }
    if on.is(Fault::PanicsOnShort) {
        data = data[..length].to_vec();
    }
    if on.is(Fault::PadsWithZero) && data.len() < length {
        data.resize(length, 0);
    }
    if on.is(Fault::CutsToLength) {
        data.truncate(length);
    }
    if data.len() != length {
        let detail = format!("{} bytes of data came for {length}", data.len());
        return Err(Failure::new("corrupt", detail));
    }
    if on.is(Fault::SignedBytes) && data.first().is_some_and(|low| *low >= 0x80) {
        data[1..].fill(0xFF);
    }
    if on.is(Fault::HighByteFirst) {
        data.reverse();
    }
    if length > 0 && data.iter().all(|byte| *byte == 0) && on.is(Fault::ZeroIsNoValue) {
        return Err(Failure::new("timeout", "no value"));
    }
    let data = (length > 0).then_some(HexBytes(data));
    Ok(Device { id, data, alert, ..Device::default() })
}

/// The answer to a Ping in words.
pub(crate) fn ping(on: Switch, device: Device) -> Device {
    let data = device.data.map(|data| data.0);
    let Some([low, high, version]) = data.as_deref() else {
        return Device { data: None, ..device };
    };
    let high_first = on.is(Fault::ModelHighByteFirst);
    let from_bytes = if high_first { u16::from_be_bytes } else { u16::from_le_bytes };
    let model_number = Some(from_bytes([*low, *high]));
    Device { data: None, model_number, firmware_version: Some(*version), ..device }
}

/// What the blocks of a fast status packet say.
pub(crate) fn blocks(on: Switch, packet: &Packet, ids: &[u8], length: usize) -> Devices {
    let corrupt = |detail: &str| Failure::new("corrupt", detail);
    let stuffed = [&packet.body[1..], &packet.bytes[packet.bytes.len() - 2..]].concat();
    let unstuffed = if on.is(Fault::FastUnstuffs) { unstuff(on, &stuffed) } else { Some(stuffed) };
    let bytes = unstuffed.ok_or_else(|| corrupt("stuffing"))?;
    // Error, ID and CRC are there beside the data.
    let size = length + 4;
    if bytes.len() != size * ids.len() {
        return Err(corrupt("another number of bytes"));
    }
    let mut devices = Vec::new();
    for (place, (block, asked)) in bytes.chunks(size).zip(ids).enumerate() {
        let (found, end) = (&block[size - 2..], PREFIX + 1 + (place + 1) * size - 2);
        let expected = crc(on, &HEADER, &packet.bytes[HEADER.len()..end]).to_le_bytes();
        if found != expected && !on.is(Fault::FastLastCrcOnly) {
            return Err(corrupt("the CRC of a block"));
        }
        let id = if on.is(Fault::FastByPosition) { *asked } else { block[1] };
        if id != *asked {
            return Err(corrupt("the ID of a block"));
        }
        let error = if on.is(Fault::FastDropsError) { 0 } else { block[0] };
        let data = block[2..size - 2].to_vec();
        devices.push(judge(on, Status { id, error, data }, length)?);
    }
    Ok(devices)
}
