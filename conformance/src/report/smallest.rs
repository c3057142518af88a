//! Keeps the smallest few of the checks that did not pass.

use std::collections::BTreeMap;

use super::model::{CheckResult, NotPassed};
use crate::verdict::{Outcome, Verdict};

/// The maximum number of checks that are kept per requirement and verdict. The size of each is
/// limited too, in [`super::result`], so that the size of a report does not depend on the number of
/// failures.
const KEPT: usize = 5;

/// The number of checks of a requirement with one verdict, and the smallest of them, those first
/// of which it is known what brings them about. Outcomes
/// arrive in the order of the plan, and of two equally small ones the first is kept.
#[derive(Debug, Default)]
pub(super) struct Smallest {
    count: usize,
    following: BTreeMap<String, usize>,
    kept: Vec<((bool, bool, usize), CheckResult)>,
}

impl Smallest {
    /// Counts an outcome, and keeps its `result` if it is one of the smallest.
    pub(super) fn add(&mut self, outcome: Outcome, result: impl FnOnce(Outcome) -> CheckResult) {
        let follows = outcome.follows();
        self.count += 1;
        if let Some(cause) = outcome.because.as_ref().filter(|_| follows) {
            *self.following.entry(cause.requirement.clone()).or_default() += 1;
        }
        let size = outcome.request.as_ref().map_or(0, |request| request.to_string().len());
        let vague = outcome.verdict == Verdict::Flaky && outcome.after.is_none();
        let rank = (follows, vague, size);
        let at = self.kept.partition_point(|(other, _)| *other <= rank);
        if at < KEPT {
            self.kept.insert(at, (rank, result(outcome)));
            self.kept.truncate(KEPT);
        }
    }

    /// Counts more outcomes without keeping any.
    pub(super) const fn add_more(&mut self, count: usize) {
        self.count += count;
    }

    /// The part of a report about them.
    pub(super) fn finish(self, requirement: String, verdict: Verdict) -> NotPassed {
        let Self { count, following, kept } = self;
        let smallest = kept.into_iter().map(|(_, result)| result).collect();
        NotPassed { requirement, verdict, count, following, smallest }
    }
}
