//! `actucheck spec …`.

use std::path::PathBuf;

use clap::{Args, Subcommand, ValueEnum};

#[derive(Debug, Subcommand)]
pub(crate) enum Spec {
    /// Compares the control tables of two devices
    #[command(after_help = DIFF_EXAMPLE)]
    Diff(Diff),
    /// Lists what the documents get wrong or leave open, with the evidence
    #[command(after_help = ERRATA_EXAMPLE)]
    Errata(Errata),
    /// Tells for every requirement of the documents what checks it
    #[command(after_help = COVERAGE_EXAMPLE)]
    Coverage(Coverage),
    /// Writes the spec for programs, compilers or readers
    #[command(after_help = EXPORT_EXAMPLE)]
    Export(Export),
}

const DIFF_EXAMPLE: &str = "\
Example:
  actucheck spec diff ja40 ja-variant

Exit status: 0 compared, 2 wrong usage.";

const ERRATA_EXAMPLE: &str = "\
Examples:
  actucheck spec errata --document ja40 --status open
  actucheck spec errata --json > errata.json";

const COVERAGE_EXAMPLE: &str = "\
Example:
  actucheck spec coverage --document dynamixel2 --role codec --uncovered
      what the DYNAMIXEL document demands of a codec and nothing checks yet";

const EXPORT_EXAMPLE: &str = "\
Examples:
  actucheck spec export vectors --output vectors.json
  actucheck spec export c-header > actucheck.h";

#[derive(Debug, Args)]
pub(crate) struct Diff {
    /// The first device
    #[arg(value_name = "DEVICE")]
    pub(crate) left: String,
    /// The second device
    #[arg(value_name = "DEVICE")]
    pub(crate) right: String,
}

#[derive(Debug, Args)]
pub(crate) struct Errata {
    /// Only those of this document
    #[arg(long, value_name = "DOCUMENT")]
    pub(crate) document: Option<String>,
    /// Only those with this status
    #[arg(long, value_enum)]
    pub(crate) status: Option<Status>,
    /// Print them as JSON
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Coverage {
    /// Only the requirements of this document
    #[arg(long, value_name = "DOCUMENT")]
    pub(crate) document: Option<String>,
    /// Only the requirements that bind this role
    #[arg(long, value_enum)]
    pub(crate) role: Option<Role>,
    /// Only the requirements that nothing checks yet
    #[arg(long)]
    pub(crate) uncovered: bool,
}

#[derive(Debug, Args)]
pub(crate) struct Export {
    /// What to write
    #[arg(value_enum)]
    pub(crate) format: Format,
    /// Where to write it; standard output if it is not given
    #[arg(long, value_name = "PATH")]
    pub(crate) output: Option<PathBuf>,
}

/// How sure the right reading of an erratum is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Status {
    /// One reading is provably right
    Resolved,
    /// A reading was picked
    Chosen,
    /// More than one reading stands
    Open,
}

/// Whom a requirement binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Role {
    /// Whoever builds or reads packets
    Codec,
    /// Whoever sends instructions
    Host,
    /// The actuator
    Device,
}

/// What the spec is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// Protocols, devices and errata as one JSON file
    Json,
    /// Golden packets as one JSON file
    Vectors,
    /// Codes, numbers, addresses and ranges in C99
    CHeader,
    /// Control tables, instructions and commands as tables to read
    Markdown,
}
