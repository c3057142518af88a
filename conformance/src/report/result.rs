//! An outcome in a report, with the bytes that differ and the command that asks the check again.
//! Its texts are cut to a limit, as an implementation may send texts of any length.

use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

use actucheck_spec::Spec;

use super::model::{CheckResult, Header, Part};
use crate::adapter::{HostPort, Implementation, Question, Wire};
use crate::explain::diff;
use crate::legible::{LONGEST_TEXT, legible};
use crate::suite::Options;
use crate::verdict::{Outcome, Verdict};

/// The limit of a request or output as JSON, in bytes.
const LONGEST_PART: usize = 4000;

/// A run, as known before its first check.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The spec that the checks come from.
    pub spec: &'a Spec,
    /// The implementation that is checked.
    pub implementation: &'a Implementation,
    /// The wires whose checks are asked.
    pub wires: &'a [Wire],
    /// When it began, in UTC, as in RFC 3339.
    pub date: String,
    /// The program's command line, quoted for a shell.
    pub command_line: String,
    /// The options that determine the checks.
    pub options: Options,
    /// The part of a run that it is; `None` for a whole one.
    pub part: Option<Part>,
    /// The port that hosts get, if it was chosen.
    pub port: Option<HostPort>,
    /// The adapter's command; empty for the built-in codec.
    pub command: &'a [String],
    /// The words that ask checks again, before the option that selects them; empty if `replay` does.
    pub again: &'a [String],
    /// The files with checks that `actucheck list` does not have, by the checks' ids.
    pub records: BTreeMap<String, PathBuf>,
}

impl Run<'_> {
    /// The part of a report about it.
    #[must_use]
    pub fn header(&self) -> Header {
        Header {
            actucheck: env!("CARGO_PKG_VERSION").to_owned(),
            date: Some(self.date.clone()),
            command_line: Some(legible(&self.command_line, LONGEST_TEXT)),
            implementation: self.implementation.clone().legible(),
            wires: self.wires.to_vec(),
            command: self.command.to_vec(),
            seed: self.options.seed,
            cases: self.options.cases,
            body_length: self.options.body_length,
            part: self.part.clone(),
        }
    }

    /// The part of a report about an outcome.
    #[must_use]
    pub fn result(&self, mut outcome: Outcome) -> CheckResult {
        let bytes = outcome.bytes();
        let diff = bytes.map(|(expected, actual)| diff::bytes(expected, actual));
        let first = diff.as_ref().and_then(|diff| diff.first);
        let differs_in = match (&outcome.request, bytes, first) {
            (Some(Question::Encode { wire, .. }), Some((expected, _)), Some(at)) => {
                Some(wire.part(expected, at).to_owned())
            }
            _ => None,
        };
        let mistake = outcome.mistake().map(|(_, words)| words);
        let replay = self.replay(&outcome);
        outcome.detail = legible(&outcome.detail, LONGEST_TEXT);
        outcome.reason = outcome.reason.map(|reason| legible(&reason, LONGEST_TEXT));
        let left_out = leave_out(&mut outcome.request)
            + leave_out(&mut outcome.expected)
            + leave_out(&mut outcome.actual);
        let left_out = (left_out > 0).then_some(left_out);
        CheckResult { outcome, diff, differs_in, mistake, left_out, replay, size: None }
    }

    /// The command that asks the check again, quoted for a shell; `None` if that does not bring the
    /// failure about.
    fn replay(&self, outcome: &Outcome) -> Option<String> {
        outcome.request.as_ref()?;
        let Options { seed, cases, .. } = self.options;
        let id = &outcome.id;
        if !self.again.is_empty() {
            let select = ["--select".to_owned(), id.clone()];
            return Some(self.with_command([self.again, &select].concat()));
        }
        let record = self.records.get(id);
        let what = record.map_or_else(|| id.clone(), |path| path.display().to_string());
        let mut words = vec!["actucheck".to_owned(), "replay".to_owned(), what];
        let mut asked = vec![id];
        if outcome.verdict == Verdict::Flaky {
            let after = outcome.after.as_ref().filter(|after| after.is_whole())?;
            asked.extend(&after.checks);
            if asked.iter().any(|id| self.records.contains_key(*id)) {
                return None;
            }
            words.extend(after.checks.iter().flat_map(|id| ["--after".to_owned(), id.clone()]));
        }
        if record.is_none() && asked.iter().any(|id| id.contains(".seed-")) {
            words.extend(["--seed".to_owned(), seed.to_string()]);
            if cases > Options::new().cases {
                words.extend(["--cases".to_owned(), cases.to_string()]);
            }
        }
        if let (Some(Question::Converse { .. }), Some(port)) = (&outcome.request, self.port) {
            words.extend(["--port".to_owned(), port.to_string()]);
        }
        Some(self.with_command(words))
    }

    /// The words with the command that was started after them, quoted for a shell.
    fn with_command(&self, mut words: Vec<String>) -> String {
        if !self.command.is_empty() {
            words.push("--".to_owned());
            words.extend_from_slice(self.command);
        }
        // Only a NUL can't be quoted, and a command that was started has none.
        shlex::try_join(words.iter().map(String::as_str)).unwrap_or_default()
    }
}

/// Removes outputs that are too long. Returns the number of bytes removed.
fn leave_out<T: fmt::Display>(part: &mut Option<T>) -> usize {
    let bytes = part.as_ref().map_or(0, |part| part.to_string().len());
    if bytes <= LONGEST_PART {
        return 0;
    }
    *part = None;
    bytes
}
