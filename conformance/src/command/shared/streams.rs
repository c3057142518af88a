//! Reports that are written during a run.

use std::io::{self, Write};

use actucheck::report::jsonl::Stream;
use actucheck::report::model::{Header, Summary};
use actucheck::report::{Format, Run};
use actucheck::verdict::Outcome;

use super::Failure;
use super::outputs::{Output, Outputs, seen};

/// The `jsonl` reports of a run. An error in writing one does not end the run.
pub(crate) struct Streams(Vec<Open>);

/// The name of a report, and its stream or the error that ended it.
type Open = (String, io::Result<Stream<Box<dyn Write + Send>>>);

impl Streams {
    /// Writes the headers.
    pub(crate) fn begin(outputs: &mut Outputs, header: &Header) -> Self {
        let begin = |Output { name, file, .. }| (name, Stream::begin(file, header.clone()));
        Self(outputs.take(Format::Jsonl).into_iter().map(begin).collect())
    }

    /// Writes an outcome.
    pub(crate) fn check(&mut self, run: &Run<'_>, outcome: &Outcome) {
        for (_, stream) in &mut self.0 {
            if let Ok(open) = stream
                && let Err(error) = open.check(run.result(outcome.clone()))
            {
                *stream = Err(error);
            }
        }
    }

    /// Writes the summaries.
    pub(crate) fn end(self, summary: &Summary) -> Result<(), Failure> {
        for (name, stream) in self.0 {
            seen(&name, stream.and_then(|stream| stream.end(summary.clone())))?;
        }
        Ok(())
    }
}
