//! The steps of which conversations with devices are made, on every wire.

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::Packet;

use crate::adapter::{Asked, Called, Pause, Piece};

/// The bytes of a packet, from the reference model.
pub(super) fn bytes_of(packet: impl Into<Packet>) -> HexBytes {
    let packet = packet.into();
    packet.wire().encode(&packet).unwrap_or_default().into()
}

/// A packet, and so many answers to it.
pub(super) fn asked(packet: impl Into<Packet>, awaits: usize) -> Asked {
    let packet = packet.into();
    let send = vec![Piece { after: Pause::None, bytes: bytes_of(packet.clone()) }];
    Asked { packet: Some(Called::from(packet)), send, awaits, ..Asked::default() }
}

/// Bytes that must not be answered, and a packet that must be.
pub(super) fn then(bytes: impl Into<HexBytes>, hello: impl Into<Packet>) -> Asked {
    let piece = Piece { after: Pause::None, bytes: bytes.into() };
    let hello = Piece { after: Pause::Answer, bytes: bytes_of(hello) };
    Asked { send: vec![piece, hello], awaits: 1, ..Asked::default() }
}

/// The same for a packet instead of bytes.
pub(super) fn packet_then(packet: impl Into<Packet>, hello: impl Into<Packet>) -> Asked {
    let packet = packet.into();
    let step = then(bytes_of(packet.clone()), hello);
    Asked { packet: Some(Called::from(packet)), ..step }
}
