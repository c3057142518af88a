//! The formats of a report, by name.

use std::io::{self, Write};

use anstream::adapter::strip_bytes;

use super::model::Report;
use super::{html, json, junit, markdown, text};

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
    /// A summary for a CI job's page.
    Markdown,
    /// A page that works without a network.
    Html,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 6] =
        [Self::Text, Self::Json, Self::Jsonl, Self::Junit, Self::Markdown, Self::Html];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Text => "text",
            Self::Json => "json",
            Self::Jsonl => "jsonl",
            Self::Junit => "junit",
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
            Self::Markdown => markdown::write(report, out),
            Self::Html => html::write(report, out),
        }
    }
}
