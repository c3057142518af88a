//! `actucheck completions`.

use std::io;
use std::process::ExitCode;

use clap::{Args, CommandFactory as _};
use clap_complete::Shell;

use super::Cli;

const EXAMPLE: &str = "\
Example:
  actucheck completions bash > ~/.local/share/bash-completion/completions/actucheck";

/// Prints a shell's completion script
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the completion script of a shell.
pub(crate) fn run(options: &Completions) -> ExitCode {
    let mut command = Cli::command();
    clap_complete::generate(options.shell, &mut command, "actucheck", &mut io::stdout());
    ExitCode::SUCCESS
}
