//! `actucheck completions`.

use std::process::ExitCode;

use clap::{Args, CommandFactory as _};
use clap_complete::Shell;

use super::Cli;
use super::WRITTEN;
use super::shared::{self, Failure};

const EXAMPLES: &str = "\
Example:
  actucheck completions bash > ~/.local/share/bash-completion/completions/actucheck";

/// Prints a shell's completion script
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the completion script of a shell.
pub(crate) fn run(options: &Completions) -> Result<ExitCode, Failure> {
    // clap panics where it can't write, so it writes to memory.
    let mut script = Vec::new();
    clap_complete::generate(options.shell, &mut Cli::command(), "actucheck", &mut script);
    shared::print(script)?;
    Ok(ExitCode::SUCCESS)
}
