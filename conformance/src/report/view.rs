//! Views of a report that several formats share.

use std::fmt;

use indexmap::IndexMap;

use super::model::{Cause, CheckResult, NotPassed, Report, RequirementResult, Stopped, Tally};
use super::{course, words};
use crate::adapter::Output;
use crate::explain::diff::Row;
use crate::traffic::Traffic;
use crate::verdict::{After, Outcome, Verdict};

impl Report {
    /// The verdicts whose evidence is shown, the most urgent first. While the adapter itself has
    /// problems, the other verdicts say little.
    pub const URGENT: [Verdict; 8] = [
        Verdict::AdapterFault,
        Verdict::Crash,
        Verdict::Timeout,
        Verdict::UnexpectedPass,
        Verdict::Flaky,
        Verdict::Fail,
        Verdict::Warn,
        Verdict::ExpectedFailure,
    ];

    /// Why the run ended early, and how many checks were not asked; `None` if it did not end early.
    #[must_use]
    pub fn cut_short(&self) -> Option<String> {
        let why = match self.summary.stopped? {
            Stopped::Interrupted => "interrupted",
            Stopped::MaxFail => "the number of failures that --max-fail allows was reached",
        };
        let left = words::count(self.summary.left, "check");
        Some(format!("{why}: {left} not asked"))
    }

    /// What passed on the line to a device, and how long its answers took, in a line each.
    #[must_use]
    pub fn passed(&self) -> Vec<String> {
        let Some(traffic) = &self.summary.traffic else { return Vec::new() };
        let Traffic { pieces, sent, received, unasked, response, .. } = traffic;
        let bytes = |count| words::count(count, "byte");
        let unasked = match *unasked {
            0 => String::new(),
            count => format!(", {} of them unasked", words::thousands(count)),
        };
        let pieces = words::thousands(*pieces);
        let on_line = format!(
            "{pieces} packets and parts of packets were sent, {}; {} came{unasked}",
            bytes(*sent),
            bytes(*received)
        );
        let answers = response.as_ref().map(|spread| {
            let [least, median, p99, most] = words::spread(spread);
            let count = words::count(spread.count, "answer");
            format!("{count} began after {least} to {most} ms, half within {median} ms, 99 of 100 within {p99} ms")
        });
        std::iter::once(on_line).chain(answers).collect()
    }

    /// The checks with this verdict by requirement: those that are accused, the most basic first,
    /// then the others in the order of the documents.
    #[must_use]
    pub fn groups(&self, verdict: Verdict) -> Vec<Group<'_>> {
        let mut groups = Vec::new();
        for checks in self.not_passed.iter().filter(|row| row.verdict == verdict) {
            let mut all = self.requirements.iter();
            let own = all.find(|requirement| requirement.id == checks.requirement);
            groups.extend(own.map(|requirement| Group { requirement, checks }));
        }
        let place = |group: &Group<'_>| {
            let accused = |cause: &Cause| cause.requirement == group.requirement.id;
            let place = self.causes.iter().position(accused);
            (group.origin().is_some(), place.unwrap_or(self.causes.len()))
        };
        groups.sort_by_key(place);
        groups
    }

    /// The part of a run that it is about, in words; `None` for a whole run.
    #[must_use]
    pub fn part(&self) -> Option<String> {
        self.header.part.as_ref().map(|part| part.partition.to_string())
    }

    /// The checks that accuse their own requirement, the most basic requirement first. If failures
    /// that are expected lead to others, they are among them; so are failures that follow from checks of
    /// another part of the run, as nothing else in this report shows them.
    #[must_use]
    pub fn findings(&self) -> Vec<Group<'_>> {
        let cause = |group: &Group<'_>| {
            let own = |cause: &Cause| cause.requirement == group.requirement.id;
            self.causes.iter().position(own).unwrap_or(self.causes.len())
        };
        let leads = |group: &Group<'_>| {
            self.causes.get(cause(group)).is_some_and(|cause| cause.failed == 0)
        };
        let is_shown = |cause: &Cause| cause.failed > 0;
        let is_elsewhere = |group: &Group<'_>| {
            let mut causes = self.causes.iter().filter(|cause| is_shown(cause));
            self.header.part.is_some()
                && !causes.any(|cause| group.checks.following.contains_key(&cause.requirement))
        };
        let accuses = |group: &Group<'_>| match group.checks.verdict {
            Verdict::Warn => false,
            Verdict::ExpectedFailure => leads(group),
            _ => group.origin().is_none() || is_elsewhere(group),
        };
        let groups = Self::URGENT.into_iter().flat_map(|verdict| self.groups(verdict));
        let mut findings: Vec<_> = groups.filter(accuses).collect();
        findings.sort_by_key(cause);
        findings
    }

    /// The mistakes that fit many more failures than chance makes, at most so many, in a line each.
    #[must_use]
    pub fn explained(&self, most: usize) -> Vec<String> {
        let failed = self.summary.totals.count(Verdict::Fail);
        // One mistake has up to 32 trials in 65,536: about 1 in 2,000 failures fits by chance.
        let told = |tally: &&Tally| tally.count > 1 + failed / 500;
        let line = |Tally { text, count, example, .. }: &Tally| {
            let (count, failures) =
                (words::thousands(*count), words::count(failed, "wrong answer"));
            format!("{count} of {failures} fit the mistake {text}; the first is {example}")
        };
        self.mistakes.iter().filter(told).take(most).map(line).collect()
    }

    /// Why failures are expected, at most so many reasons, in a line each.
    #[must_use]
    pub fn excused(&self, most: usize) -> Vec<String> {
        let count = |number| words::count(number, "expected failure");
        let line = |tally: &Tally| format!("{}: {}", count(tally.count), tally.text);
        let mut lines: Vec<_> = self.expected_failures.iter().take(most).map(line).collect();
        let (all, rest) = (&self.expected_failures, self.expected_failures.iter().skip(most));
        let more: usize = rest.map(|tally| tally.count).sum();
        // An earlier report has no reasons.
        match self.summary.totals.count(Verdict::ExpectedFailure) {
            number if number > 0 && all.is_empty() => lines.push(count(number)),
            _ if more > 0 => lines.push(format!("… and {} for other reasons", count(more))),
            _ => {}
        }
        lines
    }

    /// The requirements by section, in the order of the documents.
    #[must_use]
    pub fn sections(&self) -> Vec<Section<'_>> {
        let mut sections: IndexMap<(&str, &str), Vec<&RequirementResult>> = IndexMap::new();
        for requirement in &self.requirements {
            let place = requirement.statement.as_ref();
            let place = place.map(|place| (place.document.as_str(), place.section.as_str()));
            sections.entry(place.unwrap_or_default()).or_default().push(requirement);
        }
        let section =
            |((document, section), requirements)| Section { document, section, requirements };
        sections.into_iter().map(section).collect()
    }
}

