//! Packets of every kind: built and read they are the same again, and arbitrary bytes are read as
//! the reference reads them.

mod build;
mod several;

use actucheck_codec::dynamixel2::status::{PingStatus, Status, StatusError};
use actucheck_codec::dynamixel2::{Frame, Instruction, Kind, Request, frame};
use actucheck_codec::{ja40, layout};
use actucheck_spec::wire::dynamixel2::reference::{self, HEADER, PREFIX};
use arbitrary::Unstructured;

use crate::targets::model::{fault, packet};
use crate::targets::shown;

/// The input is read as a packet, and then as choices from which a packet is built.
///
/// # Panics
/// If the codec is wrong.
pub fn check(input: &[u8]) {
    read(input);
    let mut choices = Unstructured::new(input);
    // The choices may end early; then there is no packet.
    let _ = build::any(&mut choices);
}

/// Bytes are the packet, or have the fault, that the reference finds.
fn read(bytes: &[u8]) {
    let expected = reference::decode(bytes);
    let frame = match Frame::parse(bytes) {
        Ok(frame) => frame,
        Err(error) => {
            assert!(error.offset() <= bytes.len().max(PREFIX), "{error}");
            shown(&error);
            return assert_eq!(Err(fault(&error)), expected);
        }
    };
    assert_eq!(Ok(packet(&frame)), expected);

    let params: Vec<u8> = frame.params().collect();
    assert_eq!(frame.params_len(), params.len());
    let mut scratch = vec![0; params.len()];
    assert_eq!(frame.copy_params(&mut scratch), Ok(&params[..]));
    let mut buffer = vec![0; bytes.len()];
    let again = frame::encode(frame.id(), frame.instruction(), &[&params], &mut buffer);
    assert_eq!(again, Ok(bytes));
    assert_eq!(frame::encoded_len(frame.instruction(), &[&params]), Ok(bytes.len()));
    assert!(frame::max_encoded_len(params.len()) >= bytes.len());
    kind(&frame);
    assert_eq!(Frame::parse(&buffer), Ok(frame));
    walk(frame.instruction(), &params);

    // An instruction that is understood says again what it was read from.
    if let Ok(request) = Request::parse(&frame, &mut scratch).inspect_err(shown) {
        assert_eq!(request.encode(frame.id(), &mut buffer), Ok(bytes), "{request:?}");
    }
    if let Ok(status) = frame.status().inspect_err(shown) {
        read_status(&status, frame.id(), &params);
    }
}

/// A packet is a status packet if its instruction is 0x55.
fn kind(frame: &Frame<'_>) {
    match frame.kind() {
        Kind::Status(status) => {
            assert_eq!((status.id(), frame.instruction().code()), (frame.id(), 0x55));
        }
        Kind::Instruction(instruction) => {
            assert!(instruction == frame.instruction() && instruction.code() != 0x55);
        }
    }
}

fn read_status(status: &Status<'_>, id: u8, params: &[u8]) {
    let (error, data) = params.split_first().unwrap();
    assert_eq!((status.id(), status.error().0), (id, *error));
    assert_eq!(status.error().alert(), error & 0x80 != 0);
    assert_eq!(status.error().number().code(), error & 0x7F);
    let number = status.error().number();
    assert_eq!(StatusError::new(number, error & 0x80 != 0), status.error());
    assert!(status.data().eq(data.iter().copied()));
    assert_eq!(status.copy_data(&mut vec![0; data.len()]), Ok(data));

    let value = status.value(ja40::PRESENT_POSITION).inspect_err(shown);
    assert_eq!(value.ok(), <[u8; 4]>::try_from(data).ok().map(i32::from_le_bytes));
    let ping = status.ping().inspect_err(shown);
    assert_eq!(ping.is_ok(), data.len() == PingStatus::SIZE);
    assert_eq!(PingStatus::parse(data).inspect_err(shown), ping);
}

/// The fields of the parameters are contiguous and cover all of them.
fn walk(instruction: Instruction, params: &[u8]) {
    let layout = instruction.parameters().unwrap_or_default();
    let mut end = 0;
    for item in layout::fields(layout, params) {
        match item {
            Ok(item) => {
                assert_eq!(item.offset, end);
                let number = |bytes: [u8; 2]| u16::from_le_bytes(bytes).into();
                if let Ok(bytes) = item.bytes.try_into() {
                    assert_eq!(item.number(), Some(number(bytes)));
                }
                end += item.bytes.len();
            }
            Err(error) => {
                shown(&error);
                return assert!(error.offset() <= params.len(), "{error}");
            }
        }
    }
    assert!(layout.is_empty() || end == params.len(), "{end} of {} bytes", params.len());
}

/// Turns the input into a packet of which only the stuffing can be wrong.
pub fn repair(input: &mut [u8]) {
    let Some(length) = input.len().checked_sub(PREFIX).filter(|length| *length > 2) else { return };
    let [low, high] = u16::try_from(length).unwrap_or(u16::MAX).to_le_bytes();
    input[..4].copy_from_slice(&HEADER);
    input[5..PREFIX].copy_from_slice(&[low, high]);
    if let Some((before, crc)) = input.split_last_chunk_mut::<2>() {
        *crc = reference::crc(before).to_le_bytes();
    }
}
