//! Questions that any library behind an adapter has an answer to.

use serde_json::Value;

use super::talk::Answer;
use super::{Problem, shape};
use crate::check::{Check, Demand};
use crate::protocol::{Hello, Op, Output};

/// The checks whose questions are asked, an op and wire at least once.
const CHECKS: [&str; 11] = [
    "dynamixel2.write.instruction/crc",
    "dynamixel2.stuffing.data/stuff",
    "dynamixel2.stuffing.data/unstuff",
    "dynamixel2.write.instruction/encode",
    "dynamixel2.read.status/decode",
    "ja40.fast-sync-read.status/decode",
    "dynamixel2.read.status/stream",
    "innfos.iq.sixty-revolutions/crc",
    "innfos.iq.sixty-revolutions/encode",
    "innfos.iq.sixty-revolutions/decode",
    "innfos.request.command.06/stream-twice",
];

/// A question of the documents, as it goes to the adapter.
#[derive(Clone, Debug)]
pub(super) struct Example {
    pub(super) op: Op,
    pub(super) request: String,
    /// What the documents demand.
    right: Option<Output>,
}

impl Example {
    /// The questions, taken out of the checks of all wires.
    pub(super) fn all(checks: &[Check]) -> Vec<Self> {
        let check = |id: &&str| checks.iter().find(|check| check.id == **id);
        CHECKS.iter().filter_map(check).map(Self::of).collect()
    }

    fn of(check: &Check) -> Self {
        let right = match &check.demand {
            Demand::Yield(output) => Some(output.clone()),
            _ => None,
        };
        // Every op can be written as JSON: it has string keys only.
        let request = serde_json::to_string(&check.op).unwrap_or_default();
        Self { op: check.op.clone(), request, right }
    }

    /// `decode on dynamixel2`.
    pub(super) fn name(&self) -> String {
        let wire = self.op.wire().map_or("", |wire| wire.id());
        let fast = matches!(&self.op, Op::Decode { fast: Some(_), .. });
        format!(
            "{}{} on {wire}",
            self.op.name(),
            if fast { " of a fast status packet" } else { "" }
        )
    }

    /// Whether the adapter says that it answers it.
    pub(super) fn is_offered(&self, hello: &Hello) -> bool {
        let has = |names: &[String], name| names.iter().any(|offered| offered == name);
        let wire = self.op.wire().is_some_and(|wire| has(&hello.wires, wire.id()));
        wire && has(&hello.ops, self.op.name())
    }

    /// A remark on an answer that has the form that it must have.
    pub(super) fn remark(&self, answer: &Answer) -> Result<String, Problem> {
        Ok(match answer {
            Answer::Skip(reason) => format!("skipped: {reason}"),
            Answer::Err(rejection) => {
                format!("rejected ({}: {}), but is valid", rejection.class, rejection.detail)
            }
            Answer::Ok(ok) => {
                let output = shape::output(&self.op, ok).map_err(|problem| self.shown(problem))?;
                if self.right.as_ref().is_some_and(|right| *right != output) {
                    "another answer than the document has: is it the adapter or the library?".into()
                } else {
                    String::new()
                }
            }
        })
    }

    /// A problem with the form of an answer, with the right one as an example.
    fn shown(&self, problem: Problem) -> Problem {
        let Some(right) = self.right.as_ref().and_then(|right| serde_json::to_string(right).ok())
        else {
            return problem;
        };
        Problem { mend: format!("{}; here it is {right}", problem.mend), ..problem }
    }

    /// The request with a field more.
    pub(super) fn with_another_field(&self) -> String {
        let fields = self.request.strip_suffix('}').unwrap_or(&self.request);
        format!("{fields},\"no-such-field\":[1]}}")
    }

    /// The request once without each of its fields, but the op and the wire; and without the call,
    /// which not every packet has.
    pub(super) fn lacking_fields(&self) -> Vec<String> {
        let Ok(Value::Object(request)) = serde_json::from_str(&self.request) else {
            return Vec::new();
        };
        let lacking = |name: &String| {
            let mut request = request.clone();
            request.remove(name);
            Value::Object(request).to_string()
        };
        let names = request.keys().filter(|name| !matches!(name.as_str(), "op" | "wire"));
        names.map(lacking).chain(self.without_call()).collect()
    }

    fn without_call(&self) -> Option<String> {
        let mut op = self.op.clone();
        match &mut op {
            Op::Encode { packet, .. } => packet.call.take()?,
            _ => return None,
        };
        serde_json::to_string(&op).ok()
    }

    /// The request with its bytes cut short, where they are a frame.
    pub(super) fn cut_short(&self) -> Option<String> {
        let mut op = self.op.clone();
        let bytes = match &mut op {
            Op::Decode { bytes, .. } => bytes,
            Op::Stream { chunks, .. } => chunks.last_mut()?,
            _ => return None,
        };
        bytes.0.truncate(bytes.len().saturating_sub(3));
        serde_json::to_string(&op).ok()
    }
}
