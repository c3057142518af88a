//! Options of `actucheck adapter`.

use clap::{Args, Subcommand};

use super::Exchange;

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Prints an adapter to start from, which skips everything
    #[command(after_help = TEMPLATE_EXAMPLES)]
    Template(Template),
    /// Checks an adapter, point by point, before what it says of a library counts
    #[command(after_help = CHECK_EXAMPLES)]
    Check(Check),
}

const TEMPLATE_EXAMPLES: &str = "\
Examples:
  actucheck adapter template python > adapter.py
  actucheck adapter template c > adapter.c";

const CHECK_EXAMPLES: &str = "\
Examples:
  actucheck adapter check -- python3 adapter.py
  actucheck adapter check --start-timeout 60 -- ./run

Exit status: 0 all is well, 1 something is wrong, 2 wrong usage, 4 the adapter could not be started.";

#[derive(Debug, Args)]
pub(crate) struct Template {
    /// The language that it is written in
    #[arg(value_enum)]
    pub(crate) language: Language,
}

/// A language that there is a template in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Language {
    /// Python 3, without further packages
    Python,
    /// C99, without further libraries
    C,
}

#[derive(Debug, Args)]
pub(crate) struct Check {
    #[command(flatten)]
    pub(crate) exchange: Exchange,
    /// The adapter's command with its arguments
    #[arg(last = true, required = true, value_name = "COMMAND")]
    pub(crate) command: Vec<String>,
}
