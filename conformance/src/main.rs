//! The program `actucheck`.

#![forbid(unsafe_code)]

mod command;

use std::process::ExitCode;

use clap::Parser as _;
use clap::error::ErrorKind;

use command::{Cli, Command, Failure};

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
        Err(error) => {
            let arguments = std::env::args_os().skip(1);
            let texts = arguments.map_while(|argument| argument.into_string().ok());
            return Err(Failure::parse(&error, &command::named(texts)));
        }
    };
    match &cli.command {
        Command::Codec(options) => command::codec::run(options),
        Command::Host(options) => command::host::run(options),
        Command::Device(options) => command::device::run(options),
        Command::Scan(options) => command::scan::run(options),
        Command::Fuzz(options) => command::fuzz::run(options),
        Command::Decode(options) => command::decode::run(options),
        Command::Encode(options) => command::encode::run(options),
        Command::Bus(options) => command::bus::run(options),
        Command::List(options) => command::list::run(options),
        Command::Show(options) => command::show::run(options),
        Command::Replay(options) => command::replay::run(options),
        Command::Adapter(subcommand) => command::adapter::run(subcommand),
        Command::Report(subcommand) => command::report::run(subcommand),
        Command::Spec(subcommand) => command::spec::run(subcommand),
        Command::Completions(options) => command::completions::run(options),
        Command::Man(options) => command::man::run(options),
    }
}
