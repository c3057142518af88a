//! The codec's results in the types of the spec's model.

use actucheck_codec::dynamixel2::stream::{self, Reason};
use actucheck_codec::dynamixel2::{Frame, FrameError};
use actucheck_spec::model::Fault;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::{Event, encode};

/// The packet of a frame.
///
/// # Panics
/// If its parameters are others when they are copied.
pub(crate) fn packet(frame: &Frame<'_>) -> Packet {
    let mut params: Vec<u8> = frame.params().collect();
    // Only with room for whole windows, and bytes after the frame, are they moved window by window.
    let mut buffer = vec![0; params.len() + 128];
    assert_eq!(frame.copy_params(&mut buffer), Ok(&params[..]));
    let (id, instruction) = (frame.id(), frame.instruction().code());
    match frame.error() {
        None => Packet::Instruction { id, instruction, params: params.into() },
        Some(error) => {
            params.remove(0);
            Packet::Status { id, error: error.0, params: params.into() }
        }
    }
}

/// The fault of a frame.
pub(crate) fn fault(error: &FrameError) -> Fault {
    match error {
        FrameError::Header { .. } => Fault::Header,
        FrameError::Id { .. } | FrameError::BlockId { .. } => Fault::Id,
        FrameError::Length { .. } => Fault::Length,
        FrameError::Truncated { .. } => Fault::Truncated,
        FrameError::Trailing { .. } => Fault::Trailing,
        FrameError::Crc { .. } => Fault::Crc,
        FrameError::Stuffing { .. } => Fault::Stuffing,
        FrameError::Instruction { .. } => Fault::Instruction,
    }
}

/// An event of a stream. The parser does not return a packet's bytes, so they are encoded again.
pub(crate) fn event(event: stream::Event<'_>) -> Event {
    match event {
        stream::Event::Frame(frame) => {
            let packet = packet(&frame);
            Event::Packet(encode(&packet).unwrap(), packet)
        }
        stream::Event::FastStatus(status) => Event::FastStatus(status.bytes().to_vec()),
        stream::Event::Skipped { bytes, reason } => {
            let fault = match reason {
                Reason::Garbage => Fault::Header,
                Reason::Id => Fault::Id,
                Reason::Length => Fault::Length,
                Reason::Oversize => Fault::Oversize,
                Reason::Stuffing => Fault::Stuffing,
                Reason::Crc => Fault::Crc,
                Reason::Truncated => Fault::Truncated,
            };
            Event::Skipped(usize::try_from(bytes).unwrap(), fault)
        }
    }
}
