//! Frames that are none, and what is in one datagram or in two.

use actucheck_spec::wire::innfos::reference::PREFIX;

use super::{Talk, bytes_of, code, with_data};
use crate::adapter::{Pause, Piece};
use crate::suite::changed;
use crate::suite::check::Check;

const LENGTH: &str = "innfos.frame.length";
const LAYOUT: &str = "innfos.frame.layout";

/// Requests that are damaged: none is answered, and the next one is.
pub(super) fn damaged(talk: &Talk<'_>) -> Vec<Check> {
    let whole = bytes_of(&talk.ask(code::POSITION));
    let last = whole.len().saturating_sub(1);
    let mut checks = Vec::new();
    for bit in 0..8 {
        for (name, requirement, place) in
            [("header", "innfos.frame.header", 0), ("end", "innfos.frame.tail", last)]
        {
            let bytes = changed(&whole, place, |byte| byte ^ (1 << bit));
            let name = format!("damaged.{name}.bit-{bit}/silence");
            checks.push(talk.silence(&name, requirement, bytes));
        }
    }
    // A length without its data.
    for (name, high, low) in [("1", 0, 1), ("4", 0, 4), ("256", 1, 0), ("65535", 0xFF, 0xFF)] {
        let bytes = changed(&changed(&whole, 3, |_| high), 4, |_| low);
        checks.push(talk.silence(&format!("damaged.length-{name}/silence"), LENGTH, bytes));
    }
    for size in 1..whole.len() {
        let requirement = if size == last { "innfos.frame.tail" } else { LAYOUT };
        let bytes = whole.get(..size).unwrap_or_default().to_vec();
        checks.push(talk.silence(&format!("damaged.cut-{size}/silence"), requirement, bytes));
    }
    let (before, end) = whole.split_at(PREFIX);
    let with_crc = [before, &[0xFF, 0xFF], end].concat();
    checks.push(talk.silence("damaged.crc-of-nothing/silence", "innfos.frame.no-data", with_crc));
    checks.push(wrapped(talk));
    checks
}

/// A whole request in the data of one that is for nobody.
fn wrapped(talk: &Talk<'_>) -> Check {
    let inner = bytes_of(&talk.ask(code::POSITION));
    let bytes = bytes_of(&with_data(talk.absent(), code::SIGN_OF_LIFE, &inner));
    talk.silence("damaged.request-in-data/silence", "innfos.frame.transparent", bytes)
}

/// What the document leaves unspecified: several frames in a datagram, one in two, and other bytes.
pub(super) fn datagrams(talk: &Talk<'_>) -> Vec<Check> {
    let first = bytes_of(&talk.ask(code::POSITION));
    let second = bytes_of(&talk.ask(code::MODE));
    let record = |name: &str, bytes: Vec<u8>, what: &str| {
        let question = format!("How does it answer a datagram with {what}?");
        talk.record(&format!("datagram.{name}/answer"), LAYOUT, talk.then_hello(bytes), &question)
    };
    let damaged = changed(&first, first.len().saturating_sub(1), |_| 0);
    let mut in_two = talk.then_hello(Vec::new());
    let (head, tail) = first.split_at(PREFIX - 2);
    let piece = |after, bytes: &[u8]| Piece { after, bytes: bytes.to_vec().into() };
    in_two.send.splice(..1, [piece(Pause::None, head), piece(Pause::Moment, tail)]);
    vec![
        record("two", [first.clone(), second.clone()].concat(), "two requests"),
        record("damaged-and-one", [damaged, second].concat(), "a damaged request and a right one"),
        record(
            "noise-before",
            [&[0x00, 0x55], &first[..]].concat(),
            "other bytes before a request",
        ),
        record(
            "noise-behind",
            [&first[..], &[0x00, 0x55]].concat(),
            "other bytes behind a request",
        ),
        talk.record(
            "datagram.in-two/answer",
            LAYOUT,
            in_two,
            "How does it answer a request in two datagrams?",
        ),
    ]
}
