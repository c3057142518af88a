//! The packets that the documents print or that were worked out by hand from their rules: what a call sends,
//! and what it returns of the answer beside it.

use actucheck_spec::model::{Outcome, Vector, VectorsFile};
use actucheck_spec::wire::Packet as AnyPacket;
use actucheck_spec::wire::dynamixel2::{Packet, WIRE};

use super::{Right, all, read};
use crate::adapter::{Called, Reported, Trouble};
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::due::Due;

const DEFECTS: &str = "ja40.defects";

pub(super) fn checks(author: &Author<'_>) -> Vec<Check> {
    let own = author.spec.vectors().filter(|(file, vector)| {
        file.wire == WIRE && vector.result == Outcome::Valid && vector.packet.is_some()
    });
    own.flat_map(|(file, vector)| Tested { author, file, vector }.checks()).collect()
}

/// A vector to make checks of.
struct Tested<'a> {
    author: &'a Author<'a>,
    file: &'a VectorsFile,
    vector: &'a Vector,
}

impl Tested<'_> {
    fn checks(&self) -> Vec<Check> {
        match packet(self.vector) {
            Some(Packet::Instruction { .. }) => self.asked(),
            // An answer that is there for its own sake is one to a Read.
            Some(Packet::Status { id: 1, params, .. }) if self.is_alone() => {
                let length = u16::try_from(params.len()).unwrap_or_default();
                vec![self.returned(&read(1, 132, length), &[self.vector])]
            }
            _ => Vec::new(),
        }
    }

    /// An instruction packet, and the answers to it.
    fn asked(&self) -> Vec<Check> {
        let Some(packet) = packet(self.vector) else { return Vec::new() };
        if Called::from(packet.clone()).call.is_none_or(|call| call.is_general) {
            return Vec::new();
        }
        let stem = self.vector.id.strip_suffix(".instruction");
        let answers = |vector: &&Vector| {
            let rest = stem.and_then(|stem| vector.id.strip_prefix(stem));
            rest.and_then(|rest| rest.strip_prefix(".status"))
                .is_some_and(|rest| matches!(rest, "" | ".1" | ".2"))
        };
        let answers: Vec<_> = self.file.vectors.iter().filter(answers).collect();
        let frames: Vec<_> = answers.iter().flat_map(|vector| vector.frame().to_vec()).collect();
        let right = Right::new(packet.clone(), frames, Due::default(), [""; 2]);
        let (id, requirement) = (self.id("sent"), self.requirement());
        let mut checks = vec![self.author.sent(id, &requirement, vec![right.step()])];
        if !answers.is_empty() {
            checks.push(self.returned(&packet, &answers));
        }
        for vector in answers {
            if let Some(printed) = vector.defective() {
                let right = Right { answer: printed.to_vec(), ..answered(&packet, &[vector]) };
                let (id, due) = (self.id("defect"), right.no_answer());
                checks.push(self.author.returned(id, DEFECTS, vec![right.step()], due));
            }
        }
        checks
    }

    /// What a call returns of these answers.
    fn returned(&self, packet: &Packet, answers: &[&Vector]) -> Check {
        let right = answered(packet, answers);
        let (id, steps) = (self.id("result"), vec![right.step()]);
        self.author.returned(id, &self.requirement(), steps, right.due)
    }

    /// Whether no instruction packet is beside an answer.
    fn is_alone(&self) -> bool {
        let mut others = self.file.vectors.iter();
        !others.any(|vector| vector.id.ends_with(".instruction"))
    }

    fn id(&self, about: &str) -> String {
        let name = self.vector.id.strip_suffix(".instruction").unwrap_or(&self.vector.id);
        format!("dynamixel2.host.vector.{name}/{about}")
    }

    /// That of all packets that a document prints, or the own one of a packet that was worked out.
    fn requirement(&self) -> String {
        let source = self.vector.source.as_ref().unwrap_or(&self.file.source);
        let of_document = || format!("{}.packets", source.document);
        let own = self.vector.requirement.clone().filter(|_| self.vector.printed.is_none());
        own.unwrap_or_else(of_document)
    }
}

/// A call and these answers.
fn answered(packet: &Packet, answers: &[&Vector]) -> Right {
    let is_ping = matches!(packet, Packet::Instruction { instruction: 0x01, .. });
    let devices: Vec<_> = answers
        .iter()
        .filter_map(|vector| self::packet(vector))
        .flat_map(|answer| told(answer, is_ping))
        .collect();
    let frames = answers.iter().flat_map(|vector| vector.frame().to_vec()).collect();
    // What a call makes of an alert is unspecified.
    let alert = devices.iter().any(|device| device.alert.is_some());
    let or = if alert { vec![Trouble::Status] } else { Vec::new() };
    Right::new(packet.clone(), frames, Due { or, ..all(devices) }, [""; 2])
}

fn packet(vector: &Vector) -> Option<Packet> {
    match &vector.packet {
        Some(AnyPacket::Dynamixel2(packet)) => Some(packet.clone()),
        _ => None,
    }
}

/// What an answer says of each device.
fn told(answer: Packet, is_ping: bool) -> Vec<Reported> {
    let device = |id: u8, error: u8, data: &[u8]| {
        let number = Some(error & 0x7F).filter(|number| *number != 0);
        let alert = (error & 0x80 != 0).then_some(true);
        let bare = Reported { id, error: number, alert, ..Reported::default() };
        match data {
            [] => bare,
            [low, high, firmware] if is_ping => Reported {
                model_number: Some(u16::from_le_bytes([*low, *high])),
                firmware_version: Some(*firmware),
                ..bare
            },
            data => Reported { data: Some(data.to_vec().into()), ..bare },
        }
    };
    match answer {
        Packet::Status { id, error, params } => vec![device(id, error, &params)],
        Packet::FastStatus { blocks } => {
            blocks.iter().map(|block| device(block.id, block.error, &block.data)).collect()
        }
        Packet::Instruction { .. } => Vec::new(),
    }
}
