//! Adapter for the crate `rustypot`, used as published, over a port in memory. Every byte sent and
//! every packet reported comes from the library, including its mistakes.

#![forbid(unsafe_code)]

mod calls;
mod host;
mod memory_port;

use std::error::Error;
use std::io;
use std::process::ExitCode;

use actucheck_adapter::{
    Block, Fast, Hex, Identity, Library, Memory, Packet, Refusal, locked_version, serve,
};
use calls::Failure;
use memory_port::MemoryPort;
use rustypot::{CommunicationErrorKind, DynamixelProtocolHandler, SyncReadError};

/// Offset of a frame's ID.
const ID: usize = 4;
/// The rate of a port that has none; a broadcast Ping computes its waiting time from it.
const BAUD: u32 = 1_000_000;

struct Rustypot;

impl Library for Rustypot {
    type Port = host::Host;

    fn identity() -> Identity {
        Identity {
            name: "rustypot",
            version: locked_version(include_str!("../Cargo.lock"), "rustypot"),
            url: "https://github.com/pollen-robotics/rustypot",
            roles: &["host"],
            ops: &["encode", "decode", "open", "call", "exchange", "close"],
            max_send: None,
            max_receive: None,
        }
    }

    fn encode(packet: &Packet) -> Result<Vec<u8>, Refusal> {
        let Packet::Instruction { id, call, .. } = packet else {
            return Err(Refusal::skipped("the library sends no status packets"));
        };
        // The answer that the function may wait for does not arrive.
        let line = Memory::default();
        let called = calls::make(&mut port(&line), *id, call);
        match (called, line.sent()) {
            (Err(Failure::Missing(refusal)), _) => Err(refusal),
            (Err(Failure::Failed(error)), sent) if sent.is_empty() => Err(refusal(error.as_ref())),
            (_, sent) => Ok(sent),
        }
    }

    fn decode(frame: &[u8], fast: Option<&Fast>) -> Result<Packet, Refusal> {
        fast.map_or_else(|| status(frame), |fast| fast_status(frame, fast))
    }
}

/// The library's end of a line.
fn port(line: &Memory) -> MemoryPort {
    MemoryPort { line: line.clone(), baud: BAUD, timeout: host::TIMEOUT }
}

/// The result of a Read. The library accepts only the answer of the device that it asked and does
/// not return the ID, so the adapter asks the device that the frame names.
fn status(frame: &[u8]) -> Result<Packet, Refusal> {
    let id = frame.get(ID).copied().unwrap_or_default();
    let handler = DynamixelProtocolHandler::v2();
    let read = handler.read_with_error(&mut port(&Memory::answering(frame)), id, 0, 0);
    let (params, error) = read.map_err(|error| refusal(error.as_ref()))?;
    Ok(Packet::Status { id, error: error.byte(), params: Hex(params) })
}

fn fast_status(frame: &[u8], fast: &Fast) -> Result<Packet, Refusal> {
    if fast.length == 0 {
        return Err(Refusal::skipped("the library has no Fast Sync Write"));
    }
    let length = calls::length_of(fast.length)?;
    let handler = DynamixelProtocolHandler::v2().with_fast_sync_read();
    let mut port = port(&Memory::answering(frame));
    let read = handler.sync_read_with_error(&mut port, &fast.ids, 0, length);
    let blocks = read.map_err(|error| refusal(error.as_ref()))?;
    let block = |(id, (data, error)): (&u8, (Vec<u8>, rustypot::StatusError))| Block {
        error: error.byte(),
        id: *id,
        data: Hex(data),
    };
    Ok(Packet::FastStatus { blocks: fast.ids.iter().zip(blocks).map(block).collect() })
}

fn refusal(error: &(dyn Error + 'static)) -> Refusal {
    let cause = cause(error);
    let class = match cause.downcast_ref::<CommunicationErrorKind>() {
        Some(CommunicationErrorKind::ChecksumError) => "crc",
        Some(CommunicationErrorKind::IncorrectId(..)) => "id",
        Some(CommunicationErrorKind::TimeoutError) => "truncated",
        // The library has one error for a wrong header, length or instruction.
        Some(CommunicationErrorKind::ParsingError) => "unspecified",
        Some(CommunicationErrorKind::Unsupported) => "instruction",
        None if cause.is::<io::Error>() => "truncated",
        None => "internal",
    };
    Refusal::rejected(class, error)
}

/// Why reading several devices failed at one of them; otherwise the error itself.
fn cause<'a>(error: &'a (dyn Error + 'static)) -> &'a (dyn Error + 'static) {
    error.downcast_ref().map_or(error, |SyncReadError { cause, .. }| cause.as_ref())
}

fn main() -> ExitCode {
    match serve::<Rustypot>() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("adapter: {error}");
            ExitCode::FAILURE
        }
    }
}
