//! A conversation in rows: each call, what passed on the line, and what was returned.

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::Direction;

use crate::adapter::{Asked, Called, Course, Heard, Output, Passed, Question, Step};
use crate::verdict::Outcome;

/// A row of a conversation, with its label.
pub(super) type Row = (&'static str, String);

/// The rows of a conversation; `None` if the outcome is of another question.
pub(super) fn rows(outcome: &Outcome) -> Option<Vec<Row>> {
    let steps = match &outcome.request {
        Some(Question::Converse { steps, .. }) => steps,
        Some(Question::Device { steps, .. }) => {
            return Some(device_rows(steps, outcome.actual.as_ref()));
        }
        _ => return None,
    };
    let courses: &[Course] = match &outcome.actual {
        Some(Output::Conversation(courses)) => courses,
        _ => &[],
    };
    let courses = courses.iter().map(Some).chain(std::iter::repeat(None));
    Some(steps.iter().zip(courses).flat_map(|(step, course)| step_rows(step, course)).collect())
}

fn step_rows(step: &Step, course: Option<&Course>) -> Vec<Row> {
    let mut rows = vec![("call", call(&step.packet))];
    let Some(course) = course else {
        let bursts = step.answers.first().into_iter().flatten();
        rows.extend(bursts.map(|burst| ("answer", spaced(&burst.bytes))));
        return rows;
    };
    rows.extend(line_rows(&course.line, course.more));
    rows.push(("returned", format!("{} after {} ms", course.returned, course.ms)));
    if !step.late.is_empty() {
        rows.push(("late", spaced(&step.late)));
    }
    rows
}

/// What was sent to a device and what came back, or what would be sent.
fn device_rows(steps: &[Asked], actual: Option<&Output>) -> Vec<Row> {
    let heard: &[Heard] = match actual {
        Some(Output::Line(heard)) => heard,
        _ => &[],
    };
    let heard = heard.iter().map(Some).chain(std::iter::repeat(None));
    let rows = |(step, heard): (&Asked, Option<&Heard>)| {
        let packet = step.packet.as_ref().map(|packet| ("packet", call(packet)));
        let passed = match heard {
            Some(heard) => line_rows(&heard.line, heard.more),
            None => step.send.iter().map(|piece| ("sent", spaced(&piece.bytes))).collect(),
        };
        packet.into_iter().chain(passed).collect::<Vec<_>>()
    };
    steps.iter().zip(heard).flat_map(rows).collect()
}

/// What passed on a line, and how many bytes are not among that.
fn line_rows(line: &[Passed], more: usize) -> Vec<Row> {
    let row = |Passed { at_ms, direction, bytes }: &Passed| {
        let label = if *direction == Direction::Request { "sent" } else { "answer" };
        (label, format!("{} at {at_ms} ms", spaced(bytes)))
    };
    let more = (more > 0).then(|| ("and", format!("{more} bytes more")));
    line.iter().map(row).chain(more).collect()
}

/// The call as the adapter gets it, without quotes.
fn call(packet: &Called) -> String {
    let call = packet.call.as_ref().and_then(|call| serde_json::to_string(call).ok());
    let text = call.unwrap_or_default();
    let text = text.trim_start_matches("{\"name\":").trim_end_matches('}').replace('"', "");
    let (name, fields) = text.split_once(',').unwrap_or((&text, ""));
    let id = packet.packet.wire().device(&packet.packet);
    let fields = fields.replace(':', " ").replace(',', ", ");
    let sign = if fields.is_empty() { "" } else { ": " };
    format!("{name} of device {id}{sign}{fields}")
}

fn spaced(bytes: &HexBytes) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}
