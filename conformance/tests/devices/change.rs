//! What faults do to packets; the reference model reads and builds them.

use actucheck_spec::wire::dynamixel2::reference::{HEADER, packets, repair};
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

use super::code::READ;
use super::rewrite::Written as _;

/// The code of the first packet in these bytes.
pub(crate) fn instruction(asked: &[u8]) -> Option<u8> {
    match packets(asked).first() {
        Some(Packet::Instruction { instruction, .. }) => Some(*instruction),
        _ => None,
    }
}

/// The address and length of a Read.
pub(crate) fn read_of(asked: &[u8]) -> Option<(u16, u16)> {
    match packets(asked).first() {
        Some(Packet::Instruction { instruction: 2, params, .. }) => match params.0[..] {
            [a, b, c, d] => Some((u16::from_le_bytes([a, b]), u16::from_le_bytes([c, d]))),
            _ => None,
        },
        _ => None,
    }
}

/// Changes ID, error and data of each status packet.
pub(crate) fn each(answer: Vec<u8>, change: impl Fn(&mut u8, &mut u8, &mut Vec<u8>)) -> Vec<u8> {
    let found = packets(&answer);
    if found.is_empty() {
        return answer;
    }
    let changed = found.into_iter().flat_map(|packet| match packet {
        Packet::Status { mut id, mut error, params } => {
            let mut data = params.0;
            change(&mut id, &mut error, &mut data);
            WIRE.encode(&Packet::Status { id, error, params: data.into() }.into()).unwrap()
        }
        other => WIRE.encode(&other.into()).unwrap(),
    });
    changed.collect()
}

/// Gives a packet the ID 1 if it has another that the device takes for its own.
pub(crate) fn renamed(mut heard: Vec<u8>, is_own: fn(u8, u8) -> bool) -> Vec<u8> {
    let whole = heard.starts_with(&HEADER) && heard.len() >= 10;
    let length = 7 + usize::from(heard.get(5).copied().unwrap_or_default());
    if whole && length <= heard.len() && is_own(heard[4], heard[7]) && heard[4] != 1 {
        let mut before = heard[..length].to_vec();
        repair(&mut before);
        // Only of packets whose CRC is right.
        if before == heard[..length] {
            heard[4] = 1;
            repair(&mut heard[..length]);
        }
    }
    heard
}

/// Lets an instruction to several devices name ID 1.
pub(crate) fn names_it(mut heard: Vec<u8>, code: u8) -> Vec<u8> {
    if is(&heard, code) && heard.len() == 15 {
        heard[12] = 1;
        repair(&mut heard);
    }
    heard
}

/// Changes the parameters of an instruction.
pub(crate) fn with_params(heard: Vec<u8>, code: u8, change: impl Fn(&mut Vec<u8>)) -> Vec<u8> {
    match packets(&heard).first() {
        Some(Packet::Instruction { id, instruction, params }) if *instruction == code => {
            let mut params = params.0.clone();
            change(&mut params);
            let packet = Packet::Instruction { id: *id, instruction: code, params: params.into() };
            WIRE.encode(&packet.into()).unwrap()
        }
        _ => heard,
    }
}

/// Whether these bytes begin with an instruction.
pub(crate) fn is(asked: &[u8], code: u8) -> bool {
    instruction(asked) == Some(code)
}

/// Answers an instruction with an error and no data.
pub(crate) fn failed(asked: &[u8], answer: Vec<u8>, code: u8, number: u8) -> Vec<u8> {
    if !is(asked, code) {
        return answer;
    }
    each(answer, |_, error, data| {
        *error = number;
        data.clear();
    })
}

/// Answers a Write of these bytes with an error.
pub(crate) fn refuses(
    asked: &[u8],
    answer: Vec<u8>,
    address: u16,
    data: &[u8],
    number: u8,
) -> Vec<u8> {
    if !asked.ends_with_write(address, data) {
        return answer;
    }
    each(answer, |_, error, _| *error = number)
}

/// Answers the Read of a register with another first byte.
pub(crate) fn tells(asked: &[u8], answer: Vec<u8>, register: (u16, u16), first: u8) -> Vec<u8> {
    if read_of(asked) != Some(register) {
        return answer;
    }
    each(answer, |_, _, data| data[0] = first)
}

/// Refuses the Read of a register with Access Error, as if there were none.
pub(crate) fn register_missing(asked: &[u8], answer: Vec<u8>, register: (u16, u16)) -> Vec<u8> {
    if read_of(asked) == Some(register) { failed(asked, answer, READ, 7) } else { answer }
}

/// Changes the bytes of the answer to an instruction, and makes the CRC fit.
pub(crate) fn repaired(
    asked: &[u8],
    mut answer: Vec<u8>,
    code: u8,
    change: fn(&mut Vec<u8>),
) -> Vec<u8> {
    if is(asked, code) && !answer.is_empty() {
        change(&mut answer);
        repair(&mut answer);
    }
    answer
}

/// Does not answer an instruction.
pub(crate) fn silent(asked: &[u8], answer: Vec<u8>, code: u8) -> Vec<u8> {
    if is(asked, code) { Vec::new() } else { answer }
}
