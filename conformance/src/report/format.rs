//! The formats of a report, by name.

use std::io::{self, Write};

use anstream::adapter::strip_bytes;

use super::model::Report;
use super::{badge, github, html, json, junit, markdown, tap, text};

/// Says why a saved report can't be written as `jsonl`.
pub const NO_JSONL: &str =
    "jsonl has every check of a run, and a report keeps only some; write it with `actucheck codec`";

/// The formats of a report.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Text, as on the terminal.
    Text,
    /// The whole report, for programs.
    Json,
    /// Every outcome as it arrives, for programs; see [`super::jsonl`].
    Jsonl,
    /// For tools that collect test results.
    Junit,
    /// For readers of the Test Anything Protocol.
    Tap,
    /// Annotations of a GitHub job.
    Github,
    /// A badge for a README.
    Badge,
    /// A summary for a CI job's page.
    Markdown,
    /// A page that works without a network.
    Html,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 9] = [
        Self::Text,
        Self::Json,
        Self::Jsonl,
        Self::Junit,
        Self::Tap,
        Self::Github,
        Self::Badge,
        Self::Markdown,
        Self::Html,
    ];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Json => "json",
            Self::Jsonl => "jsonl",
            Self::Junit => "junit",
            Self::Tap => "tap",
            Self::Github => "github",
            Self::Badge => "badge",
            Self::Markdown => "markdown",
            Self::Html => "html",
        }
    }

    /// Writes a report in this format, without colours.
    ///
    /// # Errors
    /// If it can't be written, or not in this format.
    pub fn write(self, report: &Report, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Text => {
                let mut text = Vec::new();
                text::write(report, &mut text)?;
                out.write_all(&strip_bytes(&text).into_vec())
            }
            Self::Json => json::write(report, out),
            Self::Jsonl => Err(io::Error::new(io::ErrorKind::Unsupported, NO_JSONL)),
            Self::Junit => junit::write(report, out),
            Self::Tap => tap::write(report, out),
            Self::Github => github::write(report, out),
            Self::Badge => badge::write(report, out),
            Self::Markdown => markdown::write(report, out),
            Self::Html => html::write(report, out),
        }
    }

    /// Writes the error that ended a run before its first check, in the formats that CI servers read: they
    /// would take an earlier file for this run's. Returns `None` for the others, whose old files stay.
    #[must_use]
    pub fn not_started(self, sentence: &str) -> Option<io::Result<Vec<u8>>> {
        let write = match self {
            Self::Junit => junit::write_not_started,
            Self::Tap => tap::write_not_started,
            Self::Github => github::write_not_started,
            _ => return None,
        };
        let mut text = Vec::new();
        Some(write(sentence, &mut text).map(|()| text))
    }
}
