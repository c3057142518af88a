//! Merges the reports of all parts of a run into that of the whole.
//!
//! It is the report that one run of all checks would have written: a part's report has the number of
//! each check that it shows, so that the order of the plan is known again, and what came of every
//! expected failure, as an outdated one is known only when all parts were asked. The time is the sum
//! of the parts'. What depends on more than the answers is not the same: what the adapters logged,
//! and what was given up because such questions cost an adapter too often.

use std::num::NonZeroU32;

use actucheck_spec::Spec;
use thiserror::Error;

use super::model::{CheckResult, Header, Part, Report, Summary};
use super::read;
use super::sums::Sums;
use crate::run::UNKNOWN_OP;
use crate::suite::expect::Audit;
use crate::suite::partition::Partition;
use crate::verdict::Verdict;

/// A report and the name of its file.
pub type Named = (String, Report);

/// Why reports are not all parts of one run.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MergeError {
    /// There are none.
    #[error("no report of a part; give those of all parts of a run")]
    Nothing,
    /// It is about a whole run.
    #[error("{path} is about a whole run; only reports of runs with --partition can be merged")]
    Whole {
        /// The file.
        path: String,
    },
    /// Two are of runs that differ.
    #[error("{path} is not of the same run as {first}: {what}; run all parts alike")]
    Different {
        /// The file.
        path: String,
        /// The file that it is compared with.
        first: String,
        /// What differs.
        what: String,
    },
    /// One part is there twice.
    #[error("{first} and {second} are both {part}; give each part once")]
    Twice {
        /// The first file.
        first: String,
        /// The second file.
        second: String,
        /// The part.
        part: Partition,
    },
    /// Parts are not there.
    #[error("part {number} of {of} is missing{more}; give the reports of all parts")]
    Missing {
        /// The first of them.
        number: u32,
        /// How many parts there are.
        of: NonZeroU32,
        /// How many more are missing, in words.
        more: String,
    },
    /// What they say together can't be.
    #[error("the parts contradict one another: {what}; run them again")]
    Contradiction {
        /// The contradiction.
        what: String,
    },
}

/// The report of the whole run, and what came of its expected-failures file.
///
/// # Errors
/// If the reports are not those of all parts of one run.
pub fn merge(spec: &Spec, mut parts: Vec<Named>) -> Result<(Report, Option<Audit>), MergeError> {
    let alike = look_alike(&parts)?;
    parts.sort_by_key(|(_, report)| report.header.part.as_ref().map(|part| part.partition.number));
    all_there(&parts, alike.partition)?;
    let header = header(&parts).ok_or(MergeError::Nothing)?;
    let (mut sums, mut audit, mut logs): (_, Option<Audit>, _) =
        (Sums::default(), None, Vec::new());
    let (mut seconds, mut stopped, mut left) = (0.0, None, 0_usize);
    for (_, report) in parts {
        seconds += report.summary.seconds;
        stopped = stopped.or(report.summary.stopped);
        left = left.saturating_add(report.summary.left);
        logs.extend(Some(report.log.clone()).filter(|log| !log.is_empty()));
        let mut report = as_asked(report);
        match (&mut audit, report.expectations.take()) {
            (Some(audit), Some(part)) => audit.join(part),
            (audit, part) => *audit = part,
        }
        sums.join(report);
    }
    if let Some(audit) = &mut audit {
        audit.make_whole();
        audit.unexpected().into_iter().for_each(|passes| sums.revise(passes));
    }
    let summary = |totals| Summary { seconds, stopped, left, totals, traffic: None };
    let report = unnumbered(sums.finish(spec, header, summary, &logs.join("\n")));
    match read::contradiction(&report).or_else(|| wrong_size(&report, &alike)) {
        Some(what) => Err(MergeError::Contradiction { what }),
        None => Ok((report, audit)),
    }
}

/// What the parts have in common. All are compared with the first.
fn look_alike(parts: &[Named]) -> Result<Part, MergeError> {
    let (first, one) = parts.first().ok_or(MergeError::Nothing)?;
    for (path, report) in parts {
        let whole = || MergeError::Whole { path: path.clone() };
        let part = report.header.part.as_ref().ok_or_else(whole)?;
        if let Some(what) = difference(one, report, part) {
            return Err(MergeError::Different { path: path.clone(), first: first.clone(), what });
        }
    }
    let whole = || MergeError::Whole { path: first.clone() };
    one.header.part.clone().ok_or_else(whole)
}

