//! Basic checks of what packets say: a number of four bytes, then the order of its bytes.

use actucheck_spec::wire::Direction;
use actucheck_spec::wire::innfos::{Format, Packet, reference};

use super::{Said, is_unspecified, of_each_model, tables};
use crate::adapter::{Output, Question, Told};
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::plan::Family;

const PREFIX: &str = "innfos.basic.value-";

/// What a number may go wrong with, the requirement, and a number of which it is true.
const PARTS: [(&str, &str, [u8; 4]); 2] = [
    ("iq24", "innfos.value.iq24", [1; 4]),
    ("byte-order", "innfos.value.byte-order", [0x00, 0x12, 0x34, 0x56]),
];

pub(in crate::suite::codec::innfos) fn family(author: Author<'_>) -> Family<'_> {
    Family::of(PREFIX, move || {
        let all = Direction::ALL.into_iter().flat_map(|direction| {
            PARTS.into_iter().flat_map(move |(part, requirement, data)| {
                let id = format!("{PREFIX}{part}.{direction}");
                let said = number(author, direction, data);
                said.map_or_else(Vec::new, |said| said.checks(author, &id, requirement))
            })
        });
        all.collect::<Vec<Check>>()
    })
}

/// The first packet with a plain IQ24 number, with this one.
fn number(author: Author<'_>, direction: Direction, data: [u8; 4]) -> Option<Said<'_>> {
    let format = Some(Format::Iq24);
    let packets = tables::all(author, direction);
    let numbers = packets
        .flat_map(|packet| of_each_model(author, &Packet { data: data.to_vec().into(), ..packet }));
    let mut plain = numbers.filter(|said| {
        let row = said.row;
        row.format_in(direction) == format
            && row.full_scale.is_none()
            && row.unit.as_deref() != Some("R")
            && !is_unspecified(author, row, format)
    });
    plain.next()
}

/// The ids of the basic checks that an answer rests on, the most basic first.
pub(in crate::suite::codec) fn rests_on(
    question: &Question,
    expected: Option<&Output>,
) -> Vec<String> {
    let (op, direction, frame) = match (question, expected) {
        (Question::Message { told: Told::Frame { direction, bytes }, .. }, _) => {
            ("message", *direction, bytes)
        }
        (Question::Message { told: Told::Message { message }, .. }, Some(Output::Bytes(bytes))) => {
            ("message-frame", message.direction, bytes)
        }
        _ => return Vec::new(),
    };
    let has_number = reference::decode(direction, frame).is_ok_and(|packet| packet.data.len() == 4);
    let parts = PARTS.into_iter().filter(|_| has_number);
    parts.map(|(part, ..)| format!("{PREFIX}{part}.{direction}/{op}")).collect()
}
