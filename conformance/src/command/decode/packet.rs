//! One packet, field by field.

use actucheck::adapter::{Output, Question, Wire};
use actucheck::capture::Form;
use actucheck::explain::mistake;
use actucheck::explain::stream::lines::Line;
use actucheck::explain::stream::{Event, Place, Skipped, Summary};
use actucheck::explain::{Asked, Invalid, Warning, damaged, explain};
use actucheck::subject::{Answer, Builtin, Subject as _};
use actucheck_spec::wire::{Direction, Packet};
use serde::Serialize;

use super::super::shared::Failure;
use super::super::shared::stream::{fields, fits, fitted, warned, width};
use super::super::shared::table::BOLD;

/// The packet in words, or as an object for the form of the bytes; and whether it is one.
pub(super) fn text(
    wire: Wire,
    asked: &Asked<'_>,
    warnings: &[Warning],
    json: Option<Form>,
) -> Result<(String, bool), Failure> {
    let both = || Direction::ALL.map(|direction| wire.decode(asked.bytes, &direction.into()));
    if asked.context.direction.is_none()
        && !wire.tells_direction()
        && both().iter().any(Result::is_ok)
    {
        let message = format!(
            "a frame of {wire} does not state its direction; add --direction request or \
             --direction reply"
        );
        return Err(Failure::usage(message));
    }
    let explanation = match (explain(wire, asked), json) {
        (Ok(explanation), _) => explanation,
        (Err(error), None) => return Ok((damaged_packet(wire, asked, &error), false)),
        (Err(error), Some(form)) => return Ok((lines(wire, asked, &error, form)?, false)),
    };
    check_direction(wire, asked)?;
    if json.is_some() {
        return object(wire, asked, warnings).map(|text| (text, true));
    }
    let (title, fields) = (&explanation.title, fields(&explanation.rows));
    let text = format!("{BOLD}{title}{BOLD:#}\n{}{fields}", warned(warnings));
    Ok((fitted(&text, width()), true))
}

/// What is wrong with the bytes, what can be read of them all the same, and what may explain them.
fn damaged_packet(wire: Wire, asked: &Asked<'_>, error: &Invalid) -> String {
    let fits = fits(&mistake::fits(wire, asked.bytes, &asked.context));
    let fields = fields(&damaged(wire, asked));
    fitted(&format!("{BOLD}no valid packet{BOLD:#}, {error}\n{fields}{fits}"), width())
}

/// Lines as those of a stream, with the reason that one packet was expected.
fn lines(wire: Wire, asked: &Asked<'_>, error: &Invalid, form: Form) -> Result<String, Failure> {
    let Asked { bytes, tables, address, .. } = *asked;
    let event = Event::Skipped(Skipped {
        place: Place::default(),
        context: asked.context.clone(),
        address,
        count: bytes.len() as u64,
        bytes,
        reason: "no valid packet".to_owned(),
        notes: vec![error.to_string()],
        tables,
    });
    let mut summary = Summary::default();
    summary.add(&event);
    let lines =
        [Line::header(wire, Some(form)), Line::of(wire, &event, true), Line::summary(&summary)];
    lines.iter().map(line).collect()
}

/// An object on a line.
fn line(object: &impl Serialize) -> Result<String, Failure> {
    serde_json::to_string(object).map(|text| text + "\n").map_err(Failure::incomplete)
}

/// Refuses a packet whose direction is not the one that the user gave.
fn check_direction(wire: Wire, asked: &Asked<'_>) -> Result<(), Failure> {
    let found = wire.decode(asked.bytes, &asked.context).map(|packet| packet.direction());
    match (asked.context.direction, found) {
        (Some(told), Ok(found)) if told != found => {
            Err(Failure::failed(format!("no valid {told}: the packet is a {found}")))
        }
        _ => Ok(()),
    }
}

/// The packet as JSON of the adapter protocol, with warnings if there are any.
fn object(wire: Wire, asked: &Asked<'_>, warnings: &[Warning]) -> Result<String, Failure> {
    let bytes = asked.bytes.to_vec().into();
    let op = Question::Decode { wire, bytes, context: asked.context.clone() };
    match Builtin::default().ask(&op) {
        Answer::Ok(Output::Packet(packet)) => line(&Object { packet, warnings }),
        Answer::Rejected(rejection) => Err(Failure::failed(rejection.detail)),
        other => Err(Failure::incomplete(format!("no packet: {other:?}"))),
    }
}

/// A packet with what is wrong in its meaning.
#[derive(Serialize)]
struct Object<'a> {
    #[serde(flatten)]
    packet: Packet,
    #[serde(skip_serializing_if = "<[Warning]>::is_empty")]
    warnings: &'a [Warning],
}
