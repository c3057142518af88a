//! Makes a report from outcomes, one at a time. Its memory does not grow with their number: it
//! keeps counts, and the smallest few of the checks that did not pass.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use actucheck_spec::model::Level;
use indexmap::{IndexMap, IndexSet};

use super::model::{
    Cause, NotPassed, ProfileEntry, Report, RequirementResult, Statement, Stopped, Summary, Tally,
    VERSION,
};
use super::result::Run;
use super::smallest::Smallest;
use crate::legible::{LONGEST_TEXT, legible};
use crate::suite::expect::Unexpected;
use crate::traffic::Traffic;
use crate::verdict::{Because, Outcome, Totals, Verdict};

/// How many different texts are counted separately; the suite itself has far fewer.
const MOST_TEXTS: usize = 200;
const OTHER_TEXTS: &str = "and other reasons";

/// How a run ended.
#[derive(Clone, Debug, Default)]
pub struct End {
    /// How long it took.
    pub seconds: f64,
    /// Why it ended early, if it did.
    pub stopped: Option<Stopped>,
    /// How many checks were not asked because of that.
    pub left: usize,
    /// The last lines that the adapter logged.
    pub log: String,
    /// What passed on the line to a device.
    pub traffic: Option<Traffic>,
}

/// Collects the outcomes of a run for its report.
#[derive(Debug)]
pub struct Collector<'a> {
    run: &'a Run<'a>,
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

impl<'a> Collector<'a> {
    /// A collector without outcomes.
    #[must_use]
    pub fn new(run: &'a Run<'a>) -> Self {
        let (causes, requirements, questions) = Default::default();
        let (mistakes, skips, expected_failures) = Default::default();
        Self { run, causes, mistakes, requirements, questions, skips, expected_failures }
    }

    /// Adds an outcome. Outcomes arrive in the order of the plan.
    pub fn add(&mut self, outcome: Outcome) {
        if outcome.verdict == Verdict::Skip {
            self.skips.add(&outcome.detail, &outcome.id);
        }
        if let Some(reason) = &outcome.reason {
            self.expected_failures.add(reason, &outcome.id);
        }
        if outcome.verdict.accuses() {
            self.accuse(&outcome);
        }
        if let Some((mistake, _)) = outcome.mistake() {
            self.mistakes.add(mistake, &outcome.id);
        }
        if let Some(behaviour) = &outcome.behaviour {
            let question = (outcome.requirement.clone(), behaviour.question.clone());
            let answers = self.questions.entry(question).or_default();
            answers.add(&behaviour.answer, &outcome.id);
        }
        let collected = match self.requirements.get_mut(&outcome.requirement) {
            Some(collected) => collected,
            None => self.requirements.entry(outcome.requirement.clone()).or_insert(Collected {
                level: outcome.level,
                totals: Totals::default(),
                not_passed: BTreeMap::new(),
            }),
        };
        collected.totals.add(outcome.verdict, 1);
        if !outcome.verdict.is_fine() {
            collected.keep(self.run, outcome);
        }
    }

    fn accuse(&mut self, outcome: &Outcome) {
        let Because { check, requirement } = outcome.cause();
        let cause = self.causes.entry(requirement.clone()).or_insert(Cause {
            requirement,
            check,
            failed: 0,
            follow: 0,
        });
        if outcome.follows() {
            cause.follow += 1;
        } else {
            cause.failed += 1;
        }
    }

    /// Turns passes into unexpected passes, which are known only at the end of a run.
    pub fn revise(&mut self, unexpected: Unexpected) {
        let Unexpected { requirement, count, first } = unexpected;
        let Some(collected) = self.requirements.get_mut(&requirement) else { return };
        collected.totals.turn(Verdict::Pass, Verdict::UnexpectedPass, count);
        let more = count.saturating_sub(first.len());
        for outcome in first {
            collected.keep(self.run, outcome);
        }
        if let Some(kept) = collected.not_passed.get_mut(&Verdict::UnexpectedPass) {
            kept.add_more(more);
        }
    }

    fn totals(&self) -> Totals {
        let mut totals = Totals::default();
        for (verdict, count) in self.requirements.values().flat_map(|it| it.totals.counts()) {
            totals.add(verdict, count);
        }
        totals
    }

    /// The report, with how the run ended.
    #[must_use]
    pub fn finish(mut self, end: End) -> Report {
        let End { seconds, stopped, left, log, traffic } = end;
        let totals = self.totals();
        let lines: Vec<_> = log.lines().map(|line| legible(line, LONGEST_TEXT)).collect();
        let (requirements, not_passed) = self.requirements();
        Report {
            version: VERSION,
            header: self.run.header(),
            summary: Summary { seconds, stopped, left, totals, traffic },
            causes: std::mem::take(&mut self.causes).into_values().collect(),
            requirements,
            profile: self.profile(),
            mistakes: self.mistakes.tallies(),
            skips: self.skips.tallies(),
            expected_failures: self.expected_failures.tallies(),
            not_passed,
            log: lines.join("\n"),
        }
    }

    /// In the order of the documents. Rules of the adapter protocol, which no document has, come
    /// first.
    fn requirements(&mut self) -> (Vec<RequirementResult>, Vec<NotPassed>) {
        let spec = self.run.spec;
        let rows = spec.requirements.iter().flat_map(|file| &file.content.requirements);
        let places: IndexSet<&str> = rows.map(|row| row.id.as_str()).collect();
        let mut all = std::mem::take(&mut self.requirements);
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
    fn profile(&mut self) -> Vec<ProfileEntry> {
        let question = |((requirement, question), answers): (_, Counts)| ProfileEntry {
            requirement,
            question,
            behaviours: answers.tallies(),
        };
        std::mem::take(&mut self.questions).into_iter().map(question).collect()
    }
}

impl Extend<Outcome> for Collector<'_> {
    fn extend<I: IntoIterator<Item = Outcome>>(&mut self, outcomes: I) {
        outcomes.into_iter().for_each(|outcome| self.add(outcome));
    }
}

impl Collected {
    fn keep(&mut self, run: &Run<'_>, outcome: Outcome) {
        let smallest = self.not_passed.entry(outcome.verdict).or_default();
        smallest.add(outcome, |outcome| run.result(outcome));
    }
}

/// Counts texts, each with the first check that it came with.
#[derive(Debug, Default)]
struct Counts(IndexMap<String, (usize, String)>);

impl Counts {
    fn add(&mut self, text: &str, id: &str) {
        let mut text = legible(text, LONGEST_TEXT);
        if self.0.len() >= MOST_TEXTS && !self.0.contains_key(&text) {
            OTHER_TEXTS.clone_into(&mut text);
        }
        let (count, _) = self.0.entry(text).or_insert_with(|| (0, id.to_owned()));
        *count += 1;
    }

    /// The most frequent text first.
    fn tallies(mut self) -> Vec<Tally> {
        self.0.sort_by_cached_key(|_, (count, _)| Reverse(*count));
        let tally = |(text, (count, example))| Tally { text, count, example };
        self.0.into_iter().map(tally).collect()
    }
}
