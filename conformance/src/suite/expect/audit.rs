//! What came of an expected-failures file: which of its ids and globs are outdated, in a run or in all
//! parts of one.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::verdict::{Outcome, Verdict};

/// What came of the ids and globs of an expected-failures file so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Audit {
    /// The file's name.
    pub(super) file: String,
    /// A hash of its text.
    pub(super) content: String,
    /// Whether it has nothing in it.
    pub(super) is_blank: bool,
    /// Its ids and globs, in order.
    pub(super) ids: Vec<Expected>,
    /// The passes of checks that are expected to fail, by requirement and by the ids and globs that match.
    /// Whether one of these is outdated is known only when all its checks were asked.
    pub(super) passes: Vec<Passes>,
    /// The first failure that two rows name.
    pub(super) named_twice: Option<Twice>,
}

/// An id or a glob of a row.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(super) struct Expected {
    /// The id or glob.
    pub(super) id: String,
    /// The number of its row, from 1.
    pub(super) row: usize,
    /// Whether the row says that its checks pass at times.
    pub(super) flaky: bool,
    /// How many checks it matches.
    pub(super) checks: usize,
    /// How many of them have an outcome.
    pub(super) asked: usize,
    /// Whether one of them passed.
    pub(super) passed: bool,
    /// Whether one of them failed, or may fail and was not run.
    pub(super) may_fail: bool,
}

/// Passes of a requirement's checks that the same ids and globs match.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub(super) struct Passes {
    /// The requirement's id.
    pub(super) requirement: String,
    /// The places of the ids and globs, from 0.
    pub(super) ids: Vec<usize>,
    /// How many passes there are.
    pub(super) count: usize,
    /// The first few of them.
    pub(super) first: Vec<Outcome>,
}

/// A failure that two rows name.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub(super) struct Twice {
    /// The check's id.
    id: String,
    /// Its number; only in a part of a run.
    number: Option<usize>,
    /// The rows, from 1.
    rows: [usize; 2],
}

/// How many passes of a requirement's checks are kept.
const KEPT: usize = 5;

/// Passes of a requirement's checks that an expected-failures file says are failures.
#[derive(Clone, Debug, PartialEq)]
pub struct Unexpected {
    /// The requirement's id.
    pub requirement: String,
    /// How many there are.
    pub count: usize,
    /// The first few of them.
    pub first: Vec<Outcome>,
}

impl Expected {
    /// Whether a check that it matches passed, and it is known that no other fails.
    pub(super) fn is_outdated(&self) -> bool {
        self.passed && self.asked == self.checks && !self.may_fail && !self.flaky
    }
}

impl Audit {
    /// Whether a run had a file.
    #[must_use]
    pub fn is_of_file(&self) -> bool {
        !self.file.is_empty()
    }

    /// Notes the outcome of a check that the ids and globs at these places match.
    pub(super) fn note(&mut self, outcome: &Outcome, matches: &[usize]) {
        let failed = outcome.verdict.is_failure();
        for place in matches {
            let Some(expected) = self.ids.get_mut(*place) else { continue };
            expected.asked += 1;
            expected.passed |= outcome.verdict == Verdict::Pass;
            expected.may_fail |= failed || outcome.verdict == Verdict::NotRun;
        }
        if failed && self.named_twice.is_none() {
            let mut rows =
                matches.iter().filter_map(|place| self.ids.get(*place)).map(|own| own.row);
            let first = rows.next();
            let other = rows.find(|row| Some(*row) != first);
            let twice = |(first, other)| {
                let Outcome { id, number, .. } = outcome;
                Twice { id: id.clone(), number: *number, rows: [first, other] }
            };
            self.named_twice = first.zip(other).map(twice);
        }
        if outcome.verdict == Verdict::Pass {
            self.add_passes(&outcome.requirement, matches, |passes| {
                passes.count += 1;
                if passes.first.len() < KEPT {
                    passes.first.push(outcome.clone());
                }
            });
        }
    }

