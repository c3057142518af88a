//! One question to a subject, and the verdict on its answer.

use actucheck_spec::model::{Citation, Fault, Level};
use actucheck_spec::wire::Number;
use serde::{Deserialize, Serialize};

use super::due::{self, Due};
use super::wanted::{self, Wanted};
use crate::adapter::{Output, Question, Rejection};
use crate::legible::{LONGEST_TEXT, legible};
use crate::subject::Answer;
use crate::verdict::{Behaviour, Outcome, Verdict};

/// Why a check failed if expected and actual answer say it all.
pub const DIFFERS: &str = "the answer differs";

/// One question to a subject, and what its answer must be.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Check {
    /// Permanent id.
    pub id: String,
    /// The id of the requirement that it tests.
    pub requirement: String,
    /// The level of that requirement.
    pub level: Level,
    /// The source of the packet in the question.
    pub source: Citation,
    /// An earlier check of the same group. If the subject skips that check, this one is skipped too:
    /// a host's library that reads no instruction packets finds none in a stream. If that check
    /// fails, it is the cause of a failure of this one.
    #[serde(default, alias = "presumes", skip_serializing_if = "Option::is_none")]
    pub requires: Option<String>,
    /// What is asked.
    #[serde(rename = "request")]
    pub question: Question,
    /// What the answer must be.
    #[serde(with = "serde_yaml::with::singleton_map_recursive")]
    pub demand: Demand,
}

/// What the answer to a question must be.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Demand {
    /// Exactly this output.
    Yield(Output),
    /// This output, in which a number may be less than `within` away.
    Near {
        /// The output.
        output: Output,
        /// The tolerance.
        within: Number,
    },
    /// One of these outputs.
    YieldOneOf(Vec<Output>),
    /// A rejection. A rejection for another reason gets a warning, one without a reason does not.
    Reject(Fault),
    /// The last call of a conversation puts its packet on the line, and nothing else.
    Send,
    /// The last call of a conversation does not put its packet on the line.
    Withhold,
    /// What the last call of a conversation returns.
    Return(Due),
    /// What a device answers, step by step. Steps at the end that are not here may have any answer.
    Answer(Vec<Wanted>),
    /// Any answer: the documents leave it unspecified. The report shows what the subject does.
    Record(Unspecified),
}

/// A question that the documents leave unspecified.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Unspecified {
    /// The question, in words.
    pub question: String,
    /// The foreseen behaviours beside a rejection; the reference model's own is the first.
    pub ways: Vec<Way>,
}

/// One of several right behaviours.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Way {
    /// The behaviour in a few words.
    pub name: String,
    /// The output of this behaviour.
    pub output: Output,
}

impl Demand {
    /// Any answer to a question that the documents leave unspecified, with the foreseen behaviours.
    pub(crate) fn record(
        question: &str,
        ways: impl IntoIterator<Item = (&'static str, Output)>,
    ) -> Self {
        let ways = ways.into_iter().map(|(name, output)| Way { name: name.to_owned(), output });
        Self::Record(Unspecified { question: question.to_owned(), ways: ways.collect() })
    }
}

impl Unspecified {
    /// The behaviour in a few words; `None` if the subject failed or was not asked.
    fn behaviour(&self, question: &Question, answer: &Answer) -> Option<Behaviour> {
        let answer = match answer {
            Answer::Ok(Output::Line(steps)) => wanted::behaviour(question, steps),
            Answer::Ok(output) => match self.ways.iter().find(|way| way.output == *output) {
                Some(way) => way.name.clone(),
                None => self.other(output),
            },
            Answer::Rejected(Rejection { class: Fault::Unspecified, .. }) => {
                "rejects it".to_owned()
            }
            Answer::Rejected(Rejection { class, .. }) if *class != Fault::Internal => {
                format!("rejects it ({class})")
            }
            _ => return None,
        };
        Some(Behaviour { question: self.question.clone(), answer })
    }

    /// An answer that is none of the foreseen ones.
    fn other(&self, output: &Output) -> String {
        if let Output::Conversation(steps) = output {
            let last = steps.last().map(|step| format!("returns {}", step.returned));
            return last.unwrap_or_default();
        }
        match (output, self.ways.first().map(|way| &way.output)) {
            (Output::Packets(found), Some(Output::Packets(whole)))
                if found.iter().all(|packet| whole.contains(packet)) =>
            {
                format!("finds {} of {} packets", found.len(), whole.len())
            }
            (Output::Packets(_), _) => "finds other packets".to_owned(),
            _ => "answers something else".to_owned(),
        }
    }
}

impl Check {
    /// Whether an answer is what the check demands.
    #[must_use]
    pub fn is_met(&self, answer: &Answer) -> bool {
        self.clone().judge(answer.clone()).verdict == Verdict::Pass
    }

