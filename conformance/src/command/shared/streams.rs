//! Reports that are written during a run.

use std::io;

use actucheck::report::jsonl::Stream;
use actucheck::report::model::{Header, Summary};
use actucheck::report::{Format, Run};
use actucheck::verdict::Outcome;

use super::outputs::{Outputs, both};
use super::target::seen;
use super::{Draft, Failure};

/// The `jsonl` reports of a run. An error in writing one does not end the run.
pub(crate) struct Streams(Vec<Open>);

/// The name of a report, and its stream or the error that ended it.
type Open = (String, io::Result<Stream<Draft>>);

impl Streams {
    /// Writes the headers.
    pub(crate) fn begin(outputs: &mut Outputs, header: &Header) -> Self {
        let drafts = outputs.take(Format::Jsonl).into_iter();
        let begin = |draft| Stream::begin(draft, header.clone());
        Self(drafts.map(|(name, draft)| (name, draft.and_then(begin))).collect())
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
        let end = |stream: Stream<Draft>| stream.end(summary.clone())?.finish();
        let ended = self.0.into_iter().map(|(name, stream)| seen(&name, stream.and_then(end)));
        ended.fold(Ok(()), both)
    }
}
