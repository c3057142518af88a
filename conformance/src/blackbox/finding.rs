//! What was found, and what makes one failure another kind than the next.

use std::fmt;

use actucheck_spec::model::{Fault, Packet};

use crate::adapter::Output;
use crate::subject::Answer;
use crate::suite::check::{Check, Demand};
use crate::verdict::{Outcome, Verdict};

/// A kind of failure, shrunk to a small case of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What kind.
    pub kind: Kind,
    /// The smallest question that fails so.
    pub check: Check,
    /// What came of it.
    pub outcome: Outcome,
    /// How many probes failed so.
    pub times: u64,
}

/// What failures of one cause are likely to share.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Kind {
    /// The op that was asked.
    pub op: &'static str,
    /// The requirement that was broken.
    pub requirement: String,
    /// How.
    pub symptom: Symptom,
}

/// In what way an answer is wrong.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Symptom {
    /// It is another one, first of all in this.
    Differs(&'static str),
    /// It should have been a rejection for this reason.
    Accepted(String),
    /// Something valid is rejected for this reason.
    Rejected(String),
    /// The implementation broke down.
    BrokeDown,
    /// There was none in time.
    TimedOut,
    /// The adapter ended.
    Crashed,
    /// It is none of the adapter protocol.
    Faulty,
}

impl Kind {
    /// Whether each failure of this kind takes a new start of the adapter.
    pub(super) fn is_slow(&self) -> bool {
        matches!(self.symptom, Symptom::TimedOut | Symptom::Crashed | Symptom::Faulty)
    }
}

impl fmt::Display for Symptom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Differs(what) => write!(f, "wrong {what}"),
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
    /// The failure that an answer is, if it is one. A rejection for another reason than the right
    /// one is none.
    pub(super) fn of(check: &Check, answer: Answer) -> Option<Self> {
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
            (Verdict::Fail, Some(class), _) => Symptom::Rejected(class.to_string()),
            (Verdict::Fail, None, Demand::Reject(fault)) => Symptom::Accepted(fault.to_string()),
            (Verdict::Fail, None, _) => {
                Symptom::Differs(difference(outcome.expected.as_ref(), outcome.actual.as_ref()))
            }
            _ => return None,
        };
        let requirement = check.requirement.clone();
        Some(Self { kind: Kind { op: check.op.name(), requirement, symptom }, outcome })
    }
}

/// In what two outputs differ, first of all.
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
        _ => "kind of answer",
    }
}

/// The first field in which two packets differ.
fn field(expected: &Packet, actual: &Packet) -> &'static str {
    match (expected, actual) {
        (
            Packet::Instruction { id, instruction, .. },
            Packet::Instruction { id: other_id, instruction: other, .. },
        ) => match (id == other_id, instruction == other) {
            (false, _) => "ID",
            (_, false) => "instruction",
            _ => "parameters",
        },
        (Packet::Status { id, error, .. }, Packet::Status { id: other_id, error: other, .. }) => {
            match (id == other_id, error == other) {
                (false, _) => "ID",
                (_, false) => "error",
                _ => "parameters",
            }
        }
        (
            Packet::Request { address, command, .. },
            Packet::Request { address: other_address, command: other, .. },
        )
        | (
            Packet::Reply { address, command, .. },
            Packet::Reply { address: other_address, command: other, .. },
        ) => match (address == other_address, command == other) {
            (false, _) => "address",
            (_, false) => "command",
            _ => "data",
        },
        _ => "kind of packet",
    }
}
