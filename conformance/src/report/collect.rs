//! A finished run as a report.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::path::PathBuf;

use actucheck_spec::Spec;
use indexmap::{IndexMap, IndexSet};

use super::model::{
    CheckResult, Question, Report, RequirementResult, Statement, Stopped, Tally, VERSION,
};
use crate::adapter::{self, Implementation, Wire};
use crate::explain::diff;
use crate::suite::Options;
use crate::verdict::{Outcome, Totals, Verdict};

/// A finished run.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The spec that the checks come from.
    pub spec: &'a Spec,
    /// What was checked.
    pub implementation: &'a Implementation,
    /// What decided which checks there were.
    pub options: Options,
    /// The adapter's command; empty for the built-in codec.
    pub command: &'a [String],
    /// The files that keep checks which `actucheck list` does not have, by the checks' ids.
    pub records: BTreeMap<String, PathBuf>,
    /// What came out of each check.
    pub outcomes: Vec<Outcome>,
    /// Why it ended early, if it did.
    pub stopped: Option<Stopped>,
    /// How many checks were not asked for that.
    pub left: usize,
    /// How long it took.
    pub seconds: f64,
    /// The last lines that the adapter logged.
    pub log: String,
}

impl From<Run<'_>> for Report {
    fn from(run: Run<'_>) -> Self {
        Self {
            version: VERSION,
            actucheck: env!("CARGO_PKG_VERSION").to_owned(),
            implementation: run.implementation.clone(),
            wire: run.options.wire,
            command: run.command.to_vec(),
            seed: run.options.seed,
            cases: run.options.cases,
            body_length: run.options.body_length,
            seconds: run.seconds,
            stopped: run.stopped,
            left: run.left,
            totals: Totals::of(&run.outcomes),
            requirements: requirements(run.spec, &run.outcomes),
            profile: profile(&run.outcomes),
            skips: skips(&run.outcomes),
            results: run.outcomes.iter().map(|outcome| result(&run, outcome)).collect(),
            log: run.log,
        }
    }
}

/// In the order of the documents; what no document demands comes first, for it is about the
/// adapter.
fn requirements(spec: &Spec, outcomes: &[Outcome]) -> Vec<RequirementResult> {
    let mut groups: IndexMap<&str, Vec<&Outcome>> = IndexMap::new();
    for outcome in outcomes {
        groups.entry(&outcome.requirement).or_default().push(outcome);
    }
    let rows = spec.requirements.iter().flat_map(|file| &file.content.requirements);
    let places: IndexSet<&str> = rows.map(|row| row.id.as_str()).collect();
    groups.sort_by_cached_key(|id, _| places.get_index_of(id));
    let requirement = |(id, outcomes): (&str, Vec<&Outcome>)| {
        let totals = Totals::of(outcomes.iter().copied());
        Some(RequirementResult {
            id: id.to_owned(),
            level: outcomes.first()?.level,
            statement: Statement::of(spec, id),
            verdict: totals.worst()?,
            totals,
        })
    };
    groups.into_iter().filter_map(requirement).collect()
}

/// A question after the other, in the order in which they were asked.
fn profile(outcomes: &[Outcome]) -> Vec<Question> {
    let mut questions: IndexMap<(&str, &str), Vec<(&str, &str)>> = IndexMap::new();
    for outcome in outcomes {
        if let Some(behaviour) = &outcome.behaviour {
            let question = (outcome.requirement.as_str(), behaviour.question.as_str());
            let answer = (behaviour.answer.as_str(), outcome.id.as_str());
            questions.entry(question).or_default().push(answer);
        }
    }
    let question = |((requirement, question), answers): ((&str, &str), Vec<_>)| Question {
        requirement: requirement.to_owned(),
        question: question.to_owned(),
        behaviours: tally(answers),
    };
    questions.into_iter().map(question).collect()
}

fn skips(outcomes: &[Outcome]) -> Vec<Tally> {
    let skipped = outcomes.iter().filter(|outcome| outcome.verdict == Verdict::Skip);
    tally(skipped.map(|outcome| (outcome.detail.as_str(), outcome.id.as_str())))
}

/// Counts equal texts, each of which comes with the id of a check; the most frequent first.
fn tally<'a>(texts: impl IntoIterator<Item = (&'a str, &'a str)>) -> Vec<Tally> {
    let mut tallies: IndexMap<&str, Tally> = IndexMap::new();
    for (text, id) in texts {
        let tally = tallies.entry(text).or_insert_with(|| Tally {
            text: text.to_owned(),
            count: 0,
            example: id.to_owned(),
        });
        tally.count += 1;
    }
    tallies.sort_by_cached_key(|_, tally| Reverse(tally.count));
    tallies.into_values().collect()
}

fn result(run: &Run<'_>, outcome: &Outcome) -> CheckResult {
    let bytes = outcome.bytes();
    let diff = bytes.map(|(expected, actual)| diff::bytes(expected, actual));
    let first = diff.as_ref().and_then(|diff| diff.first);
    let differs_in = match (&outcome.request, bytes, first) {
        (
            Some(adapter::Question::Encode { wire: Wire::Dynamixel2, .. }),
            Some((expected, _)),
            Some(at),
        ) => Some(diff::part_of_frame(expected, at).to_owned()),
        _ => None,
    };
    let replay = outcome.request.is_some().then(|| replay(run, &outcome.id));
    CheckResult { outcome: outcome.clone(), diff, differs_in, replay }
}

/// The command that asks the same again, as a shell takes it.
fn replay(run: &Run<'_>, id: &str) -> String {
    let Options { wire, seed, cases, .. } = run.options;
    let record = run.records.get(id);
    let what = record.map_or_else(|| id.to_owned(), |path| path.display().to_string());
    let mut words = vec!["actucheck".to_owned(), "replay".to_owned(), what];
    if record.is_none() && id.contains(".seed-") {
        words.extend(["--seed".to_owned(), seed.to_string()]);
        if cases > Options::new(wire).cases {
            words.extend(["--cases".to_owned(), cases.to_string()]);
        }
    }
    if !run.command.is_empty() {
        words.push("--".to_owned());
        words.extend_from_slice(run.command);
    }
    // Only a NUL can't be quoted, and no command that was started has one.
    shlex::try_join(words.iter().map(String::as_str)).unwrap_or_default()
}
