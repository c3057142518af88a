//! What a report counts: the verdicts of each requirement, what is at fault, and why checks were
//! skipped, with the smallest few of the checks that did not pass. Its memory does not depend on the
//! number of checks.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use actucheck_spec::Spec;
use actucheck_spec::model::Level;
use indexmap::{IndexMap, IndexSet};

use super::model::{
    Cause, CheckResult, Header, NotPassed, ProfileEntry, Report, RequirementResult, Statement,
    Summary, Tally, VERSION,
};
use super::smallest::Smallest;
use crate::legible::{LONGEST_TEXT, legible};
use crate::suite::expect::Unexpected;
use crate::verdict::{Because, Outcome, Totals, Verdict};

/// How many different texts are counted separately; the suite itself has far fewer.
const MOST_TEXTS: usize = 200;
const OTHER_TEXTS: &str = "and other reasons";

/// The outcomes of a run so far, or of several parts of a run.
#[derive(Debug, Default)]
pub(super) struct Sums {
    /// By requirement, in the order in which they were first accused.
    causes: IndexMap<String, Cause>,
    mistakes: Counts,
    requirements: IndexMap<String, Collected>,
    questions: IndexMap<(String, String), Counts>,
    skips: Counts,
    expected_failures: Counts,
}

/// The outcomes of a requirement's checks.
#[derive(Debug)]
struct Collected {
    level: Level,
    totals: Totals,
    not_passed: BTreeMap<Verdict, Smallest>,
}

impl Collected {
    fn of(level: Level) -> Self {
        Self { level, totals: Totals::default(), not_passed: BTreeMap::new() }
    }

    fn keep(&mut self, outcome: Outcome, result: impl FnOnce(Outcome) -> CheckResult) {
        self.not_passed.entry(outcome.verdict).or_default().add(outcome, result);
    }
}

impl Sums {
    /// Adds an outcome, which becomes this result if it is kept. Outcomes arrive in the order of the
    /// plan.
    pub(super) fn add(&mut self, outcome: Outcome, result: impl FnOnce(Outcome) -> CheckResult) {
        if outcome.verdict == Verdict::Skip {
            self.skips.add(&outcome.detail, &outcome);
        }
        if let Some(reason) = &outcome.reason {
            self.expected_failures.add(reason, &outcome);
        }
        if outcome.verdict.accuses() {
            self.accuse(&outcome);
        }
        if let Some((mistake, _)) = outcome.mistake() {
            self.mistakes.add(mistake, &outcome);
        }
        if let Some(behaviour) = &outcome.behaviour {
            let question = (outcome.requirement.clone(), behaviour.question.clone());
            self.questions.entry(question).or_default().add(&behaviour.answer, &outcome);
        }
        let collected = match self.requirements.get_mut(&outcome.requirement) {
            Some(collected) => collected,
            None => self
                .requirements
                .entry(outcome.requirement.clone())
                .or_insert(Collected::of(outcome.level)),
        };
        collected.totals.add(outcome.verdict, 1);
        if !outcome.verdict.is_fine() {
            collected.keep(outcome, result);
        }
    }

    fn accuse(&mut self, outcome: &Outcome) {
        let Because { check, requirement } = outcome.cause();
        let cause = self.causes.entry(requirement.clone()).or_insert(Cause {
            requirement,
            check,
            failed: 0,
            follow: 0,
            number: outcome.number,
        });
        if outcome.follows() {
            cause.follow += 1;
        } else {
            cause.failed += 1;
        }
    }

    /// Turns passes into unexpected passes, which are known only at the end of a run.
    pub(super) fn revise(&mut self, unexpected: Unexpected) {
        let Unexpected { requirement, count, first } = unexpected;
        let Some(collected) = self.requirements.get_mut(&requirement) else { return };
        collected.totals.turn(Verdict::Pass, Verdict::UnexpectedPass, count);
        let more = count.saturating_sub(first.len());
        for outcome in first {
            collected.keep(outcome, CheckResult::of_pass);
        }
        if let Some(kept) = collected.not_passed.get_mut(&Verdict::UnexpectedPass) {
            kept.add_more(more);
        }
    }

    /// Adds the outcomes of another part of the run.
    pub(super) fn join(&mut self, part: Report) {
        for cause in part.causes {
            match self.causes.get_mut(&cause.requirement) {
                Some(own) => own.join(cause),
                None => drop(self.causes.insert(cause.requirement.clone(), cause)),
            }
        }
        self.mistakes.join(part.mistakes);
        self.skips.join(part.skips);
        self.expected_failures.join(part.expected_failures);
        for ProfileEntry { requirement, question, behaviours } in part.profile {
            self.questions.entry((requirement, question)).or_default().join(behaviours);
        }
        for RequirementResult { id, level, totals, .. } in part.requirements {
            let own = self.requirements.entry(id).or_insert(Collected::of(level));
            totals.counts().for_each(|(verdict, count)| own.totals.add(verdict, count));
        }
        for row in part.not_passed {
            if let Some(own) = self.requirements.get_mut(&row.requirement) {
                own.not_passed.entry(row.verdict).or_default().join(row);
            }
        }
    }

