//! The codec's DYNAMIXEL Protocol 2.0.

mod value;

use actucheck_codec::crc;
use actucheck_codec::dynamixel2::fast_status::{self, Block};
use actucheck_codec::dynamixel2::status::{self, StatusError};
use actucheck_codec::dynamixel2::stream::{DEFAULT_MAX_PACKET, Event, Parser};
use actucheck_codec::dynamixel2::stuffing::{self, UnstuffError};
use actucheck_codec::dynamixel2::{FastStatus, Frame, FrameError, Instruction, frame};
use actucheck_spec::model::{Fault, HexBytes};
use actucheck_spec::wire::dynamixel2::{self, Packet};
use actucheck_spec::wire::{self, Fast};

use super::{Answer, Result, answer, not_offered, output, rejection, unbuilt};
use crate::adapter::{Output, Question, Rejection};

/// The codec's answer to a question.
pub(super) fn ask(question: &Question, buffer: &mut Vec<u8>) -> Answer {
    answer(match question {
        Question::Crc { bytes, .. } => Ok(Output::Crc(crc::umts(bytes).into())),
        Question::Stuff { bytes, .. } => stuff(bytes, buffer),
        Question::Unstuff { bytes, .. } => unstuff(bytes, buffer),
        Question::Encode { packet, .. } => encode(&packet.packet, buffer),
        Question::Decode { bytes, context, .. } => match &context.fast {
            None => decode(bytes),
            Some(fast) => decode_fast(bytes, fast),
        },
        Question::Stream { chunks, .. } => Ok(stream(chunks)),
        Question::Value { of, form, given, .. } => value::ask(of, form, given),
        Question::Message { .. } => Err(not_offered()),
        Question::Converse { .. } | Question::Device { .. } => {
            return Answer::Skipped("the codec opens no port".to_owned());
        }
    })
}

fn stuff(body: &[u8], buffer: &mut Vec<u8>) -> Result {
    // A question may have a longer body than any packet.
    buffer.resize(buffer.len().max(stuffing::stuffed_len(body)), 0);
    let bytes = stuffing::stuff(body, buffer);
    bytes.map(output).map_err(|error| rejection(Fault::Oversize, &error))
}

fn unstuff(stuffed: &[u8], buffer: &mut Vec<u8>) -> Result {
    buffer.resize(buffer.len().max(stuffed.len()), 0);
    stuffing::unstuff(stuffed, buffer).map(output).map_err(|error| {
        let class = match error {
            UnstuffError::Bare { .. } => Fault::Stuffing,
            UnstuffError::Buffer(_) => Fault::Oversize,
        };
        rejection(class, &error)
    })
}

fn encode(packet: &wire::Packet, buffer: &mut [u8]) -> Result {
    let wire::Packet::Dynamixel2(packet) = packet else { return Err(not_offered()) };
    let bytes = match packet {
        Packet::Instruction { id, instruction, params } => {
            frame::encode(*id, Instruction::from_code(*instruction), &[params], buffer)
        }
        Packet::Status { id, error, params } => {
            status::encode(*id, StatusError(*error), params, buffer)
        }
        Packet::FastStatus { blocks } => {
            let blocks: Vec<_> = blocks.iter().map(block).collect();
            fast_status::encode(&blocks, buffer)
        }
    };
    bytes.map(output).map_err(|error| unbuilt(&error))
}

fn decode(bytes: &[u8]) -> Result {
    let frame = Frame::parse(bytes).map_err(frame_rejection)?;
    Ok(Output::Packet(packet(&frame).into()))
}

fn packet(frame: &Frame<'_>) -> Packet {
    let params = frame.params().collect::<Vec<_>>();
    let (id, instruction) = (frame.id(), frame.instruction().code());
    match frame.error() {
        None => Packet::Instruction { id, instruction, params: params.into() },
        Some(StatusError(error)) => {
            let params = params.into_iter().skip(1).collect::<Vec<_>>().into();
            Packet::Status { id, error, params }
        }
    }
}

/// Blocks of a parser that takes the longest packet that a length field allows.
const LONGEST: usize = (65_535 + 7_usize).div_ceil(64);

/// The packets that the stream parser finds. A parser for the longest packets has 131 kB, so short
/// streams, which can't hold one, get a small parser.
fn stream(chunks: &[HexBytes]) -> Output {
    let size: usize = chunks.iter().map(|chunk| chunk.len()).sum();
    if size <= DEFAULT_MAX_PACKET {
        found(&mut Parser::new(), chunks)
    } else {
        found(&mut Box::<Parser<LONGEST>>::default(), chunks)
    }
}

/// The bus is quiet after the last chunk.
fn found<const BLOCKS: usize>(parser: &mut Parser<BLOCKS>, chunks: &[HexBytes]) -> Output {
    let mut packets = Vec::new();
    let mut take = |event: Event<'_>| {
        if let Event::Frame(frame) = event {
            packets.push(packet(&frame).into());
        }
    };
    for chunk in chunks {
        parser.feed(chunk, &mut take);
    }
    parser.idle();
    parser.feed(&[], &mut take);
    Output::Packets(packets)
}

fn decode_fast(bytes: &[u8], fast: &Fast) -> Result {
    let packet = FastStatus::parse(bytes, fast.length, &fast.ids).map_err(frame_rejection)?;
    let blocks = packet.blocks().map(|block| dynamixel2::Block {
        error: block.error.0,
        id: block.id,
        data: block.data.to_vec().into(),
    });
    Ok(Output::Packet(Packet::FastStatus { blocks: blocks.collect() }.into()))
}

fn block(block: &dynamixel2::Block) -> Block<'_> {
    Block { error: StatusError(block.error), id: block.id, data: &block.data }
}

fn frame_rejection(error: FrameError) -> Rejection {
    rejection(fault(&error), &error)
}

/// The adapter protocol's error class of a codec error.
const fn fault(error: &FrameError) -> Fault {
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
