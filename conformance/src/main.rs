//! The command line: `actucheck codec`, `actucheck decode`, `actucheck spec`.

#![forbid(unsafe_code)]

mod cli;
mod commands;

use std::process::ExitCode;

use clap::Parser;
use clap::error::ErrorKind;

use cli::{Cli, Command};
use commands::Failure;

fn main() -> ExitCode {
    run().unwrap_or_else(|failure| {
        anstream::eprintln!("actucheck: {failure}");
        ExitCode::from(failure.status)
    })
}

fn run() -> Result<ExitCode, Failure> {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(answer)
            if matches!(answer.kind(), ErrorKind::DisplayHelp | ErrorKind::DisplayVersion) =>
        {
            // A reader that has seen enough is no failure.
            let _ = answer.print();
            return Ok(ExitCode::SUCCESS);
        }
        Err(error) => return Err(usage(&error)),
    };
    match cli.command {
        Command::Codec(options) => commands::codec::run(&options),
        Command::Fuzz(options) => commands::fuzz::run(&options),
        Command::Decode(options) => commands::decode::run(&options),
        Command::List(options) => commands::list::run(&options),
        Command::Show(options) => commands::show::run(&options),
        Command::Replay(options) => commands::replay::run(&options),
        Command::Adapter(command) => commands::adapter::run(&command),
        Command::Report(command) => commands::report::run(&command),
        Command::Spec(command) => commands::spec::run(&command),
        Command::Completions(options) => {
            commands::completions::run(&options);
            Ok(ExitCode::SUCCESS)
        }
    }
}

/// What clap says, on one line.
fn usage(error: &clap::Error) -> Failure {
    if error.kind() == ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
        let message = "no command; `--help` behind it lists them";
        return Failure::new(Failure::USAGE, message);
    }
    let text = error.to_string();
    let more = ["Usage:", "tip:", "For more information"];
    let lines = text.lines().map(str::trim);
    let words: Vec<_> = lines
        .take_while(|line| !more.iter().any(|start| line.starts_with(start)))
        .filter(|line| !line.is_empty())
        .collect();
    let sentence = words.join(" ");
    let sentence = sentence.strip_prefix("error: ").unwrap_or(&sentence);
    Failure::new(Failure::USAGE, format!("{sentence} (see `actucheck --help`)"))
}
