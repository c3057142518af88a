//! What faults do to packets; the reference model reads and builds them.

use actucheck_spec::wire::dynamixel2::reference::{HEADER, packets, repair};
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

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
    if instruction(&heard) == Some(code) && heard.len() == 15 {
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
