//! Expected failures: the checks that a subject is known to fail, each with a reason. The file is
//! audited: an expected failure that passes is reported.

mod cover;
mod failures;
mod file;
mod known;

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use actucheck_spec::Spec;

pub use failures::Failures;
pub use file::ExpectError;
use file::{File, Row};

use super::plan::Plan;
use super::select::Patterns;
use crate::input;
use crate::verdict::{Outcome, Verdict};

/// The expected failures of a subject, and what came out of them so far.
#[derive(Debug, Default)]
pub struct Expectations {
    /// The file's name; empty without a file.
    name: String,
    /// Whether the file has nothing in it.
    is_blank: bool,
    /// The comment at its beginning.
    comment: String,
    rows: Vec<Arc<Row>>,
    patterns: Patterns,
    /// Of each pattern, in the same order.
    expected: Vec<Expected>,
    /// The passes of checks that are expected to fail, by requirement and by the patterns that match.
    /// Whether a pattern is outdated is known only when all its checks were asked.
    passes: BTreeMap<(String, Vec<usize>), Passes>,
    /// The first failure that two rows name, with the numbers of the rows.
    named_twice: Option<(String, usize, usize)>,
}

/// An id or a glob of a row.
#[derive(Debug)]
struct Expected {
    /// The row of the id or glob.
    row: Arc<Row>,
    /// The number of the row, from 1.
    number: usize,
    /// How many checks it matches.
    checks: usize,
    /// How many of them have an outcome.
    asked: usize,
    /// Whether one of them passed.
    passed: bool,
    /// Whether one of them failed, or may fail and was not run.
    may_fail: bool,
}

impl Expected {
    /// Whether a check that it matches passed, and it is known that no other fails.
    fn is_outdated(&self) -> bool {
        self.passed && self.asked == self.checks && !self.may_fail && !self.row.flaky
    }
}

/// How many checks passed, and the first of them.
#[derive(Debug, Default)]
struct Passes {
    count: usize,
    first: Vec<Outcome>,
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

/// The rows of an expected-failures file, before it is known which checks there are.
#[derive(Debug)]
pub struct Rows {
    name: String,
    file: File,
    patterns: Patterns,
}

impl Rows {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// If it can't be read, or is malformed.
    pub fn read(path: &Path) -> Result<Self, ExpectError> {
        Self::parse(&path.display().to_string(), &input::yaml_text(path)?)
    }

    fn parse(name: &str, text: &str) -> Result<Self, ExpectError> {
        let name = name.to_owned();
        let file = File::parse(&name, text)?;
        let texts = file.rows.iter().flat_map(|row| &row.ids).map(String::as_str);
        let patterns = Patterns::new(texts)
            .map_err(|message| ExpectError::Parse { path: name.clone(), message })?;
        Ok(Self { name, file, patterns })
    }

    /// What is expected of the checks of a plan. A row may name checks that the plan lacks but `widest`
    /// could have: those of other options.
    ///
    /// # Errors
    /// If a row has an id that no options yield.
    pub fn with(self, plan: &Plan<'_>, widest: &Plan<'_>) -> Result<Expectations, ExpectError> {
        let Self { name, file: File { is_blank, comment, rows }, patterns } = self;
        let mut counts = plan.count_matches(&patterns).into_iter();
        let mut expected = Vec::new();
        let rows: Vec<_> = rows.into_iter().map(Arc::new).collect();
        for (row, number) in rows.iter().zip(1..) {
            for checks in counts.by_ref().take(row.ids.len()) {
                let row = Arc::clone(row);
                let (asked, passed, may_fail) = Default::default();
                expected.push(Expected { row, number, checks, asked, passed, may_fail });
            }
        }
        let strange = expected.iter().zip(patterns.texts()).filter(|(own, _)| own.checks == 0);
        let strange: Vec<_> = strange.map(|(own, text)| (own.number, text.as_str())).collect();
        if let Some((row, message)) = known::first_unknown(&strange, widest) {
            return Err(ExpectError::Row { path: name, row, message });
        }
        let (passes, named_twice) = Default::default();
        Ok(Expectations { name, is_blank, comment, rows, patterns, expected, passes, named_twice })
    }
}

impl Expectations {
    /// Reads the text of the file `name`, for the checks of a plan, as [`Rows::with`] does.
    ///
    /// # Errors
    /// If it is malformed, or has an id that no options yield.
    pub fn parse(
        name: &str,
        text: &str,
        plan: &Plan<'_>,
        widest: &Plan<'_>,
    ) -> Result<Self, ExpectError> {
        Rows::parse(name, text)?.with(plan, widest)
    }

