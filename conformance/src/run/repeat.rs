//! Answers to a question that is asked several times in a row.

use std::num::NonZeroU32;

use crate::legible::legible;
use crate::subject::Answer;
use crate::suite::check::Check;
use crate::verdict::{Outcome, Verdict};

/// The limit of an answer in a sentence, in characters.
const LONGEST_ANSWER: usize = 200;

/// The answers to one question so far.
#[derive(Debug)]
pub(super) struct Repeated {
    /// How many answers are still to come.
    left: u32,
    first: Option<Answer>,
}

/// What all answers to a question come to.
#[derive(Debug)]
pub(super) enum Heard {
    /// They are the same.
    One(Answer),
    /// The first one, and another one.
    Two(Answer, Answer),
}

impl Repeated {
    /// So many answers are to come.
    pub(super) const fn new(times: NonZeroU32) -> Self {
        Self { left: times.get(), first: None }
    }

    /// Takes an answer. Returns what the answers come to, if that is known.
    pub(super) fn hear(&mut self, answer: Answer) -> Option<Heard> {
        self.left = self.left.saturating_sub(1);
        match self.first.take() {
            Some(first) if !is_same(&first, &answer) => Some(Heard::Two(first, answer)),
            _ if self.left == 0 => Some(Heard::One(answer)),
            _ => {
                self.first = Some(answer);
                None
            }
        }
    }
}

impl Heard {
    pub(super) fn judge(self, check: Check) -> Outcome {
        match self {
            Self::One(answer) => check.judge(answer),
            Self::Two(first, second) => changed(&check, first, second),
        }
    }
}

/// Whether two answers mean the same. The words of a rejection do not matter.
fn is_same(first: &Answer, second: &Answer) -> bool {
    match (first, second) {
        (Answer::Rejected(first), Answer::Rejected(second)) => first.class == second.class,
        (Answer::Skipped(_), Answer::Skipped(_)) => true,
        _ => first == second,
    }
}

/// The outcome of a check whose answer changed.
fn changed(check: &Check, first: Answer, second: Answer) -> Outcome {
    let [before, then] = [&first, &second].map(words);
    let request = Some(check.question.clone());
    let outcomes = [first, second].map(|answer| check.clone().judge(answer));
    let [first, second] = outcomes;
    let outcome = if first.verdict.is_fine() { second } else { first };
    let detail = format!("asked in a row, it answers {before}, and then {then}");
    Outcome { verdict: Verdict::Flaky, detail, request, behaviour: None, ..outcome }
}

fn words(answer: &Answer) -> String {
    match answer {
        Answer::Ok(output) => legible(&output.to_string(), LONGEST_ANSWER),
        Answer::Rejected(rejection) => format!("with a rejection ({})", rejection.class),
        Answer::Skipped(_) => "with `skip`".to_owned(),
        Answer::TimedOut(detail)
        | Answer::Crashed(detail)
        | Answer::Faulty(detail)
        | Answer::NotAsked(detail) => legible(detail, LONGEST_ANSWER),
    }
}
