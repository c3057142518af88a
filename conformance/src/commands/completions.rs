//! `actucheck completions`.

use std::io;

use clap::CommandFactory as _;

use crate::cli::{Cli, Completions};

/// Prints the completion script of a shell.
pub(crate) fn run(options: &Completions) {
    let mut command = Cli::command();
    clap_complete::generate(options.shell, &mut command, "actucheck", &mut io::stdout());
}
