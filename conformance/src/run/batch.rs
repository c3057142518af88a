//! A batch: checks that a worker takes together, and what became of each.

use std::collections::HashMap;
use std::num::NonZeroU32;
use std::sync::Arc;

use super::merge::Judged;
use super::repeat::Repeated;
use crate::suite::check::Check;
use crate::verdict::{Because, Outcome, Verdict};

/// Checks that were taken together.
pub(super) struct Batch {
    pub(super) number: u64,
    /// The place of its first check.
    pub(super) first: usize,
    pub(super) slots: Vec<Slot>,
    /// How many outcomes were returned.
    pub(super) given: usize,
}

/// A check of a batch.
pub(super) struct Slot {
    pub(super) state: State,
    /// The place in the batch of the check that it requires.
    pub(super) requires: Option<usize>,
    /// The adapter does not offer it, so it says nothing about the checks that require it.
    pub(super) not_offered: bool,
}

/// How far a check is.
pub(super) enum State {
    Open(Arc<Check>, Repeated),
    Answered(Box<Judged>),
    Given(Past),
}

/// What of an outcome matters to the checks that require it.
pub(super) enum Past {
    /// The subject skipped it.
    Skipped,
    Failed(Verdict, Because),
    Other,
}

pub(super) const REQUIRED_SKIPPED: &str = "the check that it requires is skipped too";

impl Slot {
    /// Whether the subject skipped it, as far as is known.
    pub(super) const fn is_skipped(&self) -> bool {
        match &self.state {
            State::Open(..) => false,
            State::Answered(judged) => {
                matches!(judged.outcome.verdict, Verdict::Skip) && !self.not_offered
            }
            State::Given(past) => matches!(past, Past::Skipped),
        }
    }
}

impl Past {
    fn of(outcome: &Outcome, not_offered: bool) -> Self {
        match outcome.verdict {
            Verdict::Skip if !not_offered => Self::Skipped,
            verdict if verdict.is_fine() => Self::Other,
            verdict => Self::Failed(verdict, outcome.cause()),
        }
    }
}

impl Batch {
    /// The checks of some groups, each of which is asked so many `times`. `first` is the place of the
    /// first of them.
    pub(super) fn new(
        number: u64,
        first: usize,
        groups: impl Iterator<Item = Vec<Check>>,
        times: NonZeroU32,
    ) -> Self {
        let mut slots = Vec::new();
        for checks in groups {
            let required = required(&checks, slots.len());
            let slot = |(check, requires)| Slot {
                state: State::Open(Arc::new(check), Repeated::new(times)),
                requires,
                not_offered: false,
            };
            slots.extend(checks.into_iter().zip(required).map(slot));
        }
        Self { number, first, slots, given: 0 }
    }

    /// Removes the outcomes that have no unanswered question before them.
    pub(super) fn take(&mut self) -> Vec<Judged> {
        let mut outcomes = Vec::new();
        while let Some((earlier, [slot, ..])) = self.slots.split_at_mut_checked(self.given)
            && matches!(slot.state, State::Answered(_))
        {
            let other = State::Given(Past::Other);
            if let State::Answered(mut judged) = std::mem::replace(&mut slot.state, other) {
                let required = slot.requires.and_then(|place| earlier.get(place));
                if let Some(Slot { state: State::Given(past), .. }) = required {
                    follow(&mut judged, past);
                }
                slot.state = State::Given(Past::of(&judged.outcome, slot.not_offered));
                outcomes.push(*judged);
            }
            self.given += 1;
        }
        outcomes
    }
}

/// Lets an outcome follow from that of the check that it requires. While that one was outstanding,
/// this one was asked although the subject does not do such things.
fn follow(judged: &mut Judged, required: &Past) {
    let outcome = &mut judged.outcome;
    match required {
        Past::Skipped if outcome.verdict != Verdict::Skip => {
            let Outcome { id, requirement, level, .. } = outcome;
            *outcome = Outcome {
                id: std::mem::take(id),
                requirement: std::mem::take(requirement),
                level: *level,
                verdict: Verdict::Skip,
                detail: REQUIRED_SKIPPED.to_owned(),
                because: None,
                reason: None,
                request: None,
                expected: None,
                actual: None,
                behaviour: None,
                after: None,
                log: None,
                number: None,
            };
            judged.doubt = None;
        }
        Past::Failed(verdict, cause) if verdict.explains(outcome.verdict) => {
            outcome.because = Some(cause.clone());
        }
        _ => {}
    }
}

/// For each check of a group, the place in the batch of the check that it requires, if that comes
/// before it. `first` is the place of the first check.
fn required(checks: &[Check], first: usize) -> Vec<Option<usize>> {
    let mut places = HashMap::new();
    let requires = checks.iter().any(|check| check.requires.is_some());
    let place = |(place, check): (usize, &'_ Check)| {
        let earlier = check.requires.as_ref().and_then(|id| places.get(id.as_str()).copied());
        if requires {
            places.insert(check.id.clone(), first + place);
        }
        earlier
    };
    checks.iter().enumerate().map(place).collect()
}
