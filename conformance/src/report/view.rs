//! What a reader looks for in a report, whatever format it is written in.

use std::fmt;

use indexmap::IndexMap;

use super::model::{CheckResult, Report, RequirementResult, Stopped};
use super::words;
use crate::adapter::Output;
use crate::explain::diff::Row;
use crate::verdict::{Outcome, Verdict};

impl Report {
    /// The verdicts that a reader wants to see the evidence of, the most urgent one first: as long
    /// as the adapter itself is at fault, the rest tells little.
    pub const URGENT: [Verdict; 7] = [
        Verdict::AdapterFault,
        Verdict::Crash,
        Verdict::Timeout,
        Verdict::UnexpectedPass,
        Verdict::Fail,
        Verdict::Warn,
        Verdict::ExpectedFailure,
    ];

    /// Why the run ended early and what that cost, in a sentence; `None` if it did not.
    #[must_use]
    pub fn cut_short(&self) -> Option<String> {
        let why = match self.stopped? {
            Stopped::Interrupted => "interrupted",
            Stopped::MaxFail => "as much failed as --max-fail allows",
        };
        let left = words::count(self.left, "check");
        Some(format!("{why}: {left} not asked"))
    }

    /// The results with this verdict by requirement, in the order of the documents.
    #[must_use]
    pub fn groups(&self, verdict: Verdict) -> Vec<Group<'_>> {
        let mut by_requirement: IndexMap<&str, Vec<&CheckResult>> = IndexMap::new();
        for result in self.results.iter().filter(|result| result.outcome.verdict == verdict) {
            by_requirement.entry(&result.outcome.requirement).or_default().push(result);
        }
        let mut groups = Vec::new();
        for requirement in &self.requirements {
            if let Some(mut results) = by_requirement.swap_remove(requirement.id.as_str()) {
                results.sort_by_cached_key(|result| result.size());
                groups.push(Group { verdict, requirement, results });
            }
        }
        groups
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

/// The checks of a requirement that came out alike.
#[derive(Clone, Debug)]
pub struct Group<'a> {
    /// What came out.
    pub verdict: Verdict,
    /// The requirement.
    pub requirement: &'a RequirementResult,
    /// The checks, the shortest request first.
    pub results: Vec<&'a CheckResult>,
}

/// A group's checks as far as a reader wants to see them.
#[derive(Clone, Debug)]
pub struct Shown<'a> {
    /// With their evidence.
    pub whole: &'a [&'a CheckResult],
    /// By their ids.
    pub named: &'a [&'a CheckResult],
    /// How many there are beyond.
    pub beyond: usize,
}

impl Group<'_> {
    /// The checks, the first few of them with their evidence.
    #[must_use]
    pub fn shown(&self, whole: usize, named: usize) -> Shown<'_> {
        let (whole, rest) = self.results.split_at(self.results.len().min(whole));
        let (named, beyond) = rest.split_at(rest.len().min(named));
        Shown { whole, named, beyond: beyond.len() }
    }
}

impl CheckResult {
    /// What was asked, what was demanded, what came instead, why that is not right, and how to ask
    /// it again: each with its label.
    #[must_use]
    pub fn evidence(&self) -> Vec<(&'static str, Evidence<'_>)> {
        let Outcome { request, expected, actual, detail, .. } = &self.outcome;
        let outputs = [expected, actual]
            .map(|output| output.as_ref().map(|output| Evidence::Code(output.to_string())));
        let rows = match &self.diff {
            Some(diff) => [&diff.expected, &diff.actual].map(|row| Some(Evidence::Bytes(row))),
            None => [None, None],
        };
        // The rows are either the outputs themselves or parameters in them.
        let ([expected, got], [params, instead]) = match expected {
            Some(Output::Bytes(_)) if self.diff.is_some() => (rows, [None, None]),
            _ => (outputs, rows),
        };
        let lines = [
            ("request", request.as_ref().map(|op| Evidence::Code(op.to_string()))),
            ("expected", expected),
            ("got", got),
            ("params", params),
            ("instead", instead),
            ("differs", self.differs().map(Evidence::Words)),
            ("because", Some(Evidence::Words(detail.clone()))),
            ("replay", self.replay.clone().map(Evidence::Code)),
        ];
        lines.into_iter().filter_map(|(label, evidence)| Some((label, evidence?))).collect()
    }

    /// `byte 5, in the length`; `None` where no part of a frame is to blame.
    fn differs(&self) -> Option<String> {
        let (at, part) = (self.diff.as_ref()?.first?, self.differs_in.as_ref()?);
        Some(format!("byte {at}, in the {part}"))
    }

    /// How long its request is: the measure by which a case is small.
    fn size(&self) -> usize {
        self.outcome.request.as_ref().map_or(0, |request| request.to_string().len())
    }
}

/// Something that speaks for or against an implementation.
#[derive(Clone, Debug)]
pub enum Evidence<'a> {
    /// For a reader.
    Words(String),
    /// For a program.
    Code(String),
    /// Bytes; those that differ stand in brackets.
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
