//! Charges a failure to the check that it follows from.
//!
//! A fault of a library shows in many checks. A check rests on the basic checks of what its packets
//! have, and may require an earlier check of its group. If one of these failed, the failure says no
//! more than that one did, and is charged to it. Outcomes come in the order of the plan, which
//! begins with the basic checks, so that their failures are known by then.

use std::collections::{HashMap, HashSet};

use crate::suite::{basics, rests_on};
use crate::verdict::{Because, Outcome, Verdict};

/// The failures that later ones may follow from.
#[derive(Debug, Default)]
pub(super) struct Blame {
    /// Those of basic checks, by their ids.
    basic: HashMap<String, Failure>,
    /// The cause of each check of the current batch that has one, by the check's id.
    charged: HashMap<String, Because>,
    /// The checks of the current batch whose failure is no fact, so that nothing follows from it.
    flaky: HashSet<String>,
}

#[derive(Debug)]
struct Failure {
    verdict: Verdict,
    /// The check itself, or the one that it follows from.
    cause: Because,
}

impl Blame {
    /// Names the cause of a failure, if it is an earlier one. The check that it requires is set by
    /// the worker that asked both.
    pub(super) fn charge(&mut self, outcome: &mut Outcome) {
        if outcome.verdict.is_fine() {
            return;
        }
        if outcome.verdict == Verdict::Flaky {
            outcome.because = None;
            self.flaky.insert(outcome.id.clone());
            return;
        }
        outcome.because.take_if(|cause| self.flaky.contains(&cause.check));
        if let Some(cause) = self.cause(outcome) {
            self.charged.insert(outcome.id.clone(), cause.clone());
            outcome.because = Some(cause);
        }
        if basics::is_basic(&outcome.id) {
            let failure = Failure { verdict: outcome.verdict, cause: outcome.cause() };
            self.basic.insert(outcome.id.clone(), failure);
        }
    }

    /// Forgets the checks of a batch: no later check requires one of them.
    pub(super) fn end_batch(&mut self) {
        self.charged.clear();
        self.flaky.clear();
    }

    /// The most basic failure that the outcome follows from.
    fn cause(&self, outcome: &Outcome) -> Option<Because> {
        let basic = || {
            let request = outcome.request.as_ref().filter(|_| !self.basic.is_empty())?;
            let mut failures = rests_on(request, outcome.expected.as_ref())
                .filter_map(|id| self.basic.get(id.as_ref()))
                .filter(|failure| failure.verdict.explains(outcome.verdict));
            failures.next().map(|failure| failure.cause.clone())
        };
        let required = || {
            let required = outcome.because.as_ref()?;
            Some(self.charged.get(&required.check).unwrap_or(required).clone())
        };
        basic().or_else(required)
    }
}
