//! What faults do to packets that write.

use actucheck_spec::wire::dynamixel2::reference::frame;

use super::change::{each, is, with_params};
use super::code::WRITE;

/// The address and the data of a Write, a Reg Write among them.
fn written(params: &[u8]) -> Option<(u16, &[u8])> {
    let (address, data) = params.split_at_checked(2)?;
    Some((u16::from_le_bytes([address[0], address[1]]), data))
}

/// Answers as if a Write had been carried out that was refused with this error.
pub(crate) fn never_refuses(asked: &[u8], answer: Vec<u8>, number: u8) -> Vec<u8> {
    if !is(asked, WRITE) {
        return answer;
    }
    each(answer, |_, error, _| {
        if *error & 0x7F == number {
            *error = 0;
        }
    })
}

/// Takes another number for the error of a Write.
pub(crate) fn other_error(asked: &[u8], answer: Vec<u8>, from: u8, to: u8) -> Vec<u8> {
    if !is(asked, WRITE) {
        return answer;
    }
    each(answer, |_, error, _| {
        if *error & 0x7F == from {
            *error = to;
        }
    })
}

/// Lets a Write go to another address.
pub(crate) fn elsewhere(heard: Vec<u8>, from: u16, to: u16) -> Vec<u8> {
    with_params(heard, WRITE, |params| {
        if written(params).is_some_and(|(address, _)| address == from) {
            params[..2].copy_from_slice(&to.to_le_bytes());
        }
    })
}

/// Changes what is written to an address.
pub(crate) fn changed(heard: Vec<u8>, at: u16, change: impl Fn(&mut [u8])) -> Vec<u8> {
    with_params(heard, WRITE, |params| {
        if written(params).is_some_and(|(address, _)| address == at) {
            change(&mut params[2..]);
        }
    })
}

/// Whether a packet is a Write of these bytes to an address.
pub(crate) trait Written {
    fn ends_with_write(&self, address: u16, data: &[u8]) -> bool;
}

impl Written for [u8] {
    fn ends_with_write(&self, address: u16, data: &[u8]) -> bool {
        let rest = self.get(8..self.len().saturating_sub(2)).unwrap_or_default();
        self.get(7) == Some(&WRITE) && written(rest) == Some((address, data))
    }
}

/// What comes after the first packet.
pub(crate) fn after_first(heard: &[u8]) -> Vec<u8> {
    let size = 7 + usize::from(heard[5]);
    heard[size.min(heard.len())..].to_vec()
}

/// An instruction to ID 1.
pub(crate) fn packet(code: u8, params: &[u8]) -> Vec<u8> {
    frame(1, &[&[code][..], params].concat())
}

/// The same parameters with another instruction.
pub(crate) fn with_code(heard: &[u8], code: u8) -> Vec<u8> {
    let params = heard[8..heard.len() - 2].to_vec();
    let params = if code == 0x01 { Vec::new() } else { params };
    packet(code, &params)
}

/// An answer without its stuffing.
pub(crate) fn unstuffed(answer: &[u8]) -> Vec<u8> {
    let body = &answer[7..answer.len() - 2];
    let mut bare: Vec<u8> = Vec::new();
    for byte in body {
        if *byte == 0xFD && bare.ends_with(&[0xFF, 0xFF, 0xFD]) {
            continue;
        }
        bare.push(*byte);
    }
    frame(1, &bare)
}
