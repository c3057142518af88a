//! `actucheck man`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Args, CommandFactory as _};
use clap_mangen::Man;

use super::Cli;
use super::WRITTEN;
use super::shared::{self, Failure};

const EXAMPLES: &str = "\
Examples:
  actucheck man | man -l -
      read the page of the program
  actucheck man --out ~/.local/share/man/man1
      write a page for the program and each subcommand, for `man actucheck-codec`";

/// Prints the manual page, or writes those of all subcommands
#[derive(Debug, Args)]
#[command(after_help = format!("{EXAMPLES}\n\n{WRITTEN}"))]
pub(crate) struct Manual {
    /// An existing folder, for a page of the program and one of each subcommand
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
}

/// Prints the program's page, or writes all pages into a folder.
pub(crate) fn run(options: &Manual) -> Result<ExitCode, Failure> {
    // `help` has no page.
    let mut program = Cli::command().disable_help_subcommand(true);
    program = program.mut_subcommands(|subcommand| subcommand.disable_help_subcommand(true));
    // The pages of subcommands have the program's name before their own.
    program.build();
    match &options.out {
        None => shared::print(page(&program)?)?,
        Some(folder) => write(folder, &program)?,
    }
    Ok(ExitCode::SUCCESS)
}

/// Writes the page of a command and those of its subcommands.
fn write(folder: &Path, command: &clap::Command) -> Result<(), Failure> {
    for subcommand in command.get_subcommands() {
        write(folder, subcommand)?;
    }
    let path = folder.join(format!("{}.1", name(command)));
    let text = page(command)?;
    fs::write(&path, text)
        .map_err(|error| Failure::incomplete(format!("cannot write {}: {error}", path.display())))
}

/// A page in the language of `man`.
fn page(command: &clap::Command) -> Result<Vec<u8>, Failure> {
    let mut text = Vec::new();
    let man = Man::new(command.clone()).title(name(command));
    let man = man.source(concat!("actucheck ", env!("CARGO_PKG_VERSION")));
    man.render(&mut text).map_err(Failure::incomplete)?;
    Ok(text)
}

/// The name of a command's page, such as `actucheck-spec-diff`.
fn name(command: &clap::Command) -> String {
    command.get_bin_name().unwrap_or("actucheck").replace(' ', "-")
}
