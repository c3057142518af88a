//! The command line: `actucheck codec`, `actucheck decode`.

#![forbid(unsafe_code)]

mod cli;
mod commands;

use std::process::ExitCode;

use clap::Parser;

use cli::{Cli, Command};

fn main() -> ExitCode {
    let cli = Cli::parse();
    let outcome = match cli.command {
        Command::Codec(options) => commands::codec::run(&options),
        Command::Decode(options) => commands::decode::run(&options),
        Command::Completions(options) => {
            commands::completions::run(&options);
            Ok(ExitCode::SUCCESS)
        }
    };
    outcome.unwrap_or_else(|failure| {
        anstream::eprintln!("actucheck: {failure}");
        ExitCode::from(failure.status)
    })
}
