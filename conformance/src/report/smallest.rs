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
    kept: Vec<(Rank, CheckResult)>,
}

/// Whether it follows from others, whether nothing is known that brings it about, the size of its
/// request, and its number in the whole run if that is known.
type Rank = (bool, bool, usize, Option<usize>);

impl Smallest {
    /// Counts an outcome, and keeps its `result` if it is one of the smallest.
    pub(super) fn add(&mut self, outcome: Outcome, result: impl FnOnce(Outcome) -> CheckResult) {
        self.count += 1;
        if let Some(cause) = outcome.because.as_ref().filter(|_| outcome.follows()) {
            *self.following.entry(cause.requirement.clone()).or_default() += 1;
        }
        let size = outcome.request.as_ref().map_or(0, |request| request.to_string().len());
        let number = outcome.number;
        self.keep(rank(&outcome, size), || {
            let size = number.map(|_| size);
            CheckResult { size, ..result(outcome) }
        });
    }

    /// Adds those of another part of the run.
    pub(super) fn join(&mut self, part: NotPassed) {
        let NotPassed { count, following, smallest, .. } = part;
        self.add_more(count);
        for (requirement, count) in following {
            let following = self.following.entry(requirement).or_default();
            *following = following.saturating_add(count);
        }
        for result in smallest {
            let rank = rank(&result.outcome, result.size.unwrap_or_default());
            self.keep(rank, || result);
        }
    }

    fn keep(&mut self, rank: Rank, result: impl FnOnce() -> CheckResult) {
        let at = self.kept.partition_point(|(other, _)| *other <= rank);
        if at < KEPT {
            self.kept.insert(at, (rank, result()));
            self.kept.truncate(KEPT);
        }
    }

    /// Counts more outcomes without keeping any.
    pub(super) const fn add_more(&mut self, count: usize) {
        self.count = self.count.saturating_add(count);
    }

    /// The part of a report about them.
    pub(super) fn finish(self, requirement: String, verdict: Verdict) -> NotPassed {
        let Self { count, following, kept } = self;
        let smallest = kept.into_iter().map(|(_, result)| result).collect();
        NotPassed { requirement, verdict, count, following, smallest }
    }
}

fn rank(outcome: &Outcome, size: usize) -> Rank {
    let vague = outcome.verdict == Verdict::Flaky && outcome.after.is_none();
    (outcome.follows(), vague, size, outcome.number)
}
