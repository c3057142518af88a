//! Where reports go.

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use actucheck::report::Format;
use clap::Args;

use super::Failure;

/// The reports to write.
#[derive(Debug, Args)]
pub(crate) struct Reports {
    /// Write a report: text, json, junit, markdown or html, or jsonl for every outcome as it comes;
    /// `-` is standard output; may be given more than once
    #[arg(long = "report", value_name = "FORMAT=PATH", value_parser = target)]
    targets: Vec<Target>,
}

impl Reports {
    /// Whether one of them has this format.
    pub(crate) fn any(&self, format: Format) -> bool {
        self.targets.iter().any(|target| target.format == format)
    }
}

/// A report to write.
#[derive(Clone, Debug)]
struct Target {
    format: Format,
    path: PathBuf,
}

impl Target {
    fn is_stdout(&self) -> bool {
        self.path == Path::new("-")
    }
}

fn target(text: &str) -> Result<Target, String> {
    let parse = || {
        let (name, path) = text.split_once('=')?;
        let format = Format::ALL.into_iter().find(|format| format.name() == name)?;
        (!path.is_empty()).then(|| Target { format, path: path.into() })
    };
    parse().ok_or_else(|| {
        let formats = Format::ALL.map(Format::name).join(", ");
        format!("a report is written as FORMAT=PATH; formats are {formats}")
    })
}

/// Reports that are open for writing, and the text on the terminal.
pub(crate) struct Outputs {
    files: Vec<Output>,
    terminal: Terminal,
}

/// A report that is open for writing.
pub(crate) struct Output {
    format: Format,
    pub(crate) name: String,
    pub(crate) file: Box<dyn Write + Send>,
}

/// Where the text report goes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Terminal {
    Stdout,
    /// Used if a report for programs goes to standard output.
    Stderr,
}

impl Outputs {
    /// Opens the reports before the run, so that a wrong path is reported at once.
    pub(crate) fn open(reports: &Reports) -> Result<Self, Failure> {
        let mut outputs = Self { files: Vec::new(), terminal: Terminal::Stdout };
        for (index, target) in reports.targets.iter().enumerate() {
            let name = target.path.display().to_string();
            let others = reports.targets.iter().take(index);
            if others.map(|other| &other.path).any(|path| *path == target.path) {
                let message = format!("two reports go to {name}; give each a path of its own");
                return Err(Failure::usage(message));
            }
            if target.is_stdout() && target.format == Format::Text {
                continue; // It goes there anyway.
            }
            let file = outputs
                .file(target)
                .map_err(|error| Failure::usage(format!("cannot write {name}: {error}")))?;
            outputs.files.push(Output { format: target.format, name, file });
        }
        Ok(outputs)
    }

    fn file(&mut self, target: &Target) -> io::Result<Box<dyn Write + Send>> {
        if target.is_stdout() {
            self.terminal = Terminal::Stderr;
            return Ok(Box::new(io::BufWriter::new(io::stdout())));
        }
        Ok(Box::new(io::BufWriter::new(File::create(&target.path)?)))
    }

    /// Takes out the reports of one format.
    pub(crate) fn take(&mut self, format: Format) -> Vec<Output> {
        self.files.extract_if(.., |file| file.format == format).collect()
    }

    /// Writes every report with `report`, whether or not another can be written, and the text on the terminal, which may have colours,
    /// with `text`.
    pub(crate) fn write(
        self,
        report: impl Fn(Format, &mut dyn Write) -> io::Result<()>,
        text: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let mut result = Ok(());
        for Output { format, name, mut file } in self.files {
            let written = report(format, &mut file).and_then(|()| file.flush());
            result = result.and(seen(&name, written));
        }
        let written = match self.terminal {
            Terminal::Stdout => text(&mut anstream::stdout()),
            Terminal::Stderr => text(&mut anstream::stderr()),
        };
        result.and(seen("the report", written))
    }
}

/// A closed pipe, as of `| head`, is not an error.
pub(super) fn seen(name: &str, written: io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            let message = format!("cannot write {name}: {error}");
            Err(Failure::incomplete(message))
        }
        _ => Ok(()),
    }
}