    /// The report.
    pub(super) fn finish(
        mut self,
        spec: &Spec,
        header: Header,
        summary: impl FnOnce(Totals) -> Summary,
        log: &str,
    ) -> Report {
        let summary = summary(self.totals());
        let lines: Vec<_> = log.lines().map(|line| legible(line, LONGEST_TEXT)).collect();
        self.causes.sort_by_cached_key(|_, cause| cause.number);
        let (requirements, not_passed) = requirements(self.requirements, spec);
        Report {
            version: VERSION,
            header,
            summary,
            causes: self.causes.into_values().collect(),
            requirements,
            profile: profile(self.questions),
            mistakes: self.mistakes.tallies(),
            skips: self.skips.tallies(),
            expected_failures: self.expected_failures.tallies(),
            expectations: None,
            not_passed,
            log: lines.join("\n"),
        }
    }

    fn totals(&self) -> Totals {
        let mut totals = Totals::default();
        for (verdict, count) in self.requirements.values().flat_map(|it| it.totals.counts()) {
            totals.add(verdict, count);
        }
        totals
    }
}

/// In the order of the documents. Rules of the adapter protocol, which no document has, come first.
fn requirements(
    mut all: IndexMap<String, Collected>,
    spec: &Spec,
) -> (Vec<RequirementResult>, Vec<NotPassed>) {
    let rows = spec.requirements.iter().flat_map(|file| &file.content.requirements);
    let places: IndexSet<&str> = rows.map(|row| row.id.as_str()).collect();
    all.sort_by_cached_key(|id, _| places.get_index_of(id.as_str()));
    let (mut results, mut not_passed) = (Vec::new(), Vec::new());
    for (id, Collected { level, totals, not_passed: kept }) in all {
        let rows = kept.into_iter();
        not_passed.extend(rows.map(|(verdict, kept)| kept.finish(id.clone(), verdict)));
        results.extend(totals.worst().map(|verdict| RequirementResult {
            statement: Statement::of(spec, &id),
            id,
            level,
            verdict,
            totals,
        }));
    }
    (results, not_passed)
}

/// The questions, in the order in which they were asked.
fn profile(mut questions: IndexMap<(String, String), Counts>) -> Vec<ProfileEntry> {
    questions.sort_by_cached_key(|_, answers| answers.first());
    let question = |((requirement, question), answers): (_, Counts)| ProfileEntry {
        requirement,
        question,
        behaviours: answers.tallies(),
    };
    questions.into_iter().map(question).collect()
}

impl Cause {
    /// Adds what another part of the run says of the same requirement.
    fn join(&mut self, part: Self) {
        self.failed = self.failed.saturating_add(part.failed);
        self.follow = self.follow.saturating_add(part.follow);
        if part.number < self.number {
            (self.check, self.number) = (part.check, part.number);
        }
    }
}

/// Counts texts, each with the first check that it came with.
#[derive(Debug, Default)]
struct Counts(IndexMap<String, Tally>);

impl Counts {
    fn add(&mut self, text: &str, outcome: &Outcome) {
        let mut text = legible(text, LONGEST_TEXT);
        if self.0.len() >= MOST_TEXTS && !self.0.contains_key(&text) {
            OTHER_TEXTS.clone_into(&mut text);
        }
        let new = || Tally {
            text: text.clone(),
            count: 0,
            example: outcome.id.clone(),
            number: outcome.number,
        };
        self.0.entry(text.clone()).or_insert_with(new).count += 1;
    }

    /// Adds the texts of another part of the run.
    fn join(&mut self, part: Vec<Tally>) {
        for tally in part {
            match self.0.get_mut(&tally.text) {
                Some(own) => own.join(tally),
                None => drop(self.0.insert(tally.text.clone(), tally)),
            }
        }
    }

    /// The number of the first check that it counts.
    fn first(&self) -> Option<usize> {
        self.0.values().map(|tally| tally.number).min().flatten()
    }

    /// The most frequent text first.
    fn tallies(mut self) -> Vec<Tally> {
        self.0.sort_by_cached_key(|_, tally| tally.number);
        self.leave_first();
        self.0.sort_by_cached_key(|_, tally| Reverse(tally.count));
        self.0.into_values().collect()
    }

    /// The texts of several parts may be more than are counted separately.
    fn leave_first(&mut self) {
        let named = self.0.keys().filter(|text| *text != OTHER_TEXTS).count();
        let Some(more) = named.checked_sub(MOST_TEXTS).filter(|more| *more > 0) else { return };
        let mut others = self.0.shift_remove(OTHER_TEXTS);
        for (_, tally) in self.0.split_off(self.0.len().saturating_sub(more)) {
            match &mut others {
                Some(others) => others.join(tally),
                None => others = Some(Tally { text: OTHER_TEXTS.to_owned(), ..tally }),
            }
        }
        self.join(others.into_iter().collect());
        self.0.sort_by_cached_key(|_, tally| tally.number);
    }
}

impl Tally {
    /// Adds what another part of the run says of the same text.
    fn join(&mut self, part: Self) {
        self.count = self.count.saturating_add(part.count);
        if part.number < self.number {
            (self.example, self.number) = (part.example, part.number);
        }
    }
}
