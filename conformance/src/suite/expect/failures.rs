//! The failures of a run that are not expected yet.

use std::collections::HashMap;
use std::hash::{BuildHasher, RandomState};

use actucheck_spec::Spec;
use indexmap::IndexSet;

use super::cover::{Cover, cover};
use super::file::Row;
use crate::suite::plan::Plan;
use crate::verdict::{Outcome, Verdict};

/// The failures of a run, by what they accuse. Only hashes of their ids are kept: the plan has the
/// ids.
#[derive(Debug, Default)]
pub struct Failures {
    hasher: RandomState,
    /// What is accused, and how it fails, in the order in which it first did.
    causes: IndexSet<(String, Verdict)>,
    /// The place of its cause, by the hash of a check's id.
    ids: HashMap<u64, usize>,
    /// How many more there are.
    more: usize,
}

/// How many failures are kept; more than a default run has checks.
const MOST: usize = 1 << 20;

impl Failures {
    /// Adds an outcome, if it is a failure.
    pub fn add(&mut self, outcome: &Outcome) {
        if !outcome.verdict.is_failure() {
            return;
        }
        if self.ids.len() >= MOST {
            self.more += 1;
            return;
        }
        let cause = (outcome.cause().requirement, outcome.verdict);
        let (place, _) = self.causes.insert_full(cause);
        self.ids.insert(self.hasher.hash_one(outcome.id.as_str()), place);
    }

    /// How many there are.
    #[must_use]
    pub fn count(&self) -> usize {
        self.ids.len() + self.more
    }

    /// The place of the cause of this check's failure; `None` if it did not fail.
    pub(super) fn cause(&self, id: &str) -> Option<usize> {
        self.ids.get(&self.hasher.hash_one(id)).copied()
    }

    /// Whether checks of this cause fail at times only.
    pub(super) fn is_flaky(&self, cause: usize) -> bool {
        self.causes.get_index(cause).is_some_and(|(_, verdict)| *verdict == Verdict::Flaky)
    }

    /// Whether a glob for failures of one cause may match those of another. It may if these are flaky:
    /// they may pass there, as long as the others fail. Else a slow reply would need many globs.
    pub(super) fn joins(&self, cause: usize, other: usize) -> bool {
        cause == other || self.is_flaky(cause)
    }

    /// A row for each cause, and how many failures are in none: there are too many, or the plan
    /// lacks them, as it does rules of the adapter protocol.
    pub(super) fn rows(&self, plan: &Plan<'_>, spec: &Spec) -> (Vec<Row>, usize) {
        if self.ids.is_empty() {
            return (Vec::new(), 0);
        }
        let Cover { patterns, left_out } = cover(self, plan, self.causes.len());
        let rows = self.causes.iter().zip(patterns).filter(|(_, ids)| !ids.is_empty());
        let row = |((requirement, verdict), ids): (&(String, Verdict), Vec<String>)| Row {
            ids,
            reason: reason(requirement, *verdict, spec),
            upstream: None,
            flaky: *verdict == Verdict::Flaky,
        };
        (rows.map(row).collect(), left_out)
    }
}

/// What fails, for a person to say why.
fn reason(requirement: &str, verdict: Verdict, spec: &Spec) -> String {
    let text = spec.requirement(requirement).map(|row| format!(": {}", row.text));
    let text = text.unwrap_or_default();
    let how = if verdict == Verdict::Fail { String::new() } else { format!("{verdict}, ") };
    format!("TODO: {how}{requirement}{text}")
}

#[cfg(test)]
mod tests {
    use actucheck_spec::wire::Wire;

    use super::*;
    use crate::subject::Answer;
    use crate::suite::{self, Options};

    #[test]
    fn what_fails_at_times_needs_no_more_globs() {
        let spec = Spec::embedded().unwrap();
        let options = Options { cases: 10, ..Options::new() }.with_bodies(1);
        // Few, as each is looked at often.
        let all = suite::plan(&spec, &Wire::ALL, &options);
        let plan =
            Plan::of(all.checks().filter(|it| it.id.ends_with("decode")).step_by(9).collect());
        let ids = |flaky_every: usize| {
            let mut failures = Failures::default();
            for (place, check) in plan.checks().enumerate() {
                let mut outcome = check.judge(Answer::Faulty(String::new()));
                if place % flaky_every == flaky_every / 2 {
                    outcome.verdict = Verdict::Flaky;
                }
                failures.add(&outcome);
            }
            let (rows, left_out) = failures.rows(&plan, &spec);
            assert_eq!(left_out, 0);
            rows.into_iter().flat_map(|row| row.ids).collect::<Vec<_>>()
        };
        let (none, few) = (ids(usize::MAX), ids(1000));
        assert!(few.len() < none.len() + 10, "{none:?}\n{few:?} if a few checks are flaky");
    }
}
