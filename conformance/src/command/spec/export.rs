//! `actucheck spec export`.

use std::path::PathBuf;

use actucheck_spec::{Spec, export};
use clap::{Args, ValueEnum};

use crate::command::WRITTEN;
use crate::command::shared::{Failure, Target, print};

const EXAMPLES: &str = "\
Examples:
  actucheck spec export vectors --output vectors.json
  actucheck spec export c-header > actucheck.h
  actucheck spec export wireshark --output ~/.local/lib/wireshark/plugins/actucheck.lua";

/// Writes the spec for programs, compilers or readers
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Export {
    /// What to write
    #[arg(value_enum)]
    format: Format,
    /// Where to write it; standard output if it is not given, or `-`
    #[arg(long, value_name = "PATH")]
    output: Option<PathBuf>,
}

/// The formats of an export.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Wires, devices and errata as one JSON file
    Json,
    /// Test vectors as one JSON file
    Vectors,
    /// Codes, numbers, addresses and ranges in C99
    CHeader,
    /// Control tables, instructions and commands as tables to read
    Markdown,
    /// A dissector for Wireshark and tshark in Lua, for all wires
    Wireshark,
}

/// Writes the export to the file, or to standard output.
pub(super) fn run(spec: &Spec, options: &Export) -> Result<(), Failure> {
    let text = match options.format {
        Format::Json => export::json::export(spec),
        Format::Vectors => export::vectors::export(spec),
        Format::CHeader => export::c_header::export(spec),
        Format::Markdown => Ok(export::markdown::export(spec)),
        Format::Wireshark => Ok(export::wireshark::export(spec)),
    }
    .map_err(Failure::incomplete)?;
    match &options.output {
        Some(path) => Target::new(path)?.write(text.as_bytes()),
        None => print(&text),
    }
}
