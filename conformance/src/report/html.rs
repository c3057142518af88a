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
    Page { report }.write_into(&mut out)?;
    out.flush()
}

#[derive(Template)]
#[template(path = "report.html")]
struct Page<'a> {
    report: &'a Report,
}

/// The sections of one document.
struct Document<'a> {
    title: &'a str,
    sections: Vec<Section<'a>>,
}

impl Page<'_> {
    /// The verdicts whose evidence is shown, the most urgent first.
    fn groups(&self) -> Vec<Group<'_>> {
        Report::URGENT.into_iter().flat_map(|verdict| self.report.groups(verdict)).collect()
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
