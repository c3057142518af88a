//! The command line: a file for each subcommand, with its options and what it does.

pub(crate) mod adapter;
#[cfg(unix)]
pub(crate) mod bus;
pub(crate) mod codec;
pub(crate) mod completions;
pub(crate) mod decode;
#[cfg(unix)]
pub(crate) mod device;
pub(crate) mod encode;
pub(crate) mod fuzz;
#[cfg(unix)]
pub(crate) mod host;
pub(crate) mod list;
pub(crate) mod man;
#[cfg(not(unix))]
pub(crate) mod missing;
pub(crate) mod replay;
pub(crate) mod report;
#[cfg(unix)]
pub(crate) mod scan;
#[cfg_attr(not(unix), expect(dead_code, reason = "some of it is for subcommands that are missing"))]
mod shared;
pub(crate) mod show;
pub(crate) mod spec;

use clap::{CommandFactory as _, Parser, Subcommand};

#[cfg(not(unix))]
pub(crate) use missing::{self as bus, self as device, self as host, self as scan};
pub(crate) use shared::Failure;

/// Checks implementations of robot actuators' protocols against the documents.
#[derive(Debug, Parser)]
#[command(version, after_help = format!("{EXIT}, {ENDED}"))]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The exit statuses of what runs checks.
const EXIT: &str = "Exit status: 0 all passed, 1 something failed, was flaky, crashed or gave no answer \
    in time, 2 wrong usage, 3 something could not be run or written, or the adapter itself is at fault, \
    4 the adapter could not be started";
/// One more, of whatever Ctrl-C ends.
const ENDED: &str = "130 another Ctrl-C ended it, a second after the first.";
/// The exit statuses of what only writes.
const WRITTEN: &str = "Exit status: 0 written, 2 wrong usage, 3 the output could not be written.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Codec(codec::Codec),
    Host(host::Host),
    Device(device::Device),
    Scan(scan::Scan),
    Fuzz(fuzz::Fuzz),
    Decode(decode::Decode),
    Encode(encode::Encode),
    Bus(bus::Bus),
    List(list::List),
    Show(show::Show),
    Replay(replay::Replay),
    #[command(subcommand)]
    Adapter(adapter::Adapter),
    #[command(subcommand)]
    Report(report::Report),
    #[command(subcommand)]
    Spec(spec::Spec),
    Completions(completions::Completions),
    Man(man::Manual),
}

/// The subcommand at the beginning of these arguments, such as `actucheck spec diff`.
pub(crate) fn named(arguments: impl Iterator<Item = String>) -> String {
    let mut name = "actucheck".to_owned();
    let mut command = Cli::command();
    for argument in arguments {
        let Some(subcommand) = command.find_subcommand(&argument) else { break };
        name = format!("{name} {argument}");
        command = subcommand.clone();
    }
    name
}
