//! The report as one page without network access or scripts, for small and large screens.

use std::io::{self, Write};

use askama::Template;

use super::model::Report;
use super::view::{Evidence, Group, Section};
use super::words;
use crate::explain::diff::Segment;
use crate::verdict::Verdict;

/// Writes the page.
///
/// # Errors
/// If it can't be written.
pub fn write(report: &Report, out: &mut dyn Write) -> io::Result<()> {
    let mut out = io::BufWriter::new(out);
    Page { report, groups: groups(report) }.write_into(&mut out)?;
    out.flush()
}

#[derive(Template)]
#[template(path = "report.html")]
struct Page<'a> {
    report: &'a Report,
    /// The findings, in the order of the page.
    groups: Vec<Group<'a>>,
}

/// The sections of one document.
struct Document<'a> {
    title: &'a str,
    sections: Vec<Section<'a>>,
}

impl Page<'_> {
    /// The place of the first finding on a requirement.
    fn finding_on(&self, requirement: &str) -> Option<String> {
        let mut groups = self.groups.iter();
        groups.find(|group| group.requirement.id == requirement).map(Group::anchor)
    }

    fn is_cause(&self, requirement: &str) -> bool {
        self.report.causes.iter().any(|cause| cause.requirement == requirement)
    }

    /// Where a cause leads: to its finding, or to its requirement if its failures are expected.
    fn evidence(&self, requirement: &str) -> String {
        let row = || words::anchor("requirement", requirement);
        self.finding_on(requirement).unwrap_or_else(row)
    }

    /// Where a requirement is accused: a warning accuses none.
    fn accused(&self, requirement: &str) -> String {
        let kind = if self.is_cause(requirement) { "cause" } else { "requirement" };
        words::anchor(kind, requirement)
    }

    fn documents(&self) -> Vec<Document<'_>> {
        let mut documents: Vec<Document<'_>> = Vec::new();
        for section in self.report.sections() {
            match documents.iter_mut().find(|document| document.title == section.document) {
                Some(document) => document.sections.push(section),
                None => {
                    documents.push(Document { title: section.document, sections: vec![section] });
                }
            }
        }
        documents
    }
}

/// What is accused first, the most basic first, then what follows from it, and warnings. Expected
/// failures are shown by their reasons.
fn groups(report: &Report) -> Vec<Group<'_>> {
    let mut groups = report.findings();
    let accused: Vec<_> = groups.iter().map(Group::anchor).collect();
    let all = Report::URGENT.into_iter().filter(|verdict| *verdict != Verdict::ExpectedFailure);
    let others = all.flat_map(|verdict| report.groups(verdict));
    groups.extend(others.filter(|group| !accused.contains(&group.anchor())));
    groups
}

/// How many findings are open when the page is.
const OPEN: usize = 3;
