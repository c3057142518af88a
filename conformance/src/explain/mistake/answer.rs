//! The mistake that explains a wrong answer, where the right one is known.

use actucheck_spec::wire::Wire;

use super::name::{CRC_SWAPPED, NO_STUFFING, OTHER_CRC, STUFFING_TWICE};
use super::{ALGORITHMS, Fit, LONGEST};
use crate::adapter::{Output, Question};
use crate::explain::Own;

/// The likeliest mistake of a program that makes the actual answer of the expected one.
#[must_use]
pub fn of_answer(question: &Question, expected: &Output, actual: &Output) -> Option<Fit> {
    match (question, expected, actual) {
        (Question::Encode { wire, .. }, Output::Bytes(expected), Output::Bytes(actual)) => {
            frame(*wire, expected, actual)
        }
        (Question::Stuff { wire, bytes }, Output::Bytes(expected), Output::Bytes(actual)) => {
            if actual == bytes {
                return Some(one(NO_STUFFING, "byte stuffing is left out".to_owned()));
            }
            let twice = wire.stuff(expected).is_some_and(|twice| twice == actual.0);
            twice.then(|| one(STUFFING_TWICE, "byte stuffing is added twice".to_owned()))
        }
        (Question::Crc { bytes, .. }, Output::Crc(expected), Output::Crc(actual)) => {
            let [expected, actual] = [*expected, *actual].map(u16::try_from);
            crc(bytes, expected.ok()?, actual.ok()?)
        }
        _ => None,
    }
}

fn frame(wire: Wire, meant: &[u8], bytes: &[u8]) -> Option<Fit> {
    let mistakes = Own::of(wire)?.mistakes.iter().filter(|mistake| mistake.by_program);
    let (is_meant, short) = (|bytes: &[u8]| bytes == meant, bytes.len() <= LONGEST);
    let mut fits = mistakes.filter(|_| short).filter_map(|it| it.fit(bytes, &is_meant, &[]));
    fits.find(|fit| !fit.meant.is_empty())
}

fn crc(bytes: &[u8], expected: u16, actual: u16) -> Option<Fit> {
    if actual == expected.swap_bytes() {
        return Some(one(CRC_SWAPPED, "the two bytes of the CRC are swapped".to_owned()));
    }
    let algorithm = ALGORITHMS.iter().find(|algorithm| algorithm.checksum(bytes) == actual)?;
    Some(one(OTHER_CRC, format!("the CRC is {}", algorithm.name)))
}

fn one(mistake: &'static str, condition: String) -> Fit {
    Fit { mistake, conditions: vec![condition], more: 0, trials: 1, meant: Vec::new() }
}
