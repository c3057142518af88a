//! Every outcome of a run as it comes, for programs: one JSON object a line.

use std::io::{self, Write};

use schemars::JsonSchema;
use serde::Serialize;

use super::model::{CheckResult, Header, Summary};

/// Version of the lines' form. It changes when a field goes or takes another meaning.
pub const VERSION: u32 = 1;

/// A line.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(tag = "line", rename_all = "kebab-case")]
pub enum Line {
    /// The first: what is checked, and with which checks.
    Header {
        /// Version of the lines' form.
        version: u32,
        /// The rest.
        #[serde(flatten)]
        header: Header,
    },
    /// What came out of a check. Outcomes stand in the order in which they came. A check that passes
    /// though it is expected to fail is a `pass` here: that it should not be expected is known at the
    /// end only, and counted in the last line.
    Check(Box<CheckResult>),
    /// The last: how the run went as a whole. A file without it is of a run that broke off.
    Summary(Summary),
}

/// Writes lines.
pub struct Stream<W> {
    out: W,
}

impl<W: Write> Stream<W> {
    /// Writes the first line.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn begin(out: W, header: Header) -> io::Result<Self> {
        let mut stream = Self { out };
        stream.line(&Line::Header { version: VERSION, header })?;
        Ok(stream)
    }

    /// Writes an outcome.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn check(&mut self, result: CheckResult) -> io::Result<()> {
        self.line(&Line::Check(Box::new(result)))
    }

    /// Writes the last line.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn end(mut self, summary: Summary) -> io::Result<()> {
        self.line(&Line::Summary(summary))?;
        self.out.flush()
    }

    fn line(&mut self, line: &Line) -> io::Result<()> {
        serde_json::to_writer(&mut self.out, line)?;
        self.out.write_all(b"\n")
    }
}
