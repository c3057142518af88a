//! A conversation in rows: each call, what passed on the line, and what was returned.

use actucheck_spec::model::HexBytes;
use actucheck_spec::wire::Direction;

use crate::adapter::{Course, Output, Passed, Question, Step};
use crate::verdict::Outcome;

/// A row of a conversation, with its label.
pub(super) type Row = (&'static str, String);

/// The rows of a conversation; `None` if the outcome is of another question.
pub(super) fn rows(outcome: &Outcome) -> Option<Vec<Row>> {
    let Some(Question::Converse { steps, .. }) = &outcome.request else { return None };
    let courses: &[Course] = match &outcome.actual {
        Some(Output::Conversation(courses)) => courses,
        _ => &[],
    };
    let courses = courses.iter().map(Some).chain(std::iter::repeat(None));
    Some(steps.iter().zip(courses).flat_map(|(step, course)| step_rows(step, course)).collect())
}

fn step_rows(step: &Step, course: Option<&Course>) -> Vec<Row> {
    let mut rows = vec![("call", call(step))];
    let Some(course) = course else {
        let bursts = step.answers.first().into_iter().flatten();
        rows.extend(bursts.map(|burst| ("answer", spaced(&burst.bytes))));
        return rows;
    };
    rows.extend(course.line.iter().map(|Passed { at_ms, direction, bytes }| {
        let label = if *direction == Direction::Request { "sent" } else { "answer" };
        (label, format!("{} at {at_ms} ms", spaced(bytes)))
    }));
    if course.more > 0 {
        rows.push(("and", format!("{} bytes more", course.more)));
    }
    rows.push(("returned", format!("{} after {} ms", course.returned, course.ms)));
    if !step.late.is_empty() {
        rows.push(("late", spaced(&step.late)));
    }
    rows
}

/// The call as the adapter gets it, without quotes.
fn call(step: &Step) -> String {
    let call = step.packet.call.as_ref().and_then(|call| serde_json::to_string(call).ok());
    let text = call.unwrap_or_default();
    let text = text.trim_start_matches("{\"name\":").trim_end_matches('}').replace('"', "");
    let (name, fields) = text.split_once(',').unwrap_or((&text, ""));
    let id = step.packet.packet.wire().device(&step.packet.packet);
    let fields = fields.replace(':', " ").replace(',', ", ");
    let sign = if fields.is_empty() { "" } else { ": " };
    format!("{name} of device {id}{sign}{fields}")
}

fn spaced(bytes: &HexBytes) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}
