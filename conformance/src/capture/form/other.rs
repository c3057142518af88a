//! A line that is in another form than its input.

use super::decimal::Decimal;
use super::dump;
use super::escaped::Escaped;
use super::hex::Hex;
use super::text::Notation;
use crate::capture::{Form, line};
use crate::explain::stream::has_frame;

/// What is wrong with a line that can't be read in the input's form, but in another. A mistyped byte
/// may be a number of another form, but neither a packet nor a form with a mark of its own.
pub(super) fn instead(form: Form, line: &str) -> Option<String> {
    let sure = |other| matches!(other, Form::Dump | Form::Escaped);
    let mut meant = others(form, line).filter(|(other, bytes)| sure(*other) || has_frame(bytes));
    meant.next().map(|(other, _)| mixed(form, other))
}

/// What is wrong with a line without bytes in the input's form, if it has a packet in another. Fewer
/// bytes may be numbers of a log.
pub(super) fn forgotten(form: Form, line: &str) -> Option<String> {
    let mut packets = others(form, line).filter(|(_, bytes)| has_frame(bytes));
    packets.next().map(|(other, _)| mixed(form, other))
}

fn mixed(form: Form, other: Form) -> String {
    format!("this line has {other}, but the input is read as {form}; give one form at a time")
}

/// The other forms in which a line has bytes.
fn others(form: Form, line: &str) -> impl Iterator<Item = (Form, Vec<u8>)> {
    let others = [Form::Dump, Form::Hex, Form::Decimal, Form::Escaped];
    let others = others.into_iter().filter(move |other| *other != form);
    others.filter_map(move |other| Some((other, bytes(other, line)?)))
}

/// The bytes of a line in a form of text.
fn bytes(form: Form, line: &str) -> Option<Vec<u8>> {
    match form {
        Form::Hex => noted(&Hex, line),
        Form::Decimal => noted(&Decimal, line),
        Form::Escaped => noted(&Escaped, line),
        Form::Dump => dump::bytes(line),
        Form::Csv | Form::Pcap | Form::Raw => None,
    }
}

fn noted(notation: &impl Notation, line: &str) -> Option<Vec<u8>> {
    let (before, payload) = notation.split(line);
    let (_, marked) = line::read(before, payload);
    let mut parts = marked.iter().filter_map(|part| notation.bytes(&part.text).ok());
    parts.find(|bytes| !bytes.is_empty())
}
