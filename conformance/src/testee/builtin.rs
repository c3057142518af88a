//! This project's own codec as an implementation under test.

mod innfos;

use actucheck_codec::dynamixel2::Instruction;
use actucheck_codec::fast_status::{self, Block};
use actucheck_codec::status::{self, StatusError};
use actucheck_codec::stream::{Event, Parser};
use actucheck_codec::stuffing::{self, UnstuffError};
use actucheck_codec::{EncodeError, FastStatus, Frame, FrameError, crc, frame};
use actucheck_spec::model::{self, Fault, HexBytes, Packet};

use super::{Answer, Testee};
use crate::protocol::{Fast, Hello, Implementation, Limits, Op, Output, Rejection, VERSION, Wire};

/// The largest frame that a length field can tell of: one of INNFOS.
const MAX_FRAME: usize = 65_535 + 8;

/// The built-in codec.
#[derive(Debug)]
pub struct Builtin {
    hello: Hello,
    buffer: Vec<u8>,
}

impl Default for Builtin {
    fn default() -> Self {
        let hello = Hello {
            protocol: VERSION,
            implementation: Implementation {
                name: "actucheck-codec".to_owned(),
                version: env!("CARGO_PKG_VERSION").to_owned(),
                language: "Rust".to_owned(),
                url: None,
            },
            wires: [Wire::Dynamixel2, Wire::Innfos].map(|wire| wire.id().to_owned()).to_vec(),
            ops: ["crc", "stuff", "unstuff", "encode", "decode", "stream"]
                .map(str::to_owned)
                .to_vec(),
            limits: Limits { max_packet: Some(MAX_FRAME) },
        };
        Self { hello, buffer: vec![0; MAX_FRAME] }
    }
}

impl Testee for Builtin {
    fn hello(&self) -> &Hello {
        &self.hello
    }

    fn ask(&mut self, op: &Op) -> Answer {
        let skipped = || Answer::Skipped(format!("the codec has no {}", op.name()));
        let output = match op {
            _ if op.wire() == Some(Wire::Innfos) => match innfos::ask(op, &mut self.buffer) {
                Some(output) => output,
                None => return skipped(),
            },
            Op::Crc { bytes, .. } => Ok(Output::Crc(crc::umts(bytes).into())),
            Op::Stuff { bytes, .. } => self.stuff(bytes),
            Op::Unstuff { bytes, .. } => self.unstuff(bytes),
            Op::Encode { packet, .. } => self.encode(&packet.packet),
            Op::Decode { bytes, fast: None, .. } => decode(bytes),
            Op::Decode { bytes, fast: Some(fast), .. } => decode_fast(bytes, fast),
            Op::Stream { chunks, .. } => Ok(stream(chunks)),
            Op::Hello { .. } | Op::Invented | Op::Bye => return skipped(),
        };
        match output {
            Ok(output) => Answer::Ok(output),
            Err(rejection) => Answer::Rejected(rejection),
        }
    }
}

type Result = std::result::Result<Output, Rejection>;

impl Builtin {
    fn stuff(&mut self, body: &[u8]) -> Result {
        self.room(stuffing::stuffed_len(body));
        let bytes = stuffing::stuff(body, &mut self.buffer);
        bytes.map(output).map_err(|error| rejection(Fault::Oversize, &error))
    }

    fn unstuff(&mut self, stuffed: &[u8]) -> Result {
        self.room(stuffed.len());
        stuffing::unstuff(stuffed, &mut self.buffer).map(output).map_err(|error| {
            let class = match error {
                UnstuffError::Bare { .. } => Fault::Stuffing,
                UnstuffError::Buffer(_) => Fault::Oversize,
            };
            rejection(class, &error)
        })
    }

    fn encode(&mut self, packet: &Packet) -> Result {
        let buffer = &mut self.buffer;
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
            Packet::Request { .. } | Packet::Reply { .. } => {
                let error = "a packet of a wire that the codec does not offer";
                return Err(rejection(Fault::Internal, &error));
            }
        };
        bytes.map(output).map_err(|error| {
            let class = match error {
                EncodeError::Id { .. } => Fault::Id,
                EncodeError::TooLong { .. } | EncodeError::Buffer(_) => Fault::Oversize,
                EncodeError::DataLength { .. } => Fault::Parameter,
            };
            rejection(class, &error)
        })
    }

    fn room(&mut self, size: usize) {
        if self.buffer.len() < size {
            self.buffer.resize(size, 0);
        }
    }
}

fn decode(bytes: &[u8]) -> Result {
    let frame = Frame::parse(bytes).map_err(frame_rejection)?;
    Ok(Output::Packet(packet(&frame)))
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

/// What the stream parser finds; at the end the bus is quiet.
fn stream(chunks: &[HexBytes]) -> Output {
    let mut parser = Parser::new();
    let mut packets = Vec::new();
    let mut drain = |parser: &mut Parser| {
        while let Some(event) = parser.next_event() {
            if let Event::Frame(frame) = event {
                packets.push(packet(&frame));
            }
        }
    };
    for chunk in chunks {
        let mut rest: &[u8] = chunk;
        while !rest.is_empty() {
            rest = parser.push(rest);
            drain(&mut parser);
        }
    }
    parser.idle();
    drain(&mut parser);
    Output::Packets(packets)
}

fn decode_fast(bytes: &[u8], fast: &Fast) -> Result {
    let packet = FastStatus::parse(bytes, fast.length, &fast.ids).map_err(frame_rejection)?;
    let blocks = packet.blocks().map(|block| model::Block {
        error: block.error.0,
        id: block.id,
        data: block.data.to_vec().into(),
    });
    Ok(Output::Packet(Packet::FastStatus { blocks: blocks.collect() }))
}

fn block(block: &model::Block) -> Block<'_> {
    Block { error: StatusError(block.error), id: block.id, data: &block.data }
}

fn output(bytes: &[u8]) -> Output {
    Output::Bytes(HexBytes(bytes.to_vec()))
}

fn frame_rejection(error: FrameError) -> Rejection {
    rejection(fault(&error), &error)
}

fn rejection(class: Fault, error: &impl ToString) -> Rejection {
    Rejection { class, detail: error.to_string() }
}

/// The error class of the adapter protocol that a codec's error belongs to.
fn fault(error: &FrameError) -> Fault {
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