    /// Turns an expected failure into [`Verdict::ExpectedFailure`], and notes a pass that is not
    /// expected. If several rows name a check, the first one has the reason.
    pub fn apply(&mut self, outcome: &mut Outcome) {
        let matches = self.patterns.matches(&outcome.id);
        let failed = outcome.verdict.is_failure();
        for place in &matches {
            let Some(expected) = self.expected.get_mut(*place) else { continue };
            expected.asked += 1;
            expected.passed |= outcome.verdict == Verdict::Pass;
            expected.may_fail |= failed || outcome.verdict == Verdict::NotRun;
        }
        let mut own = matches.iter().filter_map(|place| self.expected.get(*place));
        let Some(first) = own.next() else { return };
        if failed {
            outcome.verdict = Verdict::ExpectedFailure;
            outcome.reason = Some(first.row.to_string());
            let other = own.find(|other| other.number != first.number);
            if let Some(other) = other.filter(|_| self.named_twice.is_none()) {
                self.named_twice = Some((outcome.id.clone(), first.number, other.number));
            }
        }
        if outcome.verdict == Verdict::Pass {
            let passes = self.passes.entry((outcome.requirement.clone(), matches)).or_default();
            passes.count += 1;
            if passes.first.len() < KEPT {
                passes.first.push(outcome.clone());
            }
        }
    }

    /// At the end of a run: the passes of checks that an outdated id or glob matches, as
    /// [`Verdict::UnexpectedPass`].
    #[must_use]
    pub fn unexpected(&mut self) -> Vec<Unexpected> {
        let outdated = |place: &usize| {
            let is_outdated = self.expected.get(*place)?.is_outdated();
            self.patterns.texts().get(*place).filter(|_| is_outdated)
        };
        let mut all = Vec::new();
        for ((requirement, places), passes) in std::mem::take(&mut self.passes) {
            let Some(text) = places.iter().find_map(outdated) else { continue };
            let Passes { count, mut first } = passes;
            for outcome in &mut first {
                outcome.verdict = Verdict::UnexpectedPass;
                outcome.detail = format!(
                    "passes, though `{text}` is an expected failure; take it out of the file"
                );
            }
            all.push(Unexpected { requirement, count, first });
        }
        all
    }

    /// What a user should know about the file, at the end of a run that asked all its checks; one
    /// sentence each.
    #[must_use]
    pub fn remarks(&self) -> Vec<String> {
        let name = &self.name;
        if self.is_blank {
            return vec![format!("{name} is empty, so no failure is expected")];
        }
        let mut remarks = Vec::new();
        let texts = self.patterns.texts().iter().zip(&self.expected);
        let idle: Vec<_> = texts.filter(|(_, own)| own.asked == 0).map(|(text, _)| text).collect();
        if let Some(first) = idle.first() {
            let (idle, all) = (idle.len(), self.expected.len());
            remarks.push(format!(
                "{name}: {idle} of {all} ids name no check that was asked, the first of them \
                 `{first}`; another --seed, --cases, --body-length, --wire, --select or --also has them"
            ));
        }
        if let Some((id, first, other)) = &self.named_twice {
            remarks.push(format!(
                "{name}: row {other} names `{id}` again; the reason in row {first} is taken"
            ));
        }
        remarks
    }

    /// At the end of a run: the file that expects these failures as well. Rows stay, but outdated ids
    /// go.
    ///
    /// # Errors
    /// If it can't be written as YAML; no such file is known.
    pub fn with(
        &self,
        failures: &Failures,
        plan: &Plan<'_>,
        spec: &Spec,
    ) -> Result<Extended, serde_yaml::Error> {
        let mut expected = self.expected.iter();
        let kept = self.rows.iter().filter_map(|row| {
            let own = row.ids.iter().zip(expected.by_ref());
            let ids = own.filter(|(_, own)| !own.is_outdated()).map(|(id, _)| id.clone());
            let ids: Vec<_> = ids.collect();
            (!ids.is_empty()).then(|| Row { ids, ..Row::clone(row) })
        });
        let mut rows: Vec<_> = kept.collect();
        let (more, left_out) = failures.rows(plan, spec);
        let new = more.len();
        rows.extend(more);
        let outdated = self.expected.iter().filter(|own| own.is_outdated()).count();
        let comment = self.comment.clone();
        let text = File { is_blank: false, comment, rows }.text()?;
        Ok(Extended { text, new, outdated, left_out })
    }
}

/// An expected-failures file with the failures of a run.
#[derive(Debug)]
pub struct Extended {
    /// Its YAML text.
    pub text: String,
    /// How many of its rows are new.
    pub new: usize,
    /// How many ids were outdated, and are not in it.
    pub outdated: usize,
    /// How many failures are not in it: there are too many, or the adapter itself is at fault.
    pub left_out: usize,
}
