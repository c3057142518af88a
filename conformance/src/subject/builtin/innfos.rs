//! The codec's INNFOS Ethernet protocol.

use actucheck_codec::crc;
use actucheck_codec::innfos::{self, Command, Frame, FrameError, Kind};
use actucheck_spec::model::{Fault, FrameKind, HexBytes, Packet};

use super::{Answer, Result, answer, not_offered, output, rejection, unbuilt};
use crate::adapter::{Output, Question};

/// The codec's answer to a question.
pub(super) fn ask(question: &Question, buffer: &mut [u8]) -> Answer {
    answer(match question {
        Question::Crc { bytes, .. } => Ok(Output::Crc(crc::modbus(bytes).into())),
        Question::Encode { packet, .. } => encode(&packet.packet, buffer),
        Question::Decode { bytes, kind: Some(kind), .. } => decode(*kind, bytes),
        Question::Stream { chunks, kind: Some(kind), .. } => Ok(stream(*kind, chunks)),
        _ => return Answer::Skipped(format!("the codec has no {}", question.name())),
    })
}

fn encode(packet: &Packet, buffer: &mut [u8]) -> Result {
    let (kind, address, command, data) = match packet {
        Packet::Request { address, command, data } => (Kind::Request, address, command, data),
        Packet::Reply { address, command, data } => (Kind::Reply, address, command, data),
        _ => return Err(not_offered()),
    };
    let command = Command::from_code(*command);
    innfos::encode(kind, *address, command, data, buffer)
        .map(output)
        .map_err(|error| unbuilt(&error))
}

fn decode(kind: FrameKind, bytes: &[u8]) -> Result {
    let frame = Frame::parse(of(kind), bytes);
    frame.map(|frame| Output::Packet(packet(&frame))).map_err(|error| {
        let class = match error {
            FrameError::Header { .. } => Fault::Header,
            FrameError::Truncated { .. } => Fault::Truncated,
            FrameError::Tail { .. } => Fault::Tail,
            FrameError::Trailing { .. } => Fault::Trailing,
            FrameError::Crc { .. } => Fault::Crc,
        };
        rejection(class, &error)
    })
}

/// The good frames of each datagram.
fn stream(kind: FrameKind, datagrams: &[HexBytes]) -> Output {
    let frames = datagrams.iter().flat_map(|datagram| innfos::frames(of(kind), datagram));
    Output::Packets(frames.flatten().map(|frame| packet(&frame)).collect())
}

fn packet(frame: &Frame<'_>) -> Packet {
    let (address, command) = (frame.address(), frame.command().code());
    let data = frame.data().to_vec().into();
    match frame.kind() {
        Kind::Request => Packet::Request { address, command, data },
        Kind::Reply => Packet::Reply { address, command, data },
    }
}

fn of(kind: FrameKind) -> Kind {
    match kind {
        FrameKind::Request => Kind::Request,
        FrameKind::Reply => Kind::Reply,
    }
}
