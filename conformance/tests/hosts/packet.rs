//! The packets that a host sends, and how packets are checked.

use actucheck_codec::crc::umts;

use super::faults::{Fault, Switch};

pub(crate) const HEADER: [u8; 4] = [0xFF, 0xFF, 0xFD, 0x00];
/// Bytes up to the instruction.
pub(crate) const PREFIX: usize = 7;
pub(crate) const BROADCAST: u8 = 0xFE;
/// The largest ID of a device.
pub(crate) const LARGEST_ID: u8 = 252;
/// Behind these there is an FD more in a packet's body.
const PATTERN: [u8; 3] = [0xFF, 0xFF, 0xFD];

/// An instruction packet.
pub(crate) fn encode(on: Switch, id: u8, instruction: u8, params: &[u8]) -> Vec<u8> {
    let plain = [&[instruction], params].concat();
    let stuffed = if on.is(Fault::NoStuffing) { plain.clone() } else { stuff(on, &plain) };
    let counted = if on.is(Fault::LengthBeforeStuffing) { &plain } else { &stuffed };
    // A request is refused before it becomes that long.
    let length = u16::try_from(counted.len() + 2).unwrap();
    let high_first = on.is(Fault::SendsLengthHighByteFirst);
    let length = if high_first { length.to_be_bytes() } else { length.to_le_bytes() };
    let head = [&HEADER[..], &[id], &length].concat();
    let covered = if on.is(Fault::CrcBeforeStuffing) { &plain } else { &stuffed };
    let crc = crc(on, &head, covered).to_le_bytes();
    [head, stuffed, crc.to_vec()].concat()
}

/// The CRC of a packet whose first seven bytes these are, with what comes up to the CRC.
pub(crate) fn crc(on: Switch, head: &[u8], body: &[u8]) -> u16 {
    if on.is(Fault::CrcOfBody) { umts(body) } else { umts(&[head, body].concat()) }
}

fn stuff(on: Switch, plain: &[u8]) -> Vec<u8> {
    let mut stuffed = Vec::with_capacity(plain.len());
    for (at, byte) in plain.iter().enumerate() {
        stuffed.push(*byte);
        let before = &plain[..=at];
        let is_done = on.is(Fault::StuffsFirstOnly) && stuffed.len() > before.len();
        let is_missed = on.is(Fault::MissesThirdFf) && before.ends_with(b"\xFF\xFF\xFF\xFD");
        if before.ends_with(&PATTERN) && !is_done && !is_missed {
            stuffed.push(0xFD);
        }
    }
    stuffed
}

/// A body without stuffing; `None` if it has a header that is not stuffed.
pub(crate) fn unstuff(on: Switch, stuffed: &[u8]) -> Option<Vec<u8>> {
    if on.is(Fault::NoUnstuffing) {
        return Some(stuffed.to_vec());
    }
    let too_much = on.is(Fault::UnstuffsTooMuch);
    let mut plain = Vec::with_capacity(stuffed.len());
    let mut rest = stuffed.iter().peekable();
    while let Some(byte) = rest.next() {
        plain.push(*byte);
        if too_much {
            rest.next_if(|next| *byte == 0xFD && **next == 0xFD);
        } else if plain.ends_with(&PATTERN) {
            rest.next_if(|next| **next == 0xFD)?;
        }
    }
    Some(plain)
}
