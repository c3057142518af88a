//! Frames that are sent, and frames in what comes.

use actucheck_codec::crc::modbus;

use super::faults::{Fault, Switch};

const HEADER: u8 = 0xEE;
const END: u8 = 0xED;
/// Bytes of header, address, command and length.
const PREFIX: usize = 5;
const HANDSHAKE: u8 = 0x44;
const QUERY: u8 = 0x02;

/// A reply.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) address: u8,
    pub(crate) command: u8,
    pub(crate) data: Vec<u8>,
}

/// A request.
pub(crate) fn encode(on: Switch, address: u8, command: u8, data: &[u8]) -> Vec<u8> {
    let address = if on.is(Fault::SevenBitsOfAddress) { address & 0x7F } else { address };
    // A call has no more data.
    let length = u16::try_from(data.len()).unwrap();
    let low_first = on.is(Fault::SendsLengthLowByteFirst);
    let length = if low_first { length.to_le_bytes() } else { length.to_be_bytes() };
    let mut frame = [&[HEADER, address, command], &length[..], data].concat();
    let least = match on.0 {
        Some(Fault::NoCrcForOneByte) => 2,
        Some(Fault::CrcWithoutData) => 0,
        _ => 1,
    };
    if data.len() >= least {
        let crc = modbus(if on.is(Fault::CrcOfFrame) { &frame } else { data });
        let high_first = on.is(Fault::CrcHighByteFirst);
        frame.extend(if high_first { crc.to_be_bytes() } else { crc.to_le_bytes() });
    }
    frame.push(END);
    frame
}

/// The replies in a datagram, up to the first bytes that are none. A host expects so many bytes of data.
pub(crate) fn frames(on: Switch, datagram: &[u8], expected: usize) -> Vec<Frame> {
    let (mut frames, mut rest) = (Vec::new(), datagram);
    while let Some((frame, size)) = first(on, rest, expected) {
        frames.push(frame);
        rest = if on.is(Fault::FirstFrameOnly) { &[] } else { &rest[size..] };
    }
    frames
}

/// The reply that begins here, and how long it is.
fn first(on: Switch, bytes: &[u8], expected: usize) -> Option<(Frame, usize)> {
    let [header, address, command, high, low, ..] = *bytes else { return None };
    if header != HEADER && !on.is(Fault::AnyHeader) {
        return None;
    }
    let low_first = on.is(Fault::ReadsLengthLowByteFirst);
    let from_bytes = if low_first { u16::from_le_bytes } else { u16::from_be_bytes };
    let length = usize::from(from_bytes([high, low]));
    let length = if on.is(Fault::FixedSize) { expected } else { length };
    if length > expected && command != QUERY && on.is(Fault::DiesOfMoreData) {
        std::process::abort();
    }
    let data = bytes.get(PREFIX..PREFIX + length)?.to_vec();
    let crc = crc_size(on, command, &data, bytes);
    let end = PREFIX + length + crc;
    let last = *bytes.get(end)?;
    if last != END && !on.is(Fault::AnyEnd) {
        return None;
    }
    if on.is(Fault::EndsAtEndByte) && bytes.iter().position(|byte| *byte == END)? < end {
        return None;
    }
    let found = &bytes[PREFIX + length..end];
    let takes_zeros = command == HANDSHAKE || on.is(Fault::TakesZeroCrc);
    let is_right = match *found {
        [0, 0] if command == HANDSHAKE && on.is(Fault::DropsZeroCrc) => false,
        [] => true,
        [0, 0] if takes_zeros => true,
        _ => found == modbus(&data).to_le_bytes() || on.is(Fault::IgnoresCrc),
    };
    is_right.then_some((Frame { address, command, data }, end + 1))
}

/// How many bytes the CRC has. That of the handshake is there or not.
fn crc_size(on: Switch, command: u8, data: &[u8], bytes: &[u8]) -> usize {
    let is_end = |place: usize| bytes.get(PREFIX + data.len() + place) == Some(&END);
    let may_lack = command == HANDSHAKE || on.is(Fault::NeedsNoCrc);
    let has_crc = data.len() > 1 || on.is(Fault::CrcOfOneByte) || command == HANDSHAKE;
    if !has_crc || may_lack && is_end(0) && !is_end(2) { 0 } else { 2 }
}
