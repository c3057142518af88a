//! One packet, field by field.

use actucheck::adapter::{Output, Question, Wire};
use actucheck::explain::{Asked, Explanation, Warning, explain};
use actucheck::subject::{Answer, Builtin, Subject as _};

use actucheck_spec::wire::Packet;
use serde::Serialize;

use super::super::shared::Failure;
use super::super::shared::table::{self, BOLD};

/// Explains the packet, or prints it as an object.
pub(super) fn text(
    wire: Wire,
    asked: &Asked<'_>,
    warnings: &[Warning],
    json: bool,
) -> Result<String, Failure> {
    if asked.context.direction.is_none() && !wire.tells_direction() {
        let message = format!(
            "a frame of {wire} does not state its direction; add --direction request or \
             --direction reply"
        );
        return Err(Failure::usage(message));
    }
    let explanation = explain(wire, asked)
        .map_err(|error| Failure::failed(format!("no valid packet, {error}")))?;
    check_direction(wire, asked)?;
    if json {
        return object(wire, asked, warnings);
    }
    let (title, fields) = (&explanation.title, fields(&explanation));
    Ok(format!("{BOLD}{title}{BOLD:#}\n{}{fields}\n", warned(warnings)))
}

/// The warnings as lines.
pub(super) fn warned(warnings: &[Warning]) -> String {
    let line = |warning| format!("       {BOLD}warning{BOLD:#}: {warning}\n");
    warnings.iter().map(line).collect::<Vec<_>>().concat()
}

/// The fields as lines.
pub(super) fn fields(explanation: &Explanation) -> String {
    let rows = explanation.rows.iter().map(|row| {
        let offset = format!("{:>5}", row.offset);
        [offset, row.bytes.clone(), row.field.clone(), row.meaning.clone()]
    });
    table::lines("", &rows.collect::<Vec<_>>()).join("\n")
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
        Answer::Ok(Output::Packet(packet)) => {
            let object = Object { packet, warnings };
            serde_json::to_string(&object).map(|text| text + "\n").map_err(Failure::incomplete)
        }
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
