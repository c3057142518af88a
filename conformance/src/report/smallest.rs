//! What a report keeps of the checks that did not pass: the smallest few.

use super::model::{CheckResult, NotPassed};
use crate::verdict::{Outcome, Verdict};

/// How many checks of a requirement are kept that came out alike. What is kept of a check
/// is bounded too, in [`super::result`], so that a report's size does not depend on how much fails.
const KEPT: usize = 5;

/// How many checks came out alike, and the smallest of them. Outcomes come in the order of the plan,
/// so of two that are as small the first is kept.
#[derive(Debug, Default)]
pub(super) struct Smallest {
    count: usize,
    kept: Vec<(usize, CheckResult)>,
}

impl Smallest {
    /// Counts an outcome, and keeps what `result` makes of it if it is one of the smallest.
    pub(super) fn add(&mut self, outcome: Outcome, result: impl FnOnce(Outcome) -> CheckResult) {
        self.count += 1;
        let size = outcome.request.as_ref().map_or(0, |request| request.to_string().len());
        let at = self.kept.partition_point(|(other, _)| *other <= size);
        if at < KEPT {
            self.kept.insert(at, (size, result(outcome)));
            self.kept.truncate(KEPT);
        }
    }

    /// Counts so many more of which nothing is kept.
    pub(super) const fn add_more(&mut self, count: usize) {
        self.count += count;
    }

    /// What a report says of them, as of checks of this requirement with this verdict.
    pub(super) fn finish(self, requirement: String, verdict: Verdict) -> NotPassed {
        let smallest = self.kept.into_iter().map(|(_, result)| result).collect();
        NotPassed { requirement, verdict, count: self.count, smallest }
    }
}
