//! Where the events of a stream go.

use std::io::{self, Write};

use actucheck::adapter::Wire;
use actucheck::capture::Form;
use actucheck::explain::stream::lines::Line;
use actucheck::explain::stream::{Event, Summary};

use super::super::{Failure, seen};
use super::Show;

/// Writes a stream.
pub(crate) trait Sink {
    /// The beginning of what was read in a form, or of what passes on a line.
    fn begin(&mut self, form: Option<Form>) -> io::Result<()>;
    /// A port of the line, and the link that leads to it.
    fn port(&mut self, kind: &'static str, address: &str, link: Option<&str>) -> io::Result<()>;
    fn event(&mut self, event: &Event<'_>) -> io::Result<()>;
    fn note(&mut self, at: u64, note: &str) -> io::Result<()>;
    fn end(&mut self, summary: &Summary) -> io::Result<()>;
    fn flush(&mut self) -> io::Result<()>;
}

/// Writes a stream for programs: an object on each line.
pub(crate) struct Lines<W> {
    pub(crate) out: W,
    pub(crate) wire: Wire,
    pub(crate) show: Show,
}

impl<W: Write> Lines<W> {
    fn line(&mut self, line: &Line) -> io::Result<()> {
        serde_json::to_writer(&mut self.out, line)?;
        self.out.write_all(b"\n")
    }
}

impl<W: Write> Sink for Lines<W> {
    fn begin(&mut self, form: Option<Form>) -> io::Result<()> {
        self.line(&Line::header(self.wire, form))
    }

    fn port(&mut self, kind: &'static str, address: &str, link: Option<&str>) -> io::Result<()> {
        let (address, link) = (address.to_owned(), link.map(str::to_owned));
        self.line(&Line::Port { kind, address, link })
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

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// A sink that takes no more after an error, and the summary of what it was told.
pub(crate) struct Told {
    pub(crate) sink: Box<dyn Sink>,
    pub(crate) summary: Summary,
    pub(crate) written: io::Result<()>,
}

impl Told {
    pub(crate) fn new(sink: Box<dyn Sink>) -> Self {
        Self { sink, summary: Summary::default(), written: Ok(()) }
    }

    pub(crate) fn write(&mut self, write: impl FnOnce(&mut dyn Sink) -> io::Result<()>) {
        if self.written.is_ok() {
            self.written = write(&mut *self.sink);
        }
    }

    pub(crate) fn event(&mut self, event: &Event<'_>) {
        self.summary.add(event);
        self.write(|sink| sink.event(event));
    }

    pub(crate) fn end(mut self) -> Result<Summary, Failure> {
        let summary = std::mem::take(&mut self.summary);
        self.write(|sink| sink.end(&summary));
        seen("the packets", self.written)?;
        Ok(summary)
    }
}