impl Cause {
    /// `12 checks failed, and 300 of other requirements follow`.
    #[must_use]
    pub fn effect(&self) -> String {
        let failed = words::count(self.failed, "check");
        match self.follow {
            0 => format!("{failed} failed"),
            more if self.failed == 0 && self.number.is_some() => {
                let more = words::count(more, "check");
                format!("no new failures of its own in this part, but {more} of others follow")
            }
            more if self.failed == 0 => {
                let more = words::thousands(more);
                format!("its failures are expected, but {more} of other requirements follow")
            }
            more => format!(
                "{failed} failed, and {} of other requirements follow",
                words::thousands(more)
            ),
        }
    }
}

/// The requirements of a document's section.
#[derive(Clone, Debug)]
pub struct Section<'a> {
    /// The document's title; empty for the rules of the adapter protocol.
    pub document: &'a str,
    /// The section; empty for the rules of the adapter protocol.
    pub section: &'a str,
    /// Its requirements.
    pub requirements: Vec<&'a RequirementResult>,
}

impl Section<'_> {
    /// The document and the section.
    #[must_use]
    pub fn title(&self) -> String {
        match self.document {
            "" => "The adapter protocol".to_owned(),
            document => format!("{document}, {}", self.section),
        }
    }
}

/// The checks of a requirement with the same verdict.
#[derive(Clone, Copy, Debug)]
pub struct Group<'a> {
    /// The requirement.
    pub requirement: &'a RequirementResult,
    /// The number of checks, and the smallest of them.
    pub checks: &'a NotPassed,
}

impl Group<'_> {
    /// Its place in a page.
    #[must_use]
    pub fn anchor(&self) -> String {
        words::anchor(&format!("finding-{}", self.checks.verdict), &self.requirement.id)
    }

    /// `65 of 23,963 checks`.
    #[must_use]
    pub fn share(&self) -> String {
        let all = words::count(self.requirement.checks(), "check");
        format!("{} of {all}", words::thousands(self.checks.count))
    }

    /// As [`NotPassed::origin`].
    #[must_use]
    pub fn origin(&self) -> Option<String> {
        self.checks.origin()
    }

    /// The number of checks without kept evidence.
    #[must_use]
    pub fn more(&self) -> usize {
        self.checks.count.saturating_sub(self.checks.smallest.len())
    }
}

