//! Checks of DYNAMIXEL Protocol 2.0 and its JA dialect.
//!
//! - basics: single sentences, on which every other check rests;
//! - vectors: the test vectors;
//! - lengths: every length, and the pattern of byte stuffing at every place;
//! - exhaustive: every case of small sets, such as short bodies and all instructions;
//! - ids: every ID;
//! - devices: 1 to 253 devices in the instructions for several;
//! - addresses: every instruction that has an address, at the ends;
//! - crc: bodies after which the CRC looks like stuffing;
//! - instructions: single instructions and their answers;
//! - fast: fast status packets, which answer several devices' requests at once;
//! - negative: packets that break one rule of the receive procedure;
//! - streams: packets in a stream, cut into chunks in several ways;
//! - limits: packets at the limits that an implementation states, and above them;
//! - unspecified: questions that the documents leave unspecified;
//! - values: what the bytes of registers mean;
//! - generated: packets and streams that are generated from a seed.

mod addresses;
pub(super) mod basics;
pub(crate) mod crc;
mod devices;
mod exhaustive;
mod fast;
pub(crate) mod generated;
mod ids;
mod instructions;
mod kind;
mod lengths;
mod limits;
mod negative;
mod requests;
mod streams;
mod unspecified;
pub(super) mod values;
mod vectors;

use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2::Packet;
use actucheck_spec::wire::dynamixel2::reference::PREFIX;

use crate::adapter::{Called, Output, Question};
use crate::names::as_word;
use crate::suite::check::{Check, Demand, Unspecified, Way};
use crate::suite::plan::Family;
use crate::suite::{Author, Options};

/// Size in bytes of the largest packet that a two-byte length allows.
const LARGEST: usize = 65_535 + PREFIX;

/// Parameters of a Clear and of a Control Table Backup: what is done, and the key.
const CLEAR: [u8; 5] = [0x01, 0x44, 0x58, 0x4C, 0x22];
const BACKUP: [u8; 5] = [0x01, 0x43, 0x54, 0x52, 0x4C];

/// What the checks of a packet are called.
const BOTH_WAYS: [&str; 2] = ["/encode", "/decode"];

pub(super) fn families<'a>(author: Author<'a>, options: &Options) -> Vec<Family<'a>> {
    let mut families = vec![values::basics(author), vectors::family(author)];
    families.push(lengths::family(author, options.limits));
    families.extend(exhaustive::families(author, options));
    families.extend(ids::families(author));
    families.push(devices::family(author));
    families.extend(addresses::families(author));
    families.extend(crc::families(author));
    families.push(Family::of("", move || instructions::checks(&author)));
    families.extend(fast::families(author));
    families.push(negative::family(author));
    families.extend(streams::families(author, options));
    families.extend(limits::families(author, options.limits));
    families.push(Family::of("dynamixel2.open.", move || unspecified::checks(&author)));
    families.extend(values::families(author));
    families.push(generated::family(author, options.seed, options.cases));
    families
}

impl Author<'_> {
    /// Encodes and decodes one packet; the reference model gives the right answers.
    fn both_ways(&self, id: &str, requirement: &str, packet: &Packet) -> Vec<Check> {
        let packet = packet.clone().into();
        let Some(bytes) = self.wire.encode(&packet) else { return Vec::new() };
        let encode = Question::Encode { wire: self.wire, packet: Called::from(packet.clone()) };
        let decode = Question::Decode {
            wire: self.wire,
            bytes: bytes.clone().into(),
            context: packet.context(),
        };
        let (bytes, packet) = (Output::Bytes(bytes.into()), Output::Packet(packet));
        vec![
            self.check(format!("{id}/encode"), requirement, encode, Demand::Yield(bytes)),
            self.check(
                format!("{id}/decode"),
                of_reading(requirement),
                decode,
                Demand::Yield(packet),
            ),
        ]
    }
}

/// The same check, but no sentence demands that such a packet is built or read. So the answer is
/// recorded.
fn recorded(check: Check, what: &str) -> Check {
    let Demand::Yield(output) = check.demand else { return check };
    let (asked, way) = match check.question {
        Question::Encode { .. } => ("built", "builds it"),
        Question::Decode { .. } => ("read", "reads it"),
        Question::Stream { .. } => ("found in a stream", "finds it"),
        _ => ("taken", "takes it"),
    };
    let question = format!("Is {what} {asked}?");
    let ways = vec![Way { name: way.to_owned(), output }];
    Check { demand: Demand::Record(Unspecified { question, ways }), ..check }
}

/// The requirement on a receiver that corresponds to one on a sender.
fn of_reading(requirement: &str) -> &str {
    match requirement {
        "dynamixel2.stuffing.transmit" => "dynamixel2.stuffing.receive",
        other => other,
    }
}

/// The requirement on a sender that corresponds to one on a receiver.
fn of_building(requirement: &str) -> &str {
    match requirement {
        "dynamixel2.stuffing.receive" => "dynamixel2.stuffing.transmit",
        other => other,
    }
}

/// The requirement on an instruction's parameters: `dynamixel2.sync-read.parameters`.
pub(crate) fn parameters_of(spec: &Spec, name: &str) -> String {
    let name = as_word(name);
    let name = if name == "control-table-backup" { "backup".to_owned() } else { name };
    let ids = ["dynamixel2", "ja40"].map(|document| format!("{document}.{name}.parameters"));
    ids.into_iter()
        .find(|id| spec.requirement(id).is_some())
        .unwrap_or_else(|| "dynamixel2.packet.parameters".to_owned())
}
