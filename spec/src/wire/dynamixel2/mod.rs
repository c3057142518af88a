//! DYNAMIXEL Protocol 2.0 and its JA dialect.

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
    Dynamixel2, ErrorNumber, Field, Framing, Instruction, Size, StatusFormat, Stuffing,
};
pub use packet::{Block, Packet};

use super::{Ask, Call, Cited, Context, Direction, Fields, Rules, Wire};
use crate::model::{Fault, HexBytes, Requirement};
use crate::{Diagnostic, Spec};

/// The wire.
pub const WIRE: Wire = Wire::new(&This);

struct This;

impl Rules for This {
    fn id(&self) -> &'static str {
        "dynamixel2"
    }

    fn title(&self) -> &'static str {
        "DYNAMIXEL Protocol 2.0 and its JA dialect"
    }

    fn kinds(&self) -> &'static [&'static str] {
        &["instruction", "status", "fast_status"]
    }

    fn packet(&self, fields: Fields) -> Result<super::Packet, serde_json::Error> {
        serde_json::from_value(Value::Object(fields)).map(super::Packet::Dynamixel2)
    }

    fn direction(&self, packet: &super::Packet) -> Direction {
        match packet {
            super::Packet::Dynamixel2(Packet::Instruction { .. }) => Direction::Request,
            _ => Direction::Reply,
        }
    }

    fn payload<'a>(&self, packet: &'a super::Packet) -> Vec<&'a HexBytes> {
        match own(packet) {
            Some(Packet::Instruction { params, .. } | Packet::Status { params, .. }) => {
                vec![params]
            }
            Some(Packet::FastStatus { blocks }) => blocks.iter().map(|block| &block.data).collect(),
            None => Vec::new(),
        }
    }

    fn difference(&self, expected: &super::Packet, actual: &super::Packet) -> &'static str {
        match (own(expected), own(actual)) {
            (Some(expected), Some(actual)) => expected.difference(actual),
            _ => "kind of packet",
        }
    }

    fn context(&self, packet: &super::Packet) -> Context {
        Context {
            fast: own(packet).and_then(Packet::asked_for),
            direction: Some(self.direction(packet)),
        }
    }

    fn tells_direction(&self) -> bool {
        true
    }

    fn checksum(&self, bytes: &[u8]) -> Vec<u64> {
        vec![reference::crc(bytes).into()]
    }

    fn stuff(&self, body: &[u8]) -> Option<Vec<u8>> {
        Some(reference::stuff(body))
    }

    fn unstuff(&self, stuffed: &[u8]) -> Option<Result<Vec<u8>, Fault>> {
        Some(reference::unstuff(stuffed))
    }

    fn shortest_frame(&self) -> usize {
        reference::PREFIX + 3 // instruction and CRC
    }

    fn encode(&self, packet: &super::Packet) -> Option<Vec<u8>> {
        reference::encode(own(packet)?)
    }

    fn decode(&self, bytes: &[u8], context: &Context) -> Result<super::Packet, Fault> {
        let packet = match &context.fast {
            Some(fast) => reference::decode_fast(bytes, fast),
            None => reference::decode(bytes),
        };
        packet.map(Into::into)
    }

    fn stream(&self, chunks: &[HexBytes], _direction: Option<Direction>) -> Vec<super::Packet> {
        let stream: Vec<u8> = chunks.iter().flat_map(|chunk| chunk.0.clone()).collect();
        reference::packets(&stream).into_iter().map(Into::into).collect()
    }

    fn is_unspecified(&self, bytes: &[u8], context: &Context) -> bool {
        context.fast.is_none() && reference::is_unspecified(bytes)
    }

    fn call(&self, packet: &super::Packet) -> Option<Call> {
        own(packet).map(reference::call)
    }

    fn calls(&self) -> &'static [&'static str] {
        &reference::CALLS
    }

    fn device(&self, packet: &super::Packet) -> u8 {
        match own(packet) {
            Some(Packet::Instruction { id, .. } | Packet::Status { id, .. }) => *id,
            _ => reference::BROADCAST,
        }
    }

    fn part(&self, frame: &[u8], offset: usize) -> &'static str {
        reference::part(frame, offset)
    }

    fn repair(&self, frame: &mut [u8]) {
        reference::repair(frame);
    }

    fn cited<'a>(&self, spec: &'a Spec) -> Vec<Cited<'a>> {
        validate::cited(&spec.wires.dynamixel2.content)
    }

    fn validate(&self, spec: &Spec) -> Vec<Diagnostic> {
        validate::all(&spec.wires.dynamixel2)
    }

    fn diagnostic(&self, spec: &Spec, node: &str, message: String) -> Diagnostic {
        spec.wires.dynamixel2.diagnostic(node, message)
    }

    fn frames(&self, spec: &Spec, packet: &super::Packet) -> Vec<Vec<u8>> {
        let own = own(packet);
        own.map(|packet| validate::frame(&spec.wires.dynamixel2.content, packet))
            .into_iter()
            .collect()
    }

    fn asks<'a>(&self, spec: &'a Spec) -> Vec<Ask<'a>> {
        asks::all(&spec.wires.dynamixel2.content)
    }

    fn misquoted(&self, spec: &Spec, requirement: &Requirement) -> Vec<String> {
        validate::misquoted(&spec.wires.dynamixel2.content, requirement)
    }

    fn generate(&self, spec: &Spec) -> TokenStream {
        generate::module(&spec.wires.dynamixel2.content)
    }

    #[cfg(feature = "exports")]
    fn exports(&self) -> &dyn super::Exports {
        self
    }
}

impl From<Packet> for super::Packet {
    fn from(packet: Packet) -> Self {
        Self::Dynamixel2(packet)
    }
}

fn own(packet: &super::Packet) -> Option<&Packet> {
    let super::Packet::Dynamixel2(packet) = packet else { return None };
    Some(packet)
}
