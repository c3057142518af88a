//! Every outcome of a run as it arrives, for programs: one JSON object per line.

use std::io::{self, Write};

use schemars::JsonSchema;
use serde::Serialize;

use super::model::{CheckResult, Header, Summary};

/// Version of the lines' format. It changes when a field is removed or gets another meaning.
pub const VERSION: u32 = 3;

/// A line.
#[derive(Clone, Debug, Serialize, JsonSchema)]
#[serde(tag = "line", rename_all = "kebab-case")]
pub enum Line {
    /// The first line: what is checked, and with which checks.
    Header {
        /// Version of the lines' format.
        version: u32,
        /// The rest.
        #[serde(flatten)]
        header: Header,
    },
    /// The outcome of a check, in the order of arrival. A check that passes although it is expected
    /// to fail is a `pass` here, as unexpected passes are known only at the end; the last line
    /// counts them.
    Check(Box<CheckResult>),
    /// The last line: the result of the whole run. A file without it is from a run that was
    /// aborted.
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

    /// Writes the last line, and returns what the lines were written to.
    ///
    /// # Errors
    /// If it can't be written.
    pub fn end(mut self, summary: Summary) -> io::Result<W> {
        self.line(&Line::Summary(summary))?;
        self.out.flush()?;
        Ok(self.out)
    }

    fn line(&mut self, line: &Line) -> io::Result<()> {
        serde_json::to_writer(&mut self.out, line)?;
        self.out.write_all(b"\n")
    }
}