impl NotPassed {
    /// The requirements that are accused instead, if all of these checks follow from the failures of
    /// others: `a`, or `a (12), b (3)`.
    #[must_use]
    pub fn origin(&self) -> Option<String> {
        let Self { count, following, .. } = self;
        if following.values().sum::<usize>() < *count {
            return None;
        }
        let counted = |(requirement, count): (&String, &usize)| {
            format!("{requirement} ({})", words::thousands(*count))
        };
        match following.first_key_value() {
            Some((only, _)) if following.len() == 1 => Some(only.clone()),
            _ => Some(following.iter().map(counted).collect::<Vec<_>>().join(", ")),
        }
    }
}

impl CheckResult {
    /// The question, the expected answer, the actual answer, the reason, and how to ask it again,
    /// each with its label.
    #[must_use]
    pub fn evidence(&self) -> Vec<(&'static str, Evidence<'_>)> {
        let Outcome { request, expected, actual, detail, reason, .. } = &self.outcome;
        let outputs = [expected, actual]
            .map(|output| output.as_ref().map(|output| Evidence::Code(output.to_string())));
        let rows = match &self.diff {
            Some(diff) => [&diff.expected, &diff.actual].map(|row| Some(Evidence::Bytes(row))),
            None => [None, None],
        };
        // The rows are the outputs or the parameters in them.
        let ([expected, got], [params, instead]) = match expected {
            Some(Output::Bytes(_)) if self.diff.is_some() => (rows, [None, None]),
            _ => (outputs, rows),
        };
        // The rows of a conversation have all of it.
        let rows = course::rows(&self.outcome);
        let (request, got) = if rows.is_some() { (&None, None) } else { (request, got) };
        let rows = rows.into_iter().flatten();
        let rows = rows.map(|(label, row)| (label, Some(Evidence::Words(row))));
        let lines = [
            ("request", request.as_ref().map(|op| Evidence::Code(op.to_string()))),
            ("expected", expected),
            ("got", got),
            ("params", params),
            ("instead", instead),
            ("differs", self.differs().map(Evidence::Words)),
            ("mistake", self.mistake.clone().map(Evidence::Words)),
            ("because", Some(Evidence::Words(detail.clone()))),
            ("reason", reason.clone().map(Evidence::Words)),
            ("follows", self.follows().map(Evidence::Words)),
            ("after", self.after().map(Evidence::Words)),
            ("left out", self.left_out().map(Evidence::Words)),
            ("replay", self.replay.clone().map(Evidence::Code)),
        ];
        // An error output has a row for each line.
        let log = self.outcome.log.iter().flat_map(|log| log.lines()).enumerate();
        let log = log.map(|(place, line)| {
            let label = if place == 0 { "log" } else { "" };
            (label, Some(Evidence::Code(line.to_owned())))
        });
        let lines = rows.chain(lines).chain(log);
        lines.filter_map(|(label, evidence)| Some((label, evidence?))).collect()
    }

    /// `byte 5, in the length`; `None` if the difference is not in a frame.
    fn differs(&self) -> Option<String> {
        let (at, part) = (self.diff.as_ref()?.first?, self.differs_in.as_ref()?);
        Some(format!("byte {at}, in the {part}"))
    }

    /// `from CHECK (REQUIREMENT)`; `None` if it accuses its own requirement.
    fn follows(&self) -> Option<String> {
        let cause = self.outcome.because.as_ref()?;
        Some(format!("from {} ({})", cause.check, cause.requirement))
    }

    /// The earlier checks that bring it about; of many the last few. The replay line has all of them.
    fn after(&self) -> Option<String> {
        const NAMED: usize = 3;
        let After { count, checks } = self.outcome.after.as_ref()?;
        let last = checks.get(checks.len().saturating_sub(NAMED)..).unwrap_or_default();
        let checks = last.join(", ");
        Some(match count.saturating_sub(last.len()) {
            0 => checks,
            more => format!("{} more and {checks}", words::thousands(more)),
        })
    }

    /// A note about cut texts, and where to see them in full.
    fn left_out(&self) -> Option<String> {
        let bytes = words::count(self.left_out?, "byte");
        Some(format!("{bytes} that are too long for a report; `actucheck show` has the request"))
    }
}

/// A piece of evidence about an implementation.
#[derive(Clone, Debug)]
pub enum Evidence<'a> {
    /// For a reader.
    Words(String),
    /// For a program.
    Code(String),
    /// Bytes; those that differ are in brackets.
    Bytes(&'a Row),
}

impl fmt::Display for Evidence<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Words(text) | Self::Code(text) => f.write_str(text),
            Self::Bytes(row) => row.fmt(f),
        }
    }
}
