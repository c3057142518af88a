//! The test vectors: packets that the documents print, and packets that were worked out by hand
//! from their rules. Each yields one check per op.

use actucheck_spec::model::{Citation, Fault, HexBytes, Outcome, Vector, VectorsFile};
use actucheck_spec::wire::dynamixel2::reference::PREFIX;
use actucheck_spec::wire::{Packet, dynamixel2};

use super::{of_building, of_reading};
use crate::adapter::{Output, Question, Wire};
use crate::suite::Author;
use crate::suite::check::{Check, Demand};
use crate::suite::codec::vector::demand;
use crate::suite::plan::{Family, by_stem};

/// Bytes after the body.
const CRC: usize = 2;

pub(super) fn family(author: Author<'_>) -> Family<'_> {
    let (spec, wire) = (author.spec, author.wire);
    Family::new("", move || {
        spec.vectors()
            .filter(move |(file, _)| file.wire == wire)
            .map(move |(file, vector)| Tested { author, wire, file, vector })
            .flat_map(|vector| by_stem(vector.checks()))
    })
}

/// A vector to make checks of.
struct Tested<'a> {
    author: Author<'a>,
    wire: Wire,
    file: &'a VectorsFile,
    vector: &'a Vector,
}

impl Tested<'_> {
    fn checks(&self) -> Vec<Check> {
        let of_document = format!("{}.packets", self.source().document);
        let own = self.vector.requirement.as_deref().unwrap_or(&of_document);
        let frame = self.vector.frame();
        let mut checks = Vec::new();
        match &self.vector.packet {
            Some(packet) => {
                checks.push(self.crc(frame));
                checks.extend(self.stuffing(packet, frame));
                checks.push(self.encode(own, packet, frame));
                checks.push(self.decode(own, packet, frame));
                checks.extend(self.streams(packet, frame));
            }
            None => checks
                .extend(self.vector.fault.map(|fault| self.rejects("decode", own, frame, fault))),
        }
        if let (Some(printed), Some(fault)) = (self.vector.defective(), self.vector.printed_fault) {
            checks.push(self.rejects("decode-printed", "ja40.defects", printed, fault));
        }
        checks
    }

    fn check(&self, name: &str, requirement: &str, op: Question, demand: Demand) -> Check {
        let id = format!("{}/{name}", self.vector.id);
        let source = self.source().clone();
        Check { source, ..self.author.check(id, requirement, op, demand) }
    }

    fn source(&self) -> &Citation {
        self.vector.source.as_ref().unwrap_or(&self.file.source)
    }

    /// What the vector demands, if `output` is the right answer.
    fn demand(&self, output: Output) -> Demand {
        demand(self.author.spec, self.vector, output, Vec::new())
    }

    fn crc(&self, frame: &[u8]) -> Check {
        let (bytes, crc) = frame.split_at(frame.len().saturating_sub(CRC));
        let value = crc.iter().rev().fold(0, |value, byte| value << 8 | u64::from(*byte));
        let op = Question::Crc { wire: self.wire, bytes: bytes.to_vec().into() };
        let demand = Demand::Yield(Output::Crc(value));
        self.check("crc", "dynamixel2.crc.value", op, demand)
    }

    /// The body alone, both ways. A fast status has no stuffing.
    fn stuffing(&self, packet: &Packet, frame: &[u8]) -> Vec<Check> {
        let Packet::Dynamixel2(packet) = packet else { return Vec::new() };
        let plain: HexBytes = match packet {
            dynamixel2::Packet::Instruction { instruction, params, .. } => {
                [&[*instruction], params.0.as_slice()].concat().into()
            }
            dynamixel2::Packet::Status { error, params, .. } => {
                [&[0x55, *error], params.0.as_slice()].concat().into()
            }
            dynamixel2::Packet::FastStatus { .. } => return Vec::new(),
        };
        let stuffed: HexBytes = frame
            .get(PREFIX..frame.len().saturating_sub(CRC))
            .map(<[u8]>::to_vec)
            .unwrap_or_default()
            .into();
        let wire = self.wire;
        vec![
            self.check(
                "stuff",
                "dynamixel2.stuffing.transmit",
                Question::Stuff { wire, bytes: plain.clone() },
                Demand::Yield(Output::Bytes(stuffed.clone())),
            ),
            self.check(
                "unstuff",
                "dynamixel2.stuffing.receive",
                Question::Unstuff { wire, bytes: stuffed },
                Demand::Yield(Output::Bytes(plain)),
            ),
        ]
    }

    fn encode(&self, requirement: &str, packet: &Packet, frame: &[u8]) -> Check {
        let op = Question::Encode { wire: self.wire, packet: packet.clone().into() };
        let demand = self.demand(Output::Bytes(frame.to_vec().into()));
        self.check("encode", of_building(requirement), op, demand)
    }

    fn decode(&self, requirement: &str, packet: &Packet, frame: &[u8]) -> Check {
        let op = Question::Decode {
            wire: self.wire,
            bytes: frame.to_vec().into(),
            context: packet.context(),
        };
        self.check(
            "decode",
            of_reading(requirement),
            op,
            self.demand(Output::Packet(packet.clone())),
        )
    }

    /// The frame as a stream, whole and byte by byte. A stream does not say which request a fast
    /// status packet answers, and a packet that may be rejected may be missing.
    fn streams(&self, packet: &Packet, frame: &[u8]) -> Vec<Check> {
        let is_unspecified = self.vector.result == Outcome::Acceptable;
        if is_unspecified || packet.context().fast.is_some() {
            return Vec::new();
        }
        let whole = vec![frame.to_vec().into()];
        let bytewise = frame.iter().map(|byte| vec![*byte].into()).collect();
        let of_document = format!("{}.packets", self.source().document);
        [
            ("stream", &*of_document, whole),
            ("stream-bytewise", "dynamixel2.receive.stream", bytewise),
        ]
        .into_iter()
        .map(|(name, requirement, chunks)| {
            let op =
                Question::Stream { wire: self.wire, chunks, direction: Some(packet.direction()) };
            let demand = Demand::Yield(Output::Packets(vec![packet.clone()]));
            let check = self.check(name, requirement, op, demand);
            Check { requires: Some(format!("{}/decode", self.vector.id)), ..check }
        })
        .collect()
    }

    fn rejects(&self, name: &str, requirement: &str, bytes: &[u8], fault: Fault) -> Check {
        let op = Question::Decode {
            wire: self.wire,
            bytes: bytes.to_vec().into(),
            context: self.vector.context(),
        };
        self.check(name, requirement, op, Demand::Reject(fault))
    }
}
