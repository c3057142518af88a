//! One question to an implementation, and the judgement of its answer.

use actucheck_spec::model::{Citation, Fault, Level};
use serde::{Deserialize, Serialize};

use crate::adapter::{Output, Question, Rejection};
use crate::subject::Answer;
use crate::verdict::{Behaviour, Outcome, Verdict};

/// One question to an implementation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Check {
    /// Permanent id.
    pub id: String,
    /// The id of the requirement that it tests.
    pub requirement: String,
    /// How binding that is.
    pub level: Level,
    /// Where the packet stands that it asks about.
    pub source: Citation,
    /// The check that shows whether this one makes sense: one that is skipped there is skipped
    /// here. A host's library reads no instruction packets, alone or in a stream.
    #[serde(default, alias = "presumes", skip_serializing_if = "Option::is_none")]
    pub requires: Option<String>,
    /// What is asked.
    #[serde(rename = "request")]
    pub question: Question,
    /// What is demanded.
    #[serde(with = "serde_yaml::with::singleton_map_recursive")]
    pub demand: Demand,
}

/// What a check demands of the answer.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Demand {
    /// This and nothing else.
    Yield(Output),
    /// One of these.
    YieldOneOf(Vec<Output>),
    /// A rejection. One for another reason than this is a warning.
    Reject(Fault),
    /// Nothing: the documents leave it open, and what is done is recorded.
    Record(Unspecified),
}

/// A question that the documents leave open.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Unspecified {
    /// The question, in words.
    pub question: String,
    /// What may be done beside rejecting, the way of the reference first.
    pub ways: Vec<Way>,
}

/// One of several right ways.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Way {
    /// What is done, in a few words.
    pub name: String,
    /// What comes of it.
    pub output: Output,
}

impl Unspecified {
    /// What was done, in a few words; `None` if the implementation broke down or was not asked.
    fn behaviour(&self, answer: &Answer) -> Option<Behaviour> {
        let answer = match answer {
            Answer::Ok(output) => match self.ways.iter().find(|way| way.output == *output) {
                Some(way) => way.name.clone(),
                None => self.other(output),
            },
            Answer::Rejected(Rejection { class, .. }) if *class != Fault::Internal => {
                format!("rejects it ({class})")
            }
            _ => return None,
        };
        Some(Behaviour { question: self.question.clone(), answer })
    }

    /// What none of the ways foresees.
    fn other(&self, output: &Output) -> String {
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
    /// What an answer comes to.
    #[must_use]
    pub fn judge(self, answer: Answer) -> Outcome {
        let broken = matches!(&answer, Answer::Rejected(why) if why.class == Fault::Internal);
        let open = match &self.demand {
            Demand::Record(open) => open.behaviour(&answer),
            _ => None,
        };
        let (verdict, detail, actual) = match answer {
            _ if open.is_some() => (Verdict::Recorded, String::new(), None),
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
        let behaviour = open.or_else(|| allowed.map(|answer| self.allowed(answer)));
        let verdict = match verdict {
            _ if behaviour.is_some() => Verdict::Recorded,
            Verdict::Fail if self.level == Level::Should && !broken => Verdict::Warn,
            verdict => verdict,
        };
        let unmet = !matches!(verdict, Verdict::Pass | Verdict::Recorded | Verdict::Skip);
        Outcome {
            expected: self.expected().filter(|_| unmet).cloned(),
            id: self.id,
            requirement: self.requirement,
            level: self.level,
            verdict,
            detail: if behaviour.is_some() { String::new() } else { detail },
            request: unmet.then_some(self.question),
            actual: actual.filter(|_| unmet),
            behaviour,
        }
    }

    /// What is done where the requirement allows it and demands nothing.
    fn allowed(&self, answer: &str) -> Behaviour {
        let question = format!("Does it do what {} allows?", self.requirement);
        Behaviour { question, answer: answer.to_owned() }
    }

    /// Bytes of the whole packet that it is about; `None` if it is about no whole one.
    #[must_use]
    pub fn packet_size(&self) -> Option<usize> {
        match (&self.question, self.expected()) {
            (Question::Decode { bytes, .. }, _)
            | (Question::Encode { .. }, Some(Output::Bytes(bytes))) => Some(bytes.len()),
            (Question::Stream { chunks, .. }, _) => {
                Some(chunks.iter().map(|chunk| chunk.len()).sum())
            }
            _ => None,
        }
    }

    fn expected(&self) -> Option<&Output> {
        match &self.demand {
            Demand::Yield(output) => Some(output),
            Demand::YieldOneOf(outputs) => outputs.first(),
            Demand::Record(open) => open.ways.first().map(|way| &way.output),
            Demand::Reject(_) => None,
        }
    }

    fn judge_output(&self, actual: Output) -> (Verdict, String, Option<Output>) {
        let right = match &self.demand {
            Demand::Yield(expected) => *expected == actual,
            Demand::YieldOneOf(outputs) => outputs.contains(&actual),
            Demand::Reject(_) | Demand::Record(_) => false,
        };
        match &self.demand {
            _ if right => (Verdict::Pass, String::new(), None),
            Demand::Reject(fault) => {
                let detail = format!("accepted, but must be rejected ({fault})");
                (Verdict::Fail, detail, Some(actual))
            }
            _ => (Verdict::Fail, "the answer differs".to_owned(), Some(actual)),
        }
    }

    fn judge_rejection(&self, rejection: &Rejection) -> (Verdict, String, Option<Output>) {
        let Rejection { class, detail } = rejection;
        if *class == Fault::Internal {
            return (Verdict::Fail, format!("broke down: {detail}"), None);
        }
        match &self.demand {
            Demand::Yield(_) | Demand::YieldOneOf(_) | Demand::Record(_) => {
                (Verdict::Fail, format!("rejected ({class}: {detail}), but is valid"), None)
            }
            Demand::Reject(fault) if fault == class => (Verdict::Pass, String::new(), None),
            Demand::Reject(fault) => {
                (Verdict::Warn, format!("rejected as {class}, the fault is {fault}"), None)
            }
        }
    }
}