    /// The outcome of an answer.
    #[must_use]
    pub fn judge(self, answer: Answer) -> Outcome {
        let broken = matches!(&answer, Answer::Rejected(why) if why.class == Fault::Internal);
        let recorded = match &self.demand {
            Demand::Record(unspecified) => unspecified.behaviour(&self.question, &answer),
            _ => None,
        };
        let (verdict, detail, actual) = match answer {
            _ if recorded.is_some() => (Verdict::Recorded, String::new(), None),
            Answer::Ok(actual) => self.judge_output(actual),
            Answer::Rejected(rejection) => self.judge_rejection(&rejection),
            Answer::Skipped(reason) => (Verdict::Skip, reason, None),
            Answer::TimedOut(detail) => (Verdict::Timeout, detail, None),
            Answer::Crashed(detail) => (Verdict::Crash, detail, None),
            Answer::Faulty(detail) => (Verdict::AdapterFault, detail, None),
            Answer::NotAsked(reason) => (Verdict::NotRun, reason, None),
        };
        let allowed = match (verdict, self.level) {
            (Verdict::Pass | Verdict::Warn, Level::May) => Some("does so"),
            (Verdict::Fail, Level::May) if !broken => Some("does not"),
            _ => None,
        };
        let behaviour = recorded.or_else(|| allowed.map(|answer| self.allowed(answer)));
        let verdict = match verdict {
            _ if behaviour.is_some() => Verdict::Recorded,
            Verdict::Fail if self.level == Level::Should && !broken => Verdict::Warn,
            verdict => verdict,
        };
        let unmet = !matches!(verdict, Verdict::Pass | Verdict::Recorded | Verdict::Skip);
        let kept = actual.filter(|_| unmet).map(|actual| actual.kept(self.expected()));
        let (actual, missing) = kept.unwrap_or_default();
        let detail = match missing.as_str() {
            _ if behaviour.is_some() => String::new(),
            "" => legible(&detail, LONGEST_TEXT),
            missing => format!("{detail}; {missing}"),
        };
        Outcome {
            expected: self.expected().filter(|_| unmet).cloned(),
            id: self.id,
            requirement: self.requirement,
            level: self.level,
            verdict,
            detail,
            because: None,
            reason: None,
            request: unmet.then_some(self.question),
            actual,
            behaviour,
            after: None,
            log: None,
            number: None,
        }
    }

    /// The behaviour where a requirement allows something and demands nothing.
    fn allowed(&self, answer: &str) -> Behaviour {
        let question = format!("Does it do what {} allows?", self.requirement);
        Behaviour { question, answer: answer.to_owned() }
    }

    /// Whether no answer is judged: the documents leave it unspecified, or allow either way.
    #[must_use]
    pub fn only_records(&self) -> bool {
        self.level == Level::May || matches!(self.demand, Demand::Record(_))
    }

    /// Size in bytes of the longest packet in the question, if that is more than `limit`.
    #[must_use]
    pub fn packet_over(&self, limit: usize) -> Option<usize> {
        // A check of the limit itself.
        if matches!(self.demand, Demand::Reject(Fault::Oversize)) {
            return None;
        }
        let size = match (&self.question, self.expected()) {
            (Question::Decode { bytes, .. }, _)
            | (Question::Encode { .. }, Some(Output::Bytes(bytes))) => bytes.len(),
            (Question::Converse { wire, steps }, _) => {
                let frames = steps.iter().filter_map(|step| wire.encode(&step.packet.packet));
                frames.map(|frame| frame.len()).max()?
            }
            (Question::Stream { wire, chunks, .. }, Some(Output::Packets(packets))) => {
                let all: usize = chunks.iter().map(|chunk| chunk.len()).sum();
                if all <= limit {
                    return None;
                }
                let frames = packets.iter().filter_map(|packet| wire.encode(packet));
                frames.map(|frame| frame.len()).max()?
            }
            _ => return None,
        };
        (size > limit).then_some(size)
    }

    pub(crate) fn expected(&self) -> Option<&Output> {
        match &self.demand {
            Demand::Yield(output) | Demand::Near { output, .. } => Some(output),
            Demand::YieldOneOf(outputs) => outputs.first(),
            Demand::Record(unspecified) => unspecified.ways.first().map(|way| &way.output),
            Demand::Reject(_)
            | Demand::Send
            | Demand::Withhold
            | Demand::Return(_)
            | Demand::Answer(_) => None,
        }
    }

    fn judge_output(&self, actual: Output) -> (Verdict, String, Option<Output>) {
        if let Output::Conversation(courses) = &actual {
            let (verdict, detail) = due::judge(&self.question, &self.demand, courses);
            return (verdict, detail, Some(actual));
        }
        if let (Output::Line(heard), Demand::Answer(wanted)) = (&actual, &self.demand) {
            let (verdict, detail) = wanted::judge(&self.question, wanted, heard);
            return (verdict, detail, Some(actual));
        }
        let right = match &self.demand {
            Demand::Yield(expected) => *expected == actual,
            Demand::Near { output, within } => output.is_near(&actual, *within),
            Demand::YieldOneOf(outputs) => outputs.contains(&actual),
            _ => false,
        };
        match &self.demand {
            _ if right => (Verdict::Pass, String::new(), None),
            Demand::Reject(fault) => {
                let detail = format!("accepted, but must be rejected ({fault})");
                (Verdict::Fail, detail, Some(actual))
            }
            _ => (Verdict::Fail, DIFFERS.to_owned(), Some(actual)),
        }
    }

    fn judge_rejection(&self, rejection: &Rejection) -> (Verdict, String, Option<Output>) {
        let Rejection { class, detail } = rejection;
        if *class == Fault::Internal {
            return (Verdict::Fail, format!("broke down: {detail}"), None);
        }
        match &self.demand {
            Demand::Reject(fault) if fault == class || *class == Fault::Unspecified => {
                (Verdict::Pass, String::new(), None)
            }
            Demand::Reject(fault) => {
                (Verdict::Warn, format!("rejected as {class}, the fault is {fault}"), None)
            }
            _ => (Verdict::Fail, format!("rejected ({class}: {detail}), but is valid"), None),
        }
    }
}
