//! A Write and a status packet: the packets of any size, one for a device and one for a host.

use std::fmt;

use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::PATTERN;

/// The address of a Write: 116, as some libraries support addresses up to 255 only.
pub(super) const REGISTER: [u8; 2] = [0x74, 0x00];

/// A packet from or to device 1.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    Write,
    Status,
}

impl Kind {
    pub(super) const ALL: [Self; 2] = [Self::Write, Self::Status];

    /// The bytes of the body before the data: the instruction and the address, or the instruction
    /// and the error.
    pub(super) const fn before_data(self) -> usize {
        match self {
            Self::Write => 3,
            Self::Status => 2,
        }
    }

    /// The packet with this data, without an error.
    pub(super) fn packet(self, data: &[u8]) -> Packet {
        match self {
            Self::Write => of_params([&REGISTER, data].concat()),
            Self::Status => Packet::Status { id: 1, error: 0, params: data.to_vec().into() },
        }
    }

    /// The packet with a number of four bytes.
    pub(super) fn numbered(self, number: u8) -> Packet {
        self.packet(&[number, 0, 0, 0])
    }

    /// The packet with a body of this length, which has the pattern at `place`.
    pub(super) fn with_body(self, length: usize, place: Option<usize>) -> Packet {
        // Of bytes that no pattern has; each differs from its neighbours.
        let mut body: Vec<u8> = (0x10..0xD0).cycle().take(length).collect();
        let fixed: &[u8] = match self {
            Self::Write => &REGISTER,
            Self::Status => &[0x00],
        };
        put(&mut body, 1, fixed);
        if let Some(place) = place {
            put(&mut body, place, &PATTERN);
        }
        let rest = body.get(1..).unwrap_or_default();
        match (self, rest) {
            (Self::Status, [error, params @ ..]) => {
                Packet::Status { id: 1, error: *error, params: params.to_vec().into() }
            }
            _ => of_params(rest.to_vec()),
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Write => "write",
            Self::Status => "status",
        })
    }
}

/// A Write with these parameters.
fn of_params(params: Vec<u8>) -> Packet {
    Packet::Instruction { id: 1, instruction: 0x03, params: params.into() }
}

/// Overwrites bytes, as far as there are any.
fn put(body: &mut [u8], from: usize, bytes: &[u8]) {
    for (slot, byte) in body.iter_mut().skip(from).zip(bytes) {
        *slot = *byte;
    }
}
