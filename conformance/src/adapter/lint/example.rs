//! Questions that any library behind an adapter has an answer to.

use serde_json::Value;

use super::talk::Answer;
use super::{Problem, shape};
use crate::adapter::{Hello, Op, Output, Rejection};
use crate::suite::check::{Check, Demand};
use crate::suite::plan::Plan;

/// The checks whose questions are asked, and what they ask for. An op and wire is there at least
/// once, and what only one side of a line does for itself.
const CHECKS: [(&str, &str); 14] = [
    ("dynamixel2.write.instruction/crc", "crc on dynamixel2"),
    ("dynamixel2.stuffing.data/stuff", "stuff on dynamixel2"),
    ("dynamixel2.stuffing.data/unstuff", "unstuff on dynamixel2"),
    ("dynamixel2.write.instruction/encode", "encode of an instruction packet"),
    ("dynamixel2.read.status/encode", "encode of a status packet"),
    ("dynamixel2.write.instruction/decode", "decode of an instruction packet"),
    ("dynamixel2.read.status/decode", "decode of a status packet"),
    ("ja40.fast-sync-read.status/decode", "decode of a fast status packet"),
    ("dynamixel2.read.status/stream", "stream on dynamixel2"),
    ("innfos.iq.sixty-revolutions/crc", "crc on innfos"),
    ("innfos.iq.sixty-revolutions/encode", "encode of a request"),
    ("innfos.iq.sixty-revolutions/decode", "decode of a request"),
    ("innfos.reply.command.06/decode", "decode of a reply"),
    ("innfos.request.command.06/stream-twice", "stream on innfos"),
];

/// A question of the documents, as it goes to the adapter.
#[derive(Clone, Debug)]
pub(super) struct Example {
    /// What it asks for.
    pub(super) name: &'static str,
    op: Op,
    pub(super) request: String,
    /// The answers that are right.
    right: Vec<Output>,
}

impl Example {
    /// The questions, taken out of the plans of all wires.
    pub(super) fn all(plans: &[Plan<'_>]) -> Vec<Self> {
        let example = |(id, name): &(&str, &'static str)| {
            let check = plans.iter().find_map(|plan| plan.find(id))?;
            Some(Self::of(&check, name))
        };
        CHECKS.iter().filter_map(example).collect()
    }

    fn of(check: &Check, name: &'static str) -> Self {
        let right = match &check.demand {
            Demand::Yield(output) => vec![output.clone()],
            Demand::YieldOneOf(outputs) => outputs.clone(),
            Demand::Reject(_) | Demand::Record(_) => Vec::new(),
        };
        // Every op can be written as JSON: it has string keys only.
        let request = serde_json::to_string(&check.op).unwrap_or_default();
        Self { name, op: check.op.clone(), request, right }
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
                let Rejection { class, detail } = rejection;
                format!(
                    "rejected as {class} ({detail}) though valid; `skip` what the library can't do"
                )
            }
            Answer::Ok(ok) => {
                let output = shape::output(&self.op, ok).map_err(|problem| self.shown(problem))?;
                if self.right.contains(&output) {
                    String::new()
                } else {
                    "another answer than the document has: is it the adapter or the library?".into()
                }
            }
        })
    }

    /// A problem with the form of an answer, with the right one as an example.
    fn shown(&self, problem: Problem) -> Problem {
        let right = self.right.first().and_then(|right| serde_json::to_string(right).ok());
        let Some(right) = right else { return problem };
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

#[cfg(test)]
mod tests {
    use actucheck_spec::Spec;

    use super::*;
    use crate::adapter::Wire;
    use crate::suite::{self, Options};

    #[test]
    fn every_question_is_there_with_its_right_answer() {
        let spec = Spec::embedded().unwrap();
        let plans = Wire::ALL.map(|wire| suite::plan(&spec, &Options::new(wire)));
        let examples = Example::all(&plans);
        assert_eq!(examples.len(), CHECKS.len());
        for example in examples {
            assert!(!example.right.is_empty(), "{}", example.name);
        }
    }
}
