//! Findings, and how failures are grouped into kinds.

use std::fmt;

use actucheck_spec::model::Fault;
use actucheck_spec::wire::Packet;

use crate::adapter::{CallError, Course, Heard, Output, Question, Reported, Returned, Trouble};
use crate::subject::Answer;
use crate::suite::check::{Check, Demand};
use crate::suite::wanted;
use crate::verdict::{Outcome, Verdict};

/// A kind of failure, with its smallest known case.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// The kind of failure.
    pub kind: Kind,
    /// The smallest question with this failure.
    pub check: Check,
    /// What has to be asked before it on a fresh process, in this order; empty if it fails alone.
    pub before: Vec<Check>,
    /// The outcome of that question.
    pub outcome: Outcome,
    /// How many probes had this failure.
    pub times: u64,
}

impl Finding {
    /// Every check of this finding, in the order in which they are asked.
    pub fn checks(&self) -> impl Iterator<Item = &Check> {
        self.before.iter().chain([&self.check])
    }

    /// The size of its question, to compare it with others.
    pub(super) fn size(&self) -> usize {
        size(&self.check)
    }
}

/// The size of a question.
pub(super) fn size(check: &Check) -> usize {
    check.question.to_string().len()
}

/// The properties that failures with the same cause are likely to share.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Kind {
    /// The op of the question.
    pub op: &'static str,
    /// The requirement that was broken.
    pub requirement: String,
    /// How it was broken.
    pub symptom: Symptom,
}

/// How an answer is wrong.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symptom {
    /// The answer differs; this is the first difference.
    Differs(&'static str),
    /// A call of a host, or a device, did this.
    Does(&'static str),
    /// A frame with this fault was accepted.
    Accepted(String),
    /// Something valid was rejected for this reason.
    Rejected(String),
    /// The implementation broke down.
    BrokeDown,
    /// There was no answer in time.
    TimedOut,
    /// The adapter ended.
    Crashed,
    /// The answer violates the adapter protocol.
    Faulty,
}

impl Kind {
    /// Whether it is a failure of a host in a conversation.
    #[must_use]
    pub fn is_of_host(&self) -> bool {
        self.op == CALL
    }

    /// Whether it is a failure in a conversation, in which it is waited.
    pub(super) fn is_of_conversation(&self) -> bool {
        self.is_of_host() || self.op == DEVICE
    }

    /// Whether another failure may have the same cause. The requirement that a conversation is about
    /// depends on what is left of it.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let is_same = self.requirement == other.requirement || self.is_of_host();
        self.op == other.op && self.symptom == other.symptom && is_same
    }

    /// Whether the adapter has to be restarted after each failure of this kind.
    pub(super) fn is_slow(&self) -> bool {
        matches!(self.symptom, Symptom::TimedOut | Symptom::Crashed | Symptom::Faulty)
    }
}

impl fmt::Display for Symptom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Differs(what) => write!(f, "wrong {what}"),
            Self::Does(what) => f.write_str(what),
            Self::Accepted(fault) => write!(f, "accepts what is wrong ({fault})"),
            Self::Rejected(fault) => write!(f, "rejects what is right ({fault})"),
            Self::BrokeDown => f.write_str("breaks down"),
            Self::TimedOut => f.write_str("does not answer in time"),
            Self::Crashed => f.write_str("ends"),
            Self::Faulty => f.write_str("answers outside the adapter protocol"),
        }
    }
}

/// A failed question.
pub(super) struct Failure {
    pub(super) kind: Kind,
    pub(super) outcome: Outcome,
}

impl Failure {
    /// The failure, if the answer is one or breaks a recommendation. A rejection for the wrong
    /// reason is not a failure.
    pub(super) fn of(check: &Check, answer: Answer) -> Option<Self> {
        let done = match (&check.question, &answer) {
            (Question::Device { .. }, Answer::Ok(Output::Line(heard))) => answers(check, heard),
            (Question::Converse { .. }, Answer::Ok(output)) => Some(does(check, output)?),
            _ => None,
        };
        let class = match &answer {
            Answer::Rejected(rejection) => Some(rejection.class),
            _ => None,
        };
        let outcome = check.clone().judge(answer);
        let symptom = match (outcome.verdict, class, &check.demand) {
            (Verdict::Timeout, ..) => Symptom::TimedOut,
            (Verdict::Crash, ..) => Symptom::Crashed,
            (Verdict::AdapterFault, ..) => Symptom::Faulty,
            (Verdict::Fail, Some(Fault::Internal), _) => Symptom::BrokeDown,
            (Verdict::Fail | Verdict::Warn, ..) if let Some(what) = done => Symptom::Does(what),
            (Verdict::Warn, Some(_), Demand::Reject(_)) => return None,
            (Verdict::Fail | Verdict::Warn, Some(class), _) => Symptom::Rejected(class.to_string()),
            (Verdict::Fail | Verdict::Warn, None, Demand::Reject(fault)) => {
                Symptom::Accepted(fault.to_string())
            }
            (Verdict::Fail | Verdict::Warn, None, _) => {
                Symptom::Differs(difference(outcome.expected.as_ref(), outcome.actual.as_ref()))
            }
            _ => return None,
        };
        let requirement = check.requirement.clone();
        Some(Self { kind: Kind { op: check.question.name(), requirement, symptom }, outcome })
    }
}