/// In which respect a report is of another run than the first one.
fn difference(first: &Report, report: &Report, part: &Part) -> Option<String> {
    let (one, other) = (&first.header, &report.header);
    let common = one.part.as_ref()?;
    let who = |header: &Header| {
        let who = &header.implementation;
        format!("{} {} ({})", who.name, who.version, who.language)
    };
    let wires = |header: &Header| {
        header.wires.iter().map(|wire| wire.id()).collect::<Vec<_>>().join(" and ")
    };
    let words = |part: &Part| part.settings.join(" ");
    let facts = [
        ("the number of parts", part.partition.of.to_string(), common.partition.of.to_string()),
        ("the version of actucheck", other.actucheck.clone(), one.actucheck.clone()),
        ("the implementation", who(other), who(one)),
        ("the wire", wires(other), wires(one)),
        ("the adapter's command", other.command.join(" "), one.command.join(" ")),
        ("--seed", other.seed.to_string(), one.seed.to_string()),
        ("--cases", other.cases.to_string(), one.cases.to_string()),
        ("--body-length", other.body_length.to_string(), one.body_length.to_string()),
        ("how it was asked", words(part), words(common)),
        ("the number of checks", part.checks.to_string(), common.checks.to_string()),
    ];
    let differing = facts.into_iter().find(|(_, other, one)| other != one);
    if let Some((what, other, one)) = differing {
        return Some(format!("{what} is {other}, not {one}"));
    }
    if other.implementation != one.implementation || other.command != one.command {
        return Some("the implementation is another one".to_owned());
    }
    if part.ids != common.ids {
        return Some("other checks were selected".to_owned());
    }
    let is_like = match (&first.expectations, &report.expectations) {
        (Some(one), Some(other)) => other.is_like(one),
        (None, None) => true,
        _ => false,
    };
    (!is_like).then(|| "the expected failures are others".to_owned())
}

/// Each part must be there once. They are in order.
fn all_there(parts: &[Named], Partition { of, .. }: Partition) -> Result<(), MergeError> {
    let there = |(path, report): &'_ Named| {
        let partition = report.header.part.as_ref().map(|part| part.partition);
        partition.map(|partition| (path.clone(), partition))
    };
    let there: Vec<_> = parts.iter().filter_map(there).collect();
    for ((first, part), (second, other)) in there.iter().zip(there.iter().skip(1)) {
        if part == other {
            let (first, second) = (first.clone(), second.clone());
            return Err(MergeError::Twice { first, second, part: *part });
        }
    }
    let mut numbers = there.iter().map(|(_, part)| part.number.get()).peekable();
    let first = (1..=of.get()).find(|number| numbers.next_if_eq(number).is_none());
    let Some(first) = first else { return Ok(()) };
    let all = usize::try_from(of.get()).unwrap_or(usize::MAX);
    let more = match all.saturating_sub(there.len() + 1) {
        0 => String::new(),
        more => format!(", and {more} more"),
    };
    Err(MergeError::Missing { number: first, of, more })
}

/// The facts about the whole run. It began when the first part did.
fn header(parts: &[Named]) -> Option<Header> {
    let (_, first) = parts.first()?;
    let dates = parts.iter().filter_map(|(_, report)| report.header.date.clone());
    let line = first.header.command_line.as_deref();
    let (date, command_line) = (dates.min(), line.map(of_whole));
    Some(Header { date, command_line, part: None, ..first.header.clone() })
}

/// The command line without the option that makes it a part.
fn of_whole(line: &str) -> String {
    const OPTION: &str = "--partition";
    let Some(words) = shlex::split(line) else { return line.to_owned() };
    let (mut whole, mut words) = (Vec::new(), words.into_iter());
    while let Some(word) = words.next() {
        match word.strip_prefix(OPTION) {
            Some("") => drop(words.next()),
            Some(value) if value.starts_with('=') => {}
            // What follows is the adapter's own.
            _ if word == "--" => {
                whole.push(word);
                whole.extend(words.by_ref());
            }
            _ => whole.push(word),
        }
    }
    // Only a NUL can't be quoted, and no argument has one.
    shlex::try_join(whole.iter().map(String::as_str)).unwrap_or_else(|_| line.to_owned())
}

/// A report without what only the whole run knows: which passes are unexpected.
fn as_asked(mut report: Report) -> Report {
    for row in &mut report.requirements {
        let count = row.totals.count(Verdict::UnexpectedPass);
        row.totals.turn(Verdict::UnexpectedPass, Verdict::Pass, count);
    }
    report.not_passed.retain(|row| row.verdict != Verdict::UnexpectedPass);
    report
}

/// The report without what only parts have.
fn unnumbered(mut report: Report) -> Report {
    let behaviours = report.profile.iter_mut().flat_map(|question| &mut question.behaviours);
    let tallies = report.mistakes.iter_mut().chain(&mut report.skips);
    let tallies = tallies.chain(&mut report.expected_failures).chain(behaviours);
    tallies.for_each(|tally| tally.number = None);
    report.causes.iter_mut().for_each(|cause| cause.number = None);
    for CheckResult { outcome, size, .. } in
        report.not_passed.iter_mut().flat_map(|row| &mut row.smallest)
    {
        (outcome.number, *size) = (None, None);
    }
    report
}

/// Whether the parts have another number of checks than the run.
fn wrong_size(report: &Report, whole: &Part) -> Option<String> {
    let own = report.requirements.iter().filter(|row| row.id != UNKNOWN_OP);
    let own = own.fold(report.summary.left, |sum, row| sum.saturating_add(row.checks()));
    (own != whole.checks).then(|| format!("they have {own} of {} checks", whole.checks))
}