    /// Adds to the passes of a requirement's checks that these ids and globs match.
    fn add_passes(&mut self, requirement: &str, ids: &[usize], add: impl FnOnce(&mut Passes)) {
        let key = (requirement, ids);
        let place = self.passes.partition_point(|it| (it.requirement.as_str(), &*it.ids) < key);
        let there = self.passes.get(place).map(|it| (it.requirement.as_str(), &*it.ids));
        if there != Some(key) {
            let (requirement, ids) = (requirement.to_owned(), ids.to_vec());
            self.passes.insert(place, Passes { requirement, ids, count: 0, first: Vec::new() });
        }
        if let Some(passes) = self.passes.get_mut(place) {
            add(passes);
        }
    }

    /// At the end of a run: the passes of checks that an outdated id or glob matches, as
    /// [`Verdict::UnexpectedPass`].
    #[must_use]
    pub fn unexpected(&self) -> Vec<Unexpected> {
        let outdated = |place: &usize| self.ids.get(*place).filter(|own| own.is_outdated());
        let mut all = Vec::new();
        for Passes { requirement, ids, count, first } in &self.passes {
            let Some(Expected { id, .. }) = ids.iter().find_map(outdated) else { continue };
            let mut first = first.clone();
            for outcome in &mut first {
                outcome.verdict = Verdict::UnexpectedPass;
                outcome.detail = format!(
                    "passes, though `{id}` is an expected failure; take it out of the file"
                );
            }
            all.push(Unexpected { requirement: requirement.clone(), count: *count, first });
        }
        all
    }

    /// What a user should know about the file, at the end of a run that asked all its checks; one
    /// sentence each.
    #[must_use]
    pub fn remarks(&self) -> Vec<String> {
        let name = &self.file;
        if self.is_blank {
            return vec![format!("{name} is empty, so no failure is expected")];
        }
        let mut remarks = Vec::new();
        let mut idle = self.ids.iter().filter(|own| own.asked == 0);
        if let Some(first) = idle.next() {
            let (idle, all, first) = (1 + idle.count(), self.ids.len(), &first.id);
            remarks.push(format!(
                "{name}: {idle} of {all} ids name no check that was asked, the first of them \
                 `{first}`; another --seed, --cases, --body-length, --wire, --select or --also has them"
            ));
        }
        if let Some(Twice { id, rows: [first, other], .. }) = &self.named_twice {
            remarks.push(format!(
                "{name}: row {other} names `{id}` again; the reason in row {first} is taken"
            ));
        }
        remarks
    }

    /// Whether it is about the same file and the same checks.
    #[must_use]
    pub fn is_like(&self, other: &Self) -> bool {
        let facts = |own: &Expected| (own.id.clone(), own.row, own.flaky, own.checks);
        self.content == other.content && self.ids.iter().map(facts).eq(other.ids.iter().map(facts))
    }

    /// Adds what came of the same file in another part of the run.
    pub fn join(&mut self, part: Self) {
        for (own, part) in self.ids.iter_mut().zip(part.ids) {
            own.asked = own.asked.saturating_add(part.asked);
            own.passed |= part.passed;
            own.may_fail |= part.may_fail;
        }
        for Passes { requirement, ids, count, first } in part.passes {
            self.add_passes(&requirement, &ids, |own| {
                own.count = own.count.saturating_add(count);
                own.first.extend(first);
                own.first.sort_by_key(|outcome| outcome.number);
                own.first.truncate(KEPT);
            });
        }
        let both = self.named_twice.take().into_iter().chain(part.named_twice);
        self.named_twice = both.min_by_key(|twice| twice.number);
    }

    /// Forgets the numbers that the checks of parts have, when all parts are joined.
    pub fn make_whole(&mut self) {
        let first = self.passes.iter_mut().flat_map(|passes| &mut passes.first);
        first.for_each(|outcome| outcome.number = None);
    }
}
