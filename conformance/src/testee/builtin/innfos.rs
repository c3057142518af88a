//! The codec's INNFOS side.

use actucheck_codec::innfos::{self, Command, Frame, FrameError, Kind};
use actucheck_codec::{EncodeError, crc};
use actucheck_spec::model::{Fault, FrameKind, HexBytes, Packet};

use super::{Result, output, rejection};
use crate::protocol::{Op, Output};

/// Does what is asked with a buffer for a frame; `None` for an op that the wire does not have.
pub(super) fn ask(op: &Op, buffer: &mut [u8]) -> Option<Result> {
    Some(match op {
        Op::Crc { bytes, .. } => Ok(Output::Crc(crc::modbus(bytes).into())),
        Op::Encode { packet, .. } => encode(&packet.packet, buffer),
        Op::Decode { bytes, kind, .. } => Frame::parse(way(*kind), bytes)
            .map(|frame| Output::Packet(packet(&frame)))
            .map_err(|error| rejection(fault(&error), &error)),
        Op::Stream { chunks, kind, .. } => Ok(stream(chunks, way(*kind))),
        _ => return None,
    })
}

fn encode(packet: &Packet, buffer: &mut [u8]) -> Result {
    let (kind, address, command, data) = match packet {
        Packet::Request { address, command, data } => (Kind::Request, address, command, data),
        Packet::Reply { address, command, data } => (Kind::Reply, address, command, data),
        _ => return Err(rejection(Fault::Internal, &"a packet of another wire")),
    };
    innfos::encode(kind, *address, Command::from_code(*command), data, buffer)
        .map(output)
        .map_err(|error: EncodeError| rejection(Fault::Oversize, &error))
}

/// The good frames of each datagram.
fn stream(datagrams: &[HexBytes], kind: Kind) -> Output {
    let frames = datagrams.iter().flat_map(|datagram| innfos::frames(kind, datagram));
    Output::Packets(frames.filter_map(|frame| frame.ok().as_ref().map(packet)).collect())
}

fn packet(frame: &Frame<'_>) -> Packet {
    let (address, command) = (frame.address(), frame.command().code());
    let data = frame.data().to_vec().into();
    match frame.kind() {
        Kind::Request => Packet::Request { address, command, data },
        Kind::Reply => Packet::Reply { address, command, data },
    }
}

fn way(kind: Option<FrameKind>) -> Kind {
    if kind == Some(FrameKind::Reply) { Kind::Reply } else { Kind::Request }
}

fn fault(error: &FrameError) -> Fault {
    match error {
        FrameError::Header { .. } => Fault::Header,
        FrameError::Truncated { .. } => Fault::Truncated,
        FrameError::Tail { .. } => Fault::Tail,
        FrameError::Trailing { .. } => Fault::Trailing,
        FrameError::Crc { .. } => Fault::Crc,
    }
}
