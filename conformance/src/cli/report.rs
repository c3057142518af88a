//! `--report`, and `actucheck report …`.

use std::path::{Path, PathBuf};

use actucheck::report::Format;
use clap::{Args, Subcommand};

/// The reports to be written.
#[derive(Debug, Args)]
pub(crate) struct Reports {
    /// Write a report: text, json, junit, markdown or html; `-` is standard output; may be given
    /// more than once
    #[arg(long = "report", value_name = "FORMAT=PATH", value_parser = target)]
    pub(crate) targets: Vec<Target>,
}

/// A report to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Target {
    pub(crate) format: Format,
    pub(crate) path: PathBuf,
}

impl Target {
    /// Whether it goes to standard output.
    pub(crate) fn is_stdout(&self) -> bool {
        self.path == Path::new("-")
    }
}

#[derive(Debug, Subcommand)]
pub(crate) enum Report {
    /// Shows which implementation gets what wrong
    #[command(after_help = COMPARE_EXAMPLES)]
    Compare(Compare),
    /// Writes a report in other formats
    #[command(after_help = RENDER_EXAMPLES)]
    Render(Render),
}

const COMPARE_EXAMPLES: &str = "\
Examples:
  actucheck codec --report json=ours.json
  actucheck codec --report json=theirs.json -- ./their-adapter
  actucheck report compare ours.json theirs.json
  actucheck report compare *.json --report html=matrix.html

Exit status: 0 compared, 2 wrong usage.";

const RENDER_EXAMPLES: &str = "\
Examples:
  actucheck report render report.json
      as `actucheck codec` printed it
  actucheck report render report.json --report html=report.html --report markdown=-

Exit status: 0 written, 2 wrong usage.";

#[derive(Debug, Args)]
pub(crate) struct Compare {
    /// A report, as `--report json=FILE` writes it
    #[arg(value_name = "REPORT")]
    pub(crate) first: PathBuf,
    /// Reports of the same wire
    #[arg(required = true, value_name = "REPORT")]
    pub(crate) others: Vec<PathBuf>,
    #[command(flatten)]
    pub(crate) reports: Reports,
}

#[derive(Debug, Args)]
pub(crate) struct Render {
    /// A report, as `--report json=FILE` writes it
    #[arg(value_name = "REPORT")]
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) reports: Reports,
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
