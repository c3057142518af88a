//! What an adapter was asked about and skips, so that it is asked no more.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::adapter::{Hello, Question};
use crate::legible::{LONGEST_TEXT, legible};

/// After so many skips, and no other answer, a topic is closed.
const SKIPS: u32 = 5;

/// What a question is about: the op, and the kind of packet.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Topic {
    /// The op.
    pub op: &'static str,
    /// The kind of packet in words; empty for an op without packets.
    pub packet: String,
}

impl fmt::Display for Topic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.op)?;
        if self.packet.is_empty() { Ok(()) } else { write!(f, " {}", self.packet) }
    }
}

/// The topics that are not asked any more, by the reason, which can be printed as it is.
pub type NotAsked = BTreeMap<String, BTreeSet<Topic>>;

/// The topics of a run.
#[derive(Debug, Default)]
pub(super) struct Topics {
    /// How often each topic was skipped; `None` once it was answered.
    skips: BTreeMap<Topic, Option<u32>>,
    closed: BTreeSet<Topic>,
    not_asked: NotAsked,
}

impl Topics {
    /// Whether questions about these topics are asked.
    pub(super) fn are_open(&self, topics: &[Topic]) -> bool {
        !topics.iter().any(|topic| self.closed.contains(topic))
    }

    /// Whether a question about these topics is for a role of the adapter; otherwise they are closed.
    pub(super) fn are_for(&mut self, topics: &[Topic], question: &Question, hello: &Hello) -> bool {
        if let Some(role) = question.role()
            && !hello.roles.contains(&role)
        {
            let reason = format!("only a {role} does this, and the adapter plays no {role}");
            for topic in topics {
                self.close(topic, reason.clone());
            }
            return false;
        }
        true
    }

    /// Takes note of an answer: the reason if the question was skipped.
    pub(super) fn note(&mut self, topics: &[Topic], skipped: Option<&str>) {
        let Some(reason) = skipped else {
            self.skips.extend(topics.iter().map(|topic| (topic.clone(), None)));
            return;
        };
        // Of several it is unknown which one it is.
        let [topic] = topics else { return };
        let skips = self.skips.entry(topic.clone()).or_insert(Some(0));
        if let Some(count) = skips {
            *count += 1;
            if *count >= SKIPS {
                let reason = if reason.is_empty() { "skipped without a reason" } else { reason };
                self.close(topic, legible(reason, LONGEST_TEXT));
            }
        }
    }

    fn close(&mut self, topic: &Topic, reason: String) {
        if self.closed.insert(topic.clone()) {
            self.not_asked.entry(reason).or_default().insert(topic.clone());
        }
    }

    /// What is not asked any more.
    pub(super) fn not_asked(self) -> NotAsked {
        self.not_asked
    }
}
