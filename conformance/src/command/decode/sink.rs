//! Where the events of a stream go.

use std::io::{self, Write};

use actucheck::adapter::Wire;
use actucheck::capture::Form;
use actucheck::explain::stream::lines::Line;
use actucheck::explain::stream::{Event, Summary};

use super::super::shared::{self, Failure};
use super::Show;

/// Writes a stream.
pub(super) trait Sink {
    fn begin(&mut self, form: Form) -> io::Result<()>;
    fn event(&mut self, event: &Event<'_>) -> io::Result<()>;
    fn note(&mut self, at: u64, note: &str) -> io::Result<()>;
    fn end(&mut self, summary: &Summary) -> io::Result<()>;
}

/// Writes a stream for programs: an object on each line.
pub(super) struct Lines<W> {
    pub(super) out: W,
    pub(super) wire: Wire,
    pub(super) show: Show,
}

impl<W: Write> Lines<W> {
    fn line(&mut self, line: &Line) -> io::Result<()> {
        serde_json::to_writer(&mut self.out, line)?;
        self.out.write_all(b"\n")
    }
}

impl<W: Write> Sink for Lines<W> {
    fn begin(&mut self, form: Form) -> io::Result<()> {
        self.line(&Line::header(self.wire, form))
    }

    fn event(&mut self, event: &Event<'_>) -> io::Result<()> {
        match self.show {
            Show::Summary => Ok(()),
            show => self.line(&Line::of(self.wire, event, show == Show::Fields)),
        }
    }

    fn note(&mut self, at: u64, note: &str) -> io::Result<()> {
        self.line(&Line::Note { at, note: note.to_owned() })
    }

    fn end(&mut self, summary: &Summary) -> io::Result<()> {
        self.line(&Line::summary(summary))?;
        self.out.flush()
    }
}

/// A sink that takes no more after an error, and the summary of what it was told.
pub(super) struct Told {
    pub(super) sink: Box<dyn Sink>,
    pub(super) summary: Summary,
    pub(super) written: io::Result<()>,
}

impl Told {
    pub(super) fn write(&mut self, write: impl FnOnce(&mut dyn Sink) -> io::Result<()>) {
        if self.written.is_ok() {
            self.written = write(&mut *self.sink);
        }
    }

    pub(super) fn event(&mut self, event: &Event<'_>) {
        self.summary.add(event);
        self.write(|sink| sink.event(event));
    }

    pub(super) fn end(mut self) -> Result<Summary, Failure> {
        let summary = std::mem::take(&mut self.summary);
        self.write(|sink| sink.end(&summary));
        shared::seen("the packets", self.written)?;
        Ok(summary)
    }
}
