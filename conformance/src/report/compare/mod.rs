//! Compares several implementations: which requirements each one breaks, and what each one does
//! where the documents leave it unspecified.

mod html;
mod markdown;
mod model;
mod regression;
mod text;
mod words;

use std::io::{self, Write};

use anstream::adapter::strip_bytes;

pub use model::{
    Answers, Cell, Comparison, Implementation, NoCommonWire, ResponseTimes, Row, Standing,
};
pub use regression::{Regression, Worse};
pub use text::write as write_text;

use super::format::Format;
use super::json;

/// Says that a comparison has no such format.
pub const ONE_RUN: &str =
    "that format describes one run; a comparison is written as text, json, markdown or html";

impl Format {
    /// Whether a comparison can be written in this format.
    #[must_use]
    pub const fn compares(self) -> bool {
        matches!(self, Self::Text | Self::Json | Self::Markdown | Self::Html)
    }

    /// Writes a comparison in this format, without colours.
    ///
    /// # Errors
    /// If it can't be written, or not in this format.
    pub fn write_comparison(self, comparison: &Comparison, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Text => {
                let mut text = Vec::new();
                text::write(comparison, &mut text)?;
                out.write_all(&strip_bytes(&text).into_vec())
            }
            Self::Json => json::write(comparison, out),
            Self::Markdown => markdown::write(comparison, out),
            Self::Html => html::write(comparison, out),
            _ => Err(io::Error::new(io::ErrorKind::Unsupported, ONE_RUN)),
        }
    }
}
