//! What came out of a run, for a person and for a program.
//!
//! [`collect`] makes a [`model::Report`] of a run; every format writes that, and the JSON format is
//! that, so that [`read`] can bring it back: to be written in another format, or to be held
//! against others in [`compare`].

pub mod collect;
pub mod compare;
pub mod html;
pub mod json;
pub mod junit;
pub mod markdown;
pub mod model;
pub mod read;
pub mod schema;
pub mod text;
pub mod view;
mod words;

use std::io::{self, Write};

use anstream::adapter::strip_bytes;

pub use collect::Run;
pub use model::{Report, Stopped};

/// What a report can be written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Format {
    /// As on the terminal.
    Text,
    /// Everything, for programs.
    Json,
    /// For what collects the results of tests.
    Junit,
    /// A summary for a CI job's page.
    Markdown,
    /// A page that needs no network.
    Html,
}

impl Format {
    /// Writes a report in this format, without colours.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn write(self, report: &Report, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Text => {
                let mut text = Vec::new();
                text::write(report, &mut text)?;
                out.write_all(&strip_bytes(&text).into_vec())
            }
            Self::Json => json::write(report, out),
            Self::Junit => junit::write(report, out),
            Self::Markdown => markdown::write(report, out),
            Self::Html => html::write(report, out),
        }
    }
}
