//! A record of every line exchanged with an adapter.

use std::io::{self, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::legible::legible;

/// The limit of a line, in characters. A stream of 65,535 bytes in chunks of one byte is shorter.
const LONGEST_LINE: usize = 400_000;

/// A trace; its clones write to the same place.
#[derive(Clone)]
pub struct Trace {
    out: Arc<Mutex<Output>>,
}

struct Output {
    writer: Box<dyn Write + Send>,
    /// The first error. After it nothing more is written.
    error: Option<io::Error>,
}

impl Trace {
    /// A trace that goes to `writer`.
    #[must_use]
    pub fn new(writer: Box<dyn Write + Send>) -> Self {
        Self { out: Arc::new(Mutex::new(Output { writer, error: None })) }
    }

    /// Writes the buffered lines.
    ///
    /// # Errors
    /// The first error of any write.
    pub fn finish(&self) -> io::Result<()> {
        let mut out = self.lock();
        match out.error.take() {
            Some(error) => Err(error),
            None => out.writer.flush(),
        }
    }

    /// Records a line of the adapter process number `process`, as far as it is not longer than any
    /// that makes sense. The mark is `>` for a line to the adapter, `<` for a line from it, and `!`
    /// for an event such as its end.
    pub(super) fn note(&self, process: u32, mark: char, line: &[u8]) {
        let mut out = self.lock();
        if out.error.is_none() {
            let line = legible(&String::from_utf8_lossy(line), LONGEST_LINE);
            out.error = writeln!(out.writer, "{process}{mark} {line}").err();
        }
    }

    fn lock(&self) -> MutexGuard<'_, Output> {
        self.out.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl std::fmt::Debug for Trace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Trace")
    }
}
