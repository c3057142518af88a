//! Where reports go.

use std::fs::File;
use std::io::{self, Write};

use actucheck::report::Format;

use super::Failure;
use crate::cli::report::{Reports, Target};

/// Reports that are open for writing, and the text on the terminal.
pub(super) struct Outputs {
    files: Vec<(Format, String, Box<dyn Write>)>,
    terminal: Terminal,
}

/// Where the text for a person goes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Terminal {
    Stdout,
    /// Standard output has a report for programs.
    Stderr,
}

impl Outputs {
    /// Opens the reports before the work, so that a wrong path costs no time.
    pub(super) fn open(reports: &Reports) -> Result<Self, Failure> {
        let mut outputs = Self { files: Vec::new(), terminal: Terminal::Stdout };
        for (index, target) in reports.targets.iter().enumerate() {
            let name = target.path.display().to_string();
            let others = reports.targets.iter().take(index);
            if others.map(|other| &other.path).any(|path| *path == target.path) {
                let message = format!("two reports go to {name}; give each a path of its own");
                return Err(Failure::new(Failure::USAGE, message));
            }
            if target.is_stdout() && target.format == Format::Text {
                continue; // It goes there anyway.
            }
            let file = outputs.file(target).map_err(|error| {
                Failure::new(Failure::USAGE, format!("cannot write {name}: {error}"))
            })?;
            outputs.files.push((target.format, name, file));
        }
        Ok(outputs)
    }

    fn file(&mut self, target: &Target) -> io::Result<Box<dyn Write>> {
        if target.is_stdout() {
            self.terminal = Terminal::Stderr;
            return Ok(Box::new(io::BufWriter::new(io::stdout())));
        }
        Ok(Box::new(io::BufWriter::new(File::create(&target.path)?)))
    }

    /// Writes every report with `report`, and the text for a person, which may have colours, with
    /// `text`.
    pub(super) fn write(
        self,
        report: impl Fn(Format, &mut dyn Write) -> io::Result<()>,
        text: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        for (format, name, mut file) in self.files {
            let written = report(format, &mut file).and_then(|()| file.flush());
            seen(&name, written)?;
        }
        let written = match self.terminal {
            Terminal::Stdout => text(&mut anstream::stdout()),
            Terminal::Stderr => text(&mut anstream::stderr()),
        };
        seen("the report", written)
    }
}

/// A reader that has seen enough is no failure.
fn seen(name: &str, written: io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            let message = format!("cannot write {name}: {error}");
            Err(Failure::new(Failure::INCOMPLETE, message))
        }
        _ => Ok(()),
    }
}
