//! The INNFOS Ethernet protocol.

mod asks;
#[cfg(feature = "exports")]
mod exports;
mod generate;
mod model;
mod packet;
pub mod reference;
mod validate;

use proc_macro2::TokenStream;
use serde_json::Value;

pub use model::{
    Actuator, Actuators, AlarmBit, Alarms, Command, CrcPresence, Envelope, Format, FormatRow,
    FullScale, Innfos, Mode, Modes, Operation, Udp,
};
pub use packet::Packet;

use super::{Ask, Call, Cited, Context, Direction, Fields, Rules, Wire};
use crate::model::{Fault, HexBytes, Requirement};
use crate::{Diagnostic, Spec};

/// The wire.
pub const WIRE: Wire = Wire::new(&This);

struct This;

impl Rules for This {
    fn id(&self) -> &'static str {
        "innfos"
    }

    fn title(&self) -> &'static str {
        "The INNFOS Ethernet protocol"
    }

    fn kinds(&self) -> &'static [&'static str] {
        &["request", "reply"]
    }

    fn packet(&self, fields: Fields) -> Result<super::Packet, serde_json::Error> {
        serde_json::from_value(Value::Object(fields)).map(super::Packet::Innfos)
    }

    fn direction(&self, packet: &super::Packet) -> Direction {
        own(packet).map_or(Direction::Request, |packet| packet.direction)
    }

    fn payload<'a>(&self, packet: &'a super::Packet) -> Vec<&'a HexBytes> {
        own(packet).map(|packet| &packet.data).into_iter().collect()
    }

    fn difference(&self, expected: &super::Packet, actual: &super::Packet) -> &'static str {
        match (own(expected), own(actual)) {
            (Some(left), Some(right)) if left.direction == right.direction => {
                match (left.address == right.address, left.command == right.command) {
                    (false, _) => "address",
                    (_, false) => "command",
                    _ => "data",
                }
            }
            _ => "kind of packet",
        }
    }

    fn context(&self, packet: &super::Packet) -> Context {
        self.direction(packet).into()
    }

    fn tells_direction(&self) -> bool {
        false
    }

    /// The document's function returns the two bytes in the reverse order of the named CRC; either
    /// number is right.
    fn checksum(&self, bytes: &[u8]) -> Vec<u64> {
        let crc = reference::crc(bytes);
        vec![crc.into(), crc.swap_bytes().into()]
    }

    fn shortest_frame(&self) -> usize {
        reference::PREFIX + 1 // the end
    }

    fn encode(&self, packet: &super::Packet) -> Option<Vec<u8>> {
        reference::encode(own(packet)?)
    }

    fn decode(&self, bytes: &[u8], context: &Context) -> Result<super::Packet, Fault> {
        let direction = context.direction.unwrap_or(Direction::Request);
        reference::decode(direction, bytes).map(Into::into)
    }

    /// A chunk is a datagram.
    fn stream(&self, chunks: &[HexBytes], direction: Option<Direction>) -> Vec<super::Packet> {
        let direction = direction.unwrap_or(Direction::Request);
        let packets = chunks.iter().flat_map(|chunk| reference::packets(direction, chunk));
        packets.map(Into::into).collect()
    }

    fn is_unspecified(&self, bytes: &[u8], context: &Context) -> bool {
        let direction = context.direction.unwrap_or(Direction::Request);
        reference::is_short_reply_with_crc(direction, bytes)
            || reference::decode(direction, bytes)
                .is_ok_and(|packet| reference::is_unspecified(&packet))
    }

    fn call(&self, packet: &super::Packet) -> Option<Call> {
        own(packet).map(reference::call)
    }

    fn calls(&self) -> &'static [&'static str] {
        &[]
    }

    fn device(&self, packet: &super::Packet) -> u8 {
        own(packet).map_or(0, |packet| packet.address)
    }

    fn part(&self, frame: &[u8], offset: usize) -> &'static str {
        reference::part(frame, offset)
    }

    fn repair(&self, frame: &mut [u8]) {
        reference::repair(frame);
    }

    fn cited<'a>(&self, spec: &'a Spec) -> Vec<Cited<'a>> {
        validate::cited(&spec.wires.innfos.content)
    }

    fn validate(&self, spec: &Spec) -> Vec<Diagnostic> {
        validate::all(&spec.wires.innfos)
    }

    fn diagnostic(&self, spec: &Spec, node: &str, message: String) -> Diagnostic {
        spec.wires.innfos.diagnostic(node, message)
    }

    fn frames(&self, spec: &Spec, packet: &super::Packet) -> Vec<Vec<u8>> {
        let innfos = &spec.wires.innfos.content;
        own(packet).map(|packet| validate::frames(innfos, packet)).unwrap_or_default()
    }

    fn asks<'a>(&self, spec: &'a Spec) -> Vec<Ask<'a>> {
        asks::all(&spec.wires.innfos.content)
    }

    fn misquoted(&self, spec: &Spec, requirement: &Requirement) -> Vec<String> {
        validate::misquoted(&spec.wires.innfos.content, requirement)
    }

    fn generate(&self, spec: &Spec) -> TokenStream {
        generate::module(&spec.wires.innfos.content)
    }

    #[cfg(feature = "exports")]
    fn exports(&self) -> &dyn super::Exports {
        self
    }
}

impl From<Packet> for super::Packet {
    fn from(packet: Packet) -> Self {
        Self::Innfos(packet)
    }
}

fn own(packet: &super::Packet) -> Option<&Packet> {
    let super::Packet::Innfos(packet) = packet else { return None };
    Some(packet)
}
