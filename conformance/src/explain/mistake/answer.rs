//! The mistake that may explain a wrong answer, where the right one is known.

use actucheck_spec::wire::{Packet, Wire};

use super::name::{CRC_SWAPPED, NO_STUFFING, OTHER_CRC, STUFFING_LEFT, STUFFING_TWICE};
use super::{ALGORITHMS, LONGEST};
use crate::adapter::{Output, Question};
use crate::explain::Own;

/// The likeliest mistake of a program that makes the actual answer of the expected one: its name, and
/// what must hold, in words.
#[must_use]
pub fn of_answer(
    question: &Question,
    expected: &Output,
    actual: &Output,
) -> Option<(&'static str, String)> {
    match (question, expected, actual) {
        (Question::Encode { wire, .. }, Output::Bytes(expected), Output::Bytes(actual)) => {
            frame(*wire, expected, actual)
        }
        (Question::Stuff { wire, bytes }, Output::Bytes(expected), Output::Bytes(actual)) => {
            if actual == bytes {
                return Some((NO_STUFFING, "fits if byte stuffing is left out".to_owned()));
            }
            let twice = wire.stuff(expected).is_some_and(|twice| twice == actual.0);
            twice.then(|| (STUFFING_TWICE, "fits if byte stuffing is added twice".to_owned()))
        }
        (Question::Unstuff { bytes, .. }, Output::Bytes(_), Output::Bytes(actual)) => {
            (actual == bytes).then(stuffing_left)
        }
        (Question::Decode { wire, .. }, Output::Packet(expected), Output::Packet(actual)) => {
            has_stuffing(*wire, expected, actual).then(stuffing_left)
        }
        (Question::Stream { wire, .. }, Output::Packets(expected), Output::Packets(actual)) => {
            let differ = expected.iter().zip(actual).find(|(expected, actual)| expected != actual);
            let fits =
                differ.is_some_and(|(expected, actual)| has_stuffing(*wire, expected, actual));
            fits.then(stuffing_left)
        }
        (Question::Crc { bytes, .. }, Output::Crc(expected), Output::Crc(actual)) => {
            let [expected, actual] = [*expected, *actual].map(u16::try_from);
            crc(bytes, expected.ok()?, actual.ok()?)
        }
        _ => None,
    }
}

fn stuffing_left() -> (&'static str, String) {
    (STUFFING_LEFT, "fits if byte stuffing is not taken away".to_owned())
}

/// Whether a packet was read with its stuffing: who sent it so would stuff it twice.
fn has_stuffing(wire: Wire, expected: &Packet, actual: &Packet) -> bool {
    let frames = wire.encode(expected).zip(wire.encode(actual));
    let fit = frames.and_then(|(expected, actual)| frame(wire, &expected, &actual));
    fit.is_some_and(|(mistake, _)| mistake == STUFFING_TWICE)
}

fn frame(wire: Wire, meant: &[u8], bytes: &[u8]) -> Option<(&'static str, String)> {
    if bytes.len() > LONGEST {
        return None;
    }
    let is_meant = |bytes: &[u8]| bytes == meant;
    let mut mistakes = Own::of(wire)?.mistakes.iter().filter(|mistake| mistake.by_program);
    let fit = mistakes.find_map(|mistake| mistake.fit(bytes, &is_meant, &[]))?;
    Some((fit.mistake, fit.to_string()))
}

fn crc(bytes: &[u8], expected: u16, actual: u16) -> Option<(&'static str, String)> {
    if actual == expected.swap_bytes() {
        return Some((CRC_SWAPPED, "fits if the two bytes of the CRC are swapped".to_owned()));
    }
    let algorithm = ALGORITHMS.iter().find(|algorithm| algorithm.checksum(bytes) == actual)?;
    Some((OTHER_CRC, format!("fits if the CRC is {}", algorithm.name)))
}
