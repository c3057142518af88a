//! The codec's INNFOS Ethernet protocol.

mod message;
mod value;

use actucheck_codec::crc;
use actucheck_codec::innfos::{self, Command, Frame, FrameError};
use actucheck_spec::model::{Fault, HexBytes};
use actucheck_spec::wire::innfos::Packet;
use actucheck_spec::wire::{self, Context, Direction};

use super::{Answer, Result, answer, not_offered, output, rejection, unbuilt};
use crate::adapter::{Output, Question, Rejection, Told};

/// The codec's answer to a question.
pub(super) fn ask(question: &Question, buffer: &mut [u8]) -> Answer {
    answer(match question {
        Question::Crc { bytes, .. } => Ok(Output::Crc(crc::modbus(bytes).into())),
        Question::Encode { packet, .. } => encode(&packet.packet, buffer),
        Question::Decode { bytes, context: Context { direction: Some(direction), .. }, .. } => {
            decode(*direction, bytes)
        }
        Question::Stream { chunks, direction: Some(direction), .. } => {
            Ok(stream(*direction, chunks))
        }
        Question::Message { actuator, told, .. } => {
            let actuator = value::actuator(actuator.as_deref());
            match told {
                Told::Frame { direction, bytes } => message::read(*direction, bytes, &actuator),
                Told::Message { message } => message::build(message, &actuator, buffer),
            }
        }
        _ => return Answer::Skipped(format!("the codec has no {}", question.name())),
    })
}

fn encode(packet: &wire::Packet, buffer: &mut [u8]) -> Result {
    let wire::Packet::Innfos(packet) = packet else { return Err(not_offered()) };
    let Packet { direction, address, command, data } = packet;
    let command = Command::from_code(*command);
    innfos::encode(of(*direction), *address, command, data, buffer)
        .map(output)
        .map_err(|error| unbuilt(&error))
}

fn decode(direction: Direction, bytes: &[u8]) -> Result {
    frame(direction, bytes).map(|frame| Output::Packet(packet(&frame).into()))
}

fn frame(direction: Direction, bytes: &[u8]) -> std::result::Result<Frame<'_>, Rejection> {
    Frame::parse(of(direction), bytes).map_err(|error| {
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
fn stream(direction: Direction, datagrams: &[HexBytes]) -> Output {
    let frames = datagrams.iter().flat_map(|datagram| innfos::frames(of(direction), datagram));
    Output::packets(frames.flatten().map(|frame| packet(&frame)))
}

fn packet(frame: &Frame<'_>) -> Packet {
    let (address, command) = (frame.address(), frame.command().code());
    let data = frame.data().to_vec().into();
    let direction = match frame.direction() {
        innfos::Direction::Request => Direction::Request,
        innfos::Direction::Reply => Direction::Reply,
    };
    Packet { direction, address, command, data }
}

fn of(direction: Direction) -> innfos::Direction {
    match direction {
        Direction::Request => innfos::Direction::Request,
        Direction::Reply => innfos::Direction::Reply,
    }
}
