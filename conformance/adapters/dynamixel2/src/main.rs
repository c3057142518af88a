//! Adapter for the crate `dynamixel2`, used as published. Every byte sent and every packet reported
//! comes from the library, including its mistakes.

#![forbid(unsafe_code)]

mod calls;
mod host;
mod line;

use std::process::ExitCode;

use actucheck_adapter::{Fast, Hex, Identity, Library, Packet, Refusal, locked_version, serve};
use calls::Failure;
use dynamixel2::{InvalidMessage, ReadError, StatusPacket, TransferError, WriteError, checksum};
use line::Line;

struct Dynamixel2;

impl Library for Dynamixel2 {
    type Port = host::Host;

    fn identity() -> Identity {
        Identity {
            name: "dynamixel2",
            version: locked_version(include_str!("../Cargo.lock"), "dynamixel2"),
            url: "https://github.com/robohouse-delft/dynamixel2-rs",
            roles: &["host"],
            ops: &["crc", "encode", "decode", "stream", "open", "call", "close"],
            max_send: Some(line::BUFFER),
            max_receive: Some(line::BUFFER),
        }
    }

    fn crc(bytes: &[u8]) -> Result<u16, Refusal> {
        Ok(checksum::calculate_checksum(0, bytes))
    }

    fn encode(packet: &Packet) -> Result<Vec<u8>, Refusal> {
        let Packet::Instruction { id, instruction, params, call } = packet else {
            return Err(Refusal::skipped("the library sends no status packets"));
        };
        line::sent(|bus| {
            // The function is public and stuffs, so it serves for instructions that have no
            // function of their own.
            calls::make(bus, *id, call)
                .unwrap_or_else(|| calls::send_raw(bus, *id, *instruction, params))
                .map_or_else(unsent, |_| Ok(()))
        })
    }

    fn decode(frame: &[u8], fast: Option<&Fast>) -> Result<Packet, Refusal> {
        if fast.is_some() {
            return Err(Refusal::skipped("the library has no Fast Sync Read and Fast Sync Write"));
        }
        let mut line = Line::new()?;
        line.arrive(frame, true)?;
        line.read(|packet| status(&packet)).map_err(refusal)
    }

    fn stream(chunks: &[Hex]) -> Result<Vec<Packet>, Refusal> {
        let mut line = Line::new()?;
        let mut packets = Vec::new();
        for (index, chunk) in chunks.iter().enumerate() {
            line.arrive(chunk, index + 1 == chunks.len())?;
            loop {
                match line.read(|packet| status(&packet)) {
                    Ok(packet) => packets.push(packet),
                    // Either all bytes are read, or the library is stuck, as it empties the buffer
                    // only when it sends the next instruction.
                    Err(ReadError::Io(_) | ReadError::BufferFull(_)) => break,
                    Err(error) => {
                        if let refusal @ Refusal::Skipped(_) = refusal(error) {
                            return Err(refusal);
                        }
                    }
                }
            }
        }
        Ok(packets)
    }
}

/// The answer that a function waits for does not arrive: only sending counts.
fn unsent(failure: Failure) -> Result<(), Refusal> {
    match failure {
        Failure::Missing(reason) => Err(Refusal::skipped(reason)),
        Failure::Refused(detail) => Err(Refusal::rejected("parameter", detail)),
        Failure::Failed(TransferError::ReadError(_)) => Ok(()),
        Failure::Failed(TransferError::WriteError(WriteError::BufferTooSmall(error))) => {
            Err(Refusal::rejected("oversize", error))
        }
        Failure::Failed(error) => Err(line::broken(error)),
    }
}

fn status(packet: &StatusPacket<'_>) -> Packet {
    Packet::Status {
        id: packet.packet_id(),
        error: packet.error(),
        params: Hex(packet.parameters().to_vec()),
    }
}

fn refusal(error: ReadError) -> Refusal {
    let class = match &error {
        ReadError::MotorError(_) => {
            return Refusal::skipped("an error number comes alone, without ID and parameters");
        }
        ReadError::BufferFull(_) => "oversize",
        ReadError::Io(_) => "truncated",
        ReadError::InvalidMessage(InvalidMessage::InvalidHeaderPrefix(_)) => "header",
        ReadError::InvalidMessage(InvalidMessage::InvalidInstruction(_)) => "instruction",
        ReadError::InvalidMessage(InvalidMessage::InvalidChecksum(_)) => "crc",
        ReadError::InvalidMessage(InvalidMessage::InvalidPacketId(_)) => "id",
        ReadError::InvalidMessage(InvalidMessage::InvalidParameterCount(_)) => "parameter",
    };
    Refusal::rejected(class, error)
}

fn main() -> ExitCode {
    match serve::<Dynamixel2>() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("adapter: {error}");
            ExitCode::FAILURE
        }
    }
}
