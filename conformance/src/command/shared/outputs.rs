//! Where reports go.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use actucheck::report::Format;
use clap::Args;

use super::target::{Target, seen};
use super::{Draft, Failure};

/// The reports to write.
#[derive(Debug, Args)]
pub(crate) struct Reports {
    /// Write a report: text, json, junit, tap, github (annotations of a job), badge, markdown or html,
    /// or jsonl for every outcome as it comes; `-` is standard output; may be given more than once. A file keeps its old content until the
    /// report is whole; `text+=PATH` and `markdown+=PATH` add to it
    #[arg(long = "report", value_name = "FORMAT=PATH", value_parser = place)]
    places: Vec<Place>,
}

impl Reports {
    /// The format of each.
    pub(crate) fn formats(&self) -> impl Iterator<Item = Format> {
        self.places.iter().map(|place| place.format)
    }
}

/// A report to write.
#[derive(Clone, Debug)]
struct Place {
    format: Format,
    path: PathBuf,
    appends: bool,
}

fn place(text: &str) -> Result<Place, String> {
    let parse = || {
        let (name, path) = text.split_once('=')?;
        let (name, appends) = name.strip_suffix('+').map_or((name, false), |name| (name, true));
        let format = Format::ALL.into_iter().find(|format| format.name() == name)?;
        (!path.is_empty()).then(|| Place { format, path: path.into(), appends })
    };
    let place = parse().ok_or_else(|| {
        let formats = Format::ALL.map(Format::name).join(", ");
        format!("a report is written as FORMAT=PATH; formats are {formats}")
    })?;
    if place.appends && !matches!(place.format, Format::Text | Format::Markdown) {
        let format = place.format.name();
        return Err(format!("only text and markdown can be added to a file; write {format}=PATH"));
    }
    Ok(place)
}

/// Reports that can be written, and the text on the terminal.
pub(crate) struct Outputs {
    files: Vec<Output>,
    terminal: Terminal,
}

/// A report that can be written.
struct Output {
    format: Format,
    target: Target,
}

/// Where the text report goes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Terminal {
    Stdout,
    /// Used if a report for programs goes to standard output.
    Stderr,
}

impl Outputs {
    /// Finds out whether the reports can be written, and that each file is written once. `others`
    /// are the files that the command writes besides.
    pub(crate) fn open<'a>(
        reports: &'a Reports,
        others: impl IntoIterator<Item = &'a Path>,
    ) -> Result<Self, Failure> {
        let paths = reports.places.iter().map(|place| place.path.as_path());
        Target::all_differ(paths.chain(others))?;
        let mut files = Vec::new();
        for Place { format, path, appends } in &reports.places {
            let target = if *appends { Target::appending(path) } else { Target::new(path) }?;
            files.push(Output { format: *format, target });
        }
        // The text goes to standard output anyway.
        files.retain(|file| !(file.target.is_stdout() && file.format == Format::Text));
        let is_taken = files.iter().any(|file| file.target.is_stdout());
        let terminal = if is_taken { Terminal::Stderr } else { Terminal::Stdout };
        Ok(Self { files, terminal })
    }

    /// Takes out the reports of one format, each with its name.
    pub(super) fn take(&mut self, format: Format) -> Vec<(String, io::Result<Draft>)> {
        let own = self.files.extract_if(.., |file| file.format == format);
        own.map(|file| (file.target.name.clone(), file.target.begin())).collect()
    }

    /// Hands on what a run needs before its first check. If that failed, the reports of earlier
    /// runs stay, but those that CI servers read get an error.
    pub(crate) fn unless_failed<T>(self, start: Result<T, Failure>) -> Result<(Self, T), Failure> {
        let failure = match start {
            Ok(started) => return Ok((self, started)),
            Err(failure) => failure,
        };
        let sentence = failure.to_string();
        let written = self.files.into_iter().filter_map(|Output { format, target }| {
            let text = format.not_started(&sentence)?.map_err(Failure::incomplete);
            Some(text.and_then(|text| target.write(&text)))
        });
        let problems: Vec<_> = written.filter_map(Result::err).collect();
        Err(problems.iter().fold(failure, Failure::and))
    }

    /// Writes every report with `report`, whether or not another can be written, and the text on
    /// the terminal, which may have colours, with `text`.
    pub(crate) fn write(
        self,
        report: impl Fn(Format, &mut dyn Write) -> io::Result<()>,
        text: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let mut result = Ok(());
        for Output { format, target } in self.files {
            let name = target.name.clone();
            let write = |mut draft: Draft| report(format, &mut draft).and_then(|()| draft.finish());
            result = both(result, seen(&name, target.begin().and_then(write)));
        }
        let written = match self.terminal {
            Terminal::Stdout => text(&mut anstream::stdout()),
            Terminal::Stderr => text(&mut anstream::stderr()),
        };
        both(result, seen("the report", written))
    }
}

/// Both failures in one, if there are two.
pub(crate) fn both(first: Result<(), Failure>, second: Result<(), Failure>) -> Result<(), Failure> {
    match (first, second) {
        (Err(first), Err(second)) => Err(first.and(&second)),
        (first, second) => first.and(second),
    }
}
