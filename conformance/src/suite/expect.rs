//! Expected failures: the checks that a subject is known to fail, each with a reason. The file is
//! audited: an expected failure that passes is reported.

mod audit;
mod cover;
mod failures;
mod file;
mod known;

use std::path::Path;
use std::sync::Arc;

use actucheck_spec::Spec;

use audit::Expected;
pub use audit::{Audit, Unexpected};
pub use failures::Failures;
pub use file::ExpectError;
use file::{File, Row};

use super::partition::Fingerprint;
use super::plan::Plan;
use super::select::Patterns;
use crate::input;
use crate::verdict::{Outcome, Verdict};

/// The expected failures of a subject, and what came out of them so far.
#[derive(Debug, Default)]
pub struct Expectations {
    /// The comment at the beginning of the file.
    comment: String,
    rows: Vec<Arc<Row>>,
    patterns: Patterns,
    audit: Audit,
}

/// The rows of an expected-failures file, before it is known which checks there are.
#[derive(Debug)]
pub struct Rows {
    name: String,
    /// A hash of the file's text.
    content: String,
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
        let (name, content) = (name.to_owned(), Fingerprint::of(text).to_string());
        let file = File::parse(&name, text)?;
        let texts = file.rows.iter().flat_map(|row| &row.ids).map(String::as_str);
        let patterns = Patterns::new(texts)
            .map_err(|message| ExpectError::Parse { path: name.clone(), message })?;
        Ok(Self { name, content, file, patterns })
    }

    /// What is expected of the checks of a plan. A row may name checks that the plan lacks but `widest`
    /// could have: those of other options.
    ///
    /// # Errors
    /// If a row has an id that no options yield.
    pub fn with(self, plan: &Plan<'_>, widest: &Plan<'_>) -> Result<Expectations, ExpectError> {
        let Self { name, content, file: File { is_blank, comment, rows }, patterns } = self;
        let counts = plan.count_matches(&patterns);
        let owners = rows.iter().zip(1..).flat_map(|(row, number)| {
            let flaky = row.flaky;
            row.ids.iter().map(move |id| (id, number, flaky))
        });
        let expected = |((id, row, flaky), checks): ((&String, usize, bool), usize)| {
            let (id, (asked, passed, may_fail)) = (id.clone(), Default::default());
            Expected { id, row, flaky, checks, asked, passed, may_fail }
        };
        let ids: Vec<_> = owners.zip(counts).map(expected).collect();
        let strange = ids.iter().filter(|own| own.checks == 0);
        let strange: Vec<_> = strange.map(|own| (own.row, own.id.as_str())).collect();
        if let Some((row, message)) = known::first_unknown(&strange, widest) {
            return Err(ExpectError::Row { path: name, row, message });
        }
        let rows = rows.into_iter().map(Arc::new).collect();
        let audit = Audit { file: name, content, is_blank, ids, ..Audit::default() };
        Ok(Expectations { comment, rows, patterns, audit })
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
        if matches.is_empty() {
            return;
        }
        self.audit.note(outcome, &matches);
        if outcome.verdict.is_failure() {
            let first = matches.iter().find_map(|place| self.audit.ids.get(*place));
            let row = first.and_then(|own| self.rows.get(own.row.checked_sub(1)?));
            outcome.verdict = Verdict::ExpectedFailure;
            outcome.reason = row.map(ToString::to_string);
        }
    }

    /// What came of the file so far.
    #[must_use]
    pub const fn audit(&self) -> &Audit {
        &self.audit
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
        let mut expected = self.audit.ids.iter();
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
        let outdated = self.audit.ids.iter().filter(|own| own.is_outdated()).count();
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
