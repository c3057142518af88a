//! Questions that every library can answer.

use serde_json::Value;

use super::talk::Answer;
use super::{Problem, shape};
use crate::adapter::{Hello, Output, Question, Rejection, Request, VERSION};
use crate::suite::check::{Check, Demand};
use crate::suite::plan::Plan;

/// The checks whose questions are asked, each with a description. Every op of every wire occurs at
/// least once, and so does each kind of packet that only a host or only a device has to read.
const CHECKS: [(&str, &str); 20] = [
    ("dynamixel2.write.instruction/crc", "crc on dynamixel2"),
    ("dynamixel2.stuffing.data/stuff", "stuff on dynamixel2"),
    ("dynamixel2.stuffing.data/unstuff", "unstuff on dynamixel2"),
    ("dynamixel2.write.instruction/encode", "encode of an instruction packet"),
    ("dynamixel2.instruction.ee-with-params/encode", "encode of an instruction without a name"),
    ("dynamixel2.read.status/encode", "encode of a status packet"),
    ("dynamixel2.write.instruction/decode", "decode of an instruction packet"),
    ("dynamixel2.read.status/decode", "decode of a status packet"),
    ("ja40.fast-sync-read.status/decode", "decode of a fast status packet"),
    ("dynamixel2.read.status/stream", "stream on dynamixel2"),
    ("ja40.value.velocity-limit.2000/read", "value of bytes"),
    ("ja40.value.velocity-limit.2000/write", "value of a number"),
    ("innfos.iq.sixty-revolutions/crc", "crc on innfos"),
    ("innfos.iq.sixty-revolutions/encode", "encode of a request"),
    ("innfos.reply.command.06/encode", "encode of a reply"),
    ("innfos.iq.sixty-revolutions/decode", "decode of a request"),
    ("innfos.reply.command.06/decode", "decode of a reply"),
    ("innfos.request.command.06/stream", "stream on innfos"),
    ("innfos.iq.sixty-revolutions/message", "message of a request"),
    ("innfos.iq.sixty-revolutions/message-frame", "frame of a message"),
];

/// The checks whose calls an adapter with a port is asked for; the first of a wire that it offers.
const CALLS: [&str; 2] = ["dynamixel2.host.basic.read/result", "innfos.host.basic.06/result"];

/// The checks with calls.
pub(super) fn calls(plans: &[Plan<'_>]) -> Vec<Check> {
    CALLS.iter().filter_map(|id| plans.iter().find_map(|plan| plan.find(id))).collect()
}

/// A question from the suite, as it is sent to the adapter.
#[derive(Clone, Debug)]
pub(super) struct Example {
    /// A description of the question.
    pub(super) name: &'static str,
    question: Question,
    /// The version of the adapter protocol that its requests have.
    version: u32,
    pub(super) request: String,
    /// The right answers.
    right: Vec<Output>,
}

impl Example {
    /// Takes the questions from the plans of all wires.
    pub(super) fn all(plans: &[Plan<'_>]) -> Vec<Self> {
        let example = |(id, name): &(&str, &'static str)| {
            let check = plans.iter().find_map(|plan| plan.find(id))?;
            Some(Self::of(&check, name))
        };
        CHECKS.iter().filter_map(example).collect()
    }

    fn of(check: &Check, name: &'static str) -> Self {
        let right = match &check.demand {
            Demand::Yield(output) | Demand::Near { output, .. } => vec![output.clone()],
            Demand::YieldOneOf(outputs) => outputs.clone(),
            Demand::Record(open) => open.ways.iter().map(|way| way.output.clone()).collect(),
            Demand::Reject(_)
            | Demand::Send
            | Demand::Withhold
            | Demand::Return(_)
            | Demand::Answer(_) => Vec::new(),
        };
        let question = check.question.clone();
        Self { name, question, version: 0, request: String::new(), right }.in_version(VERSION)
    }

    /// The same in this version of the adapter protocol.
    pub(super) fn in_version(&self, version: u32) -> Self {
        let example = Self { version, ..self.clone() };
        Self { request: example.written(&self.question), ..example }
    }

    fn written(&self, question: &Question) -> String {
        Request::Ask(question).in_version(self.version)
    }

    /// Whether the adapter offers the question's op and wire.
    pub(super) fn is_offered(&self, hello: &Hello) -> bool {
        let has = |names: &[String], name| names.iter().any(|offered| offered == name);
        let wire = has(&hello.wires, self.question.wire().id());
        wire && has(&hello.ops, self.question.name())
    }

    /// Whether the adapter plays a role that does this.
    pub(super) fn fits_role(&self, hello: &Hello) -> bool {
        self.question.role().is_none_or(|role| hello.roles.contains(&role))
    }

    pub(super) const fn question(&self) -> &Question {
        &self.question
    }

    /// The name of the question's op.
    pub(super) fn op(&self) -> &'static str {
        self.question.name()
    }

    /// Whether an answer is a right one.
    pub(super) fn is_right(&self, answer: &Answer) -> bool {
        let Answer::Ok(ok) = answer else { return false };
        shape::output(&self.question, ok).is_ok_and(|output| self.right.contains(&output))
    }

    /// A remark on an answer whose form is right.
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
                let output =
                    shape::output(&self.question, ok).map_err(|problem| self.shown(problem))?;
                if self.right.contains(&output) {
                    String::new()
                } else {
                    "another answer than the document has: is it the adapter or the library?".into()
                }
            }
        })
    }

    /// A problem with the form of an answer, with the right answer as an example.
    pub(super) fn shown(&self, problem: Problem) -> Problem {
        let right = self.right.first().and_then(|right| serde_json::to_string(right).ok());
        let Some(right) = right else { return problem };
        Problem { mend: format!("{}; here it is {right}", problem.mend), ..problem }
    }

    /// The request with an extra field.
    pub(super) fn with_another_field(&self) -> String {
        let fields = self.request.strip_suffix('}').unwrap_or(&self.request);
        format!("{fields},\"no-such-field\":[1]}}")
    }

    /// For each field other than the op and the wire, the request without that field; and the request
    /// without the packet's call.
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
        let mut op = self.question.clone();
        match &mut op {
            Question::Encode { packet, .. } => packet.call.take()?,
            _ => return None,
        };
        Some(self.written(&op))
    }

    /// The request with its frame cut short; `None` if its bytes are not a frame.
    pub(super) fn cut_short(&self) -> Option<String> {
        let mut op = self.question.clone();
        let bytes = match &mut op {
            Question::Decode { bytes, .. } => bytes,
            Question::Stream { chunks, .. } => chunks.last_mut()?,
            _ => return None,
        };
        bytes.0.truncate(bytes.len().saturating_sub(3));
        Some(self.written(&op))
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
        let hosts = suite::host_plan(&spec, &Wire::ALL);
        let plans = [suite::plan(&spec, &Wire::ALL, &Options::new()).and(hosts)];
        assert_eq!(calls(&plans).len(), CALLS.len());
        let examples = Example::all(&plans);
        assert_eq!(examples.len(), CHECKS.len());
        for example in examples {
            assert!(!example.right.is_empty(), "{}", example.name);
        }
    }
}