/// The op of conversations.
const CALL: &str = "call";

/// The op of conversations with devices.
const DEVICE: &str = "device";

/// What a device does wrong, if it does.
fn answers(check: &Check, heard: &[Heard]) -> Option<&'static str> {
    let Demand::Answer(wanted) = &check.demand else { return None };
    wanted::symptom(&check.question, wanted, heard)
}

/// What the last call of a conversation does wrong. `None` if it does nothing, or fails for another
/// reason than it should.
fn does(check: &Check, output: &Output) -> Option<&'static str> {
    let (Question::Converse { wire, steps }, Output::Conversation(courses)) =
        (&check.question, output)
    else {
        return None;
    };
    let (step, course) = (steps.last()?, courses.last()?);
    if refused(course).is_some() {
        return None;
    }
    let (sent, frame) = (course.sent(), wire.encode(&step.packet.packet)?);
    let is_sent = sent.windows(frame.len().max(1)).any(|part| part == frame);
    let due = match &check.demand {
        Demand::Return(due) if is_sent => due,
        // What a call does not send, it does not return; another check is about that.
        Demand::Return(_) => return None,
        _ if sent.is_empty() => return Some("sends nothing"),
        _ => return Some("sends something else"),
    };
    match (&course.returned, &due.devices) {
        (Returned::Err(_), _) => due.or.is_empty().then_some("fails where a right answer has come"),
        (Returned::Devices(_), None) => Some("succeeds where no right answer has come"),
        (Returned::Devices(found), Some(right)) => {
            let is_right = |found: &Reported| right.iter().any(|right| found.fits(right));
            Some(if found.iter().all(is_right) {
                "does not return what has come"
            } else {
                "returns what no right answer says"
            })
        }
    }
}

/// Why a host does not make the last call of a conversation, if it refuses it.
pub(super) fn refusal(answer: &Answer) -> Option<String> {
    let Answer::Ok(Output::Conversation(courses)) = answer else { return None };
    refused(courses.last()?).map(ToOwned::to_owned)
}

fn refused(course: &Course) -> Option<&str> {
    match &course.returned {
        Returned::Err(CallError { class: Trouble::Refused, detail }) => Some(detail),
        _ => None,
    }
}

/// The first difference between two outputs.
fn difference(expected: Option<&Output>, actual: Option<&Output>) -> &'static str {
    match (expected, actual) {
        (Some(Output::Bytes(expected)), Some(Output::Bytes(actual))) => {
            match expected.len().cmp(&actual.len()) {
                std::cmp::Ordering::Less => "length: bytes too many",
                std::cmp::Ordering::Greater => "length: bytes too few",
                std::cmp::Ordering::Equal => "bytes",
            }
        }
        (Some(Output::Packet(expected)), Some(Output::Packet(actual))) => field(expected, actual),
        (Some(Output::Packets(expected)), Some(Output::Packets(actual))) => {
            let mut pairs = expected.iter().zip(actual);
            match pairs.find(|(expected, actual)| expected != actual) {
                Some((expected, actual)) => field(expected, actual),
                None if expected.len() > actual.len() => "packets: some are missing",
                None => "packets: some are none",
            }
        }
        (Some(Output::Crc(_)), _) => "CRC",
        (Some(Output::Value(_)), _) => "value",
        (Some(Output::Message(_)), _) => "message",
        _ => "kind of answer",
    }
}

/// The first field in which two packets differ.
fn field(expected: &Packet, actual: &Packet) -> &'static str {
    if expected.wire() == actual.wire() {
        expected.wire().difference(expected, actual)
    } else {
        "kind of packet"
    }
}
