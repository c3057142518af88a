//! Subcommands and options.

pub(crate) mod adapter;
pub(crate) mod report;
pub(crate) mod spec;

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

use actucheck::adapter::{Fast, Wire};
use actucheck::suite::Options;
use clap::{Args, Parser, Subcommand};

/// Checks implementations of robot actuators' protocols against the documents.
#[derive(Debug, Parser)]
#[command(version, after_help = EXIT)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXIT: &str = "Exit status: 0 all passed, 1 something failed, 2 wrong usage, \
    3 something could not be run, 4 the adapter could not be started.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Checks a codec: the built-in one, or a library behind an adapter
    #[command(after_help = CODEC_EXAMPLES)]
    Codec(Codec),
    /// Looks for failures that no check foresees, and makes them small
    #[command(after_help = FUZZ_EXAMPLES)]
    Fuzz(Fuzz),
    /// Explains one packet field by field
    #[command(after_help = DECODE_EXAMPLES)]
    Decode(Decode),
    /// Lists the checks
    #[command(after_help = LIST_EXAMPLES)]
    List(List),
    /// Shows one check: what it asks, what it demands, and which sentence demands it
    Show(Show),
    /// Asks one check again and shows what was said
    #[command(after_help = REPLAY_EXAMPLES)]
    Replay(Replay),
    /// Starts, and checks, the adapter that puts a library behind the suite
    #[command(subcommand)]
    Adapter(adapter::Command),
    /// Compares the reports of several runs, or writes one in another format
    #[command(subcommand)]
    Report(report::Report),
    /// Shows, compares and exports what the documents say
    #[command(subcommand)]
    Spec(spec::Spec),
    /// Prints a shell's completion script
    Completions(Completions),
}

const CODEC_EXAMPLES: &str = "\
Examples:
  actucheck codec
      check the built-in codec
  actucheck codec -- python3 my_adapter.py
      check a library behind an adapter
  actucheck codec --select '*stuffing*' -- ./my-adapter
      only some checks
  actucheck codec --report html=report.html --report junit=report.xml -- ./my-adapter
      with a page to read and a file for what collects the results of tests
  actucheck codec --report json=- -- ./my-adapter | jq .totals
      everything, for a program
  actucheck codec --cases 20000 --body-length 7 --jobs 4 -- ./my-adapter
      more than half a million checks
  actucheck codec --jobs 4 --max-fail 10 -- ./my-adapter
      four adapters side by side, until something failed ten times

Ctrl-C ends a run early and reports what was found so far.

Exit status: 0 all passed, 1 something failed, 2 wrong usage, 3 something could not be run, \
4 the adapter could not be started.";

const FUZZ_EXAMPLES: &str = "\
Examples:
  actucheck fuzz -- python3 my_adapter.py
      for a minute, from another seed each time
  actucheck fuzz --seed 7 --cases 100000 -- ./my-adapter
      the same again, whatever the machine
  actucheck replay findings.yaml -- ./my-adapter
      what was found, asked again

Exit status: 0 nothing found, 1 something found, 2 wrong usage, 3 the adapter failed too often, \
4 the adapter could not be started.";

const DECODE_EXAMPLES: &str = "\
Examples:
  actucheck decode ff fffd 00 01 0300 01 194e
  actucheck decode --json 'FF FF FD 00 01 09 00 03 34 02 D0 07 00 00 1E C9'
  actucheck decode --address 580 fffffd00010800550 0946c0000f5af
      a status packet, whose data was read at address 580
  actucheck decode --fast 4:1,2 fffffd00fe11005500 01d0070000 0c83 00 02 09000000 1140
      the packet that answers a Fast Sync Read of 4 bytes from devices 1 and 2
  actucheck decode --wire innfos --kind request ee 06 0a 00 04 01 00 00 00 01 d8 ed

Exit status: 0 a valid packet, 1 no valid packet, 2 wrong usage.";

const LIST_EXAMPLES: &str = "\
Examples:
  actucheck list --select '*stuffing.body*' | head
  actucheck list --wire innfos --skip '*negative*'";

const REPLAY_EXAMPLES: &str = "\
Examples:
  actucheck replay dynamixel2.stuffing.goal-position/encode -- python3 my_adapter.py
  actucheck replay --seed 7 dynamixel2.seed-7.12.status/decode -- ./my-adapter
  actucheck replay findings.yaml -- ./my-adapter

Exit status: as `actucheck codec`.";

/// Which checks there are, and which of them are meant.
#[derive(Debug, Args)]
pub(crate) struct Selection {
    /// The wire whose checks are meant
    #[arg(long, value_enum, default_value = "dynamixel2")]
    pub(crate) wire: Wire,
    /// Only the checks whose id matches; may be given more than once
    #[arg(long, value_name = "GLOB")]
    pub(crate) select: Vec<String>,
    /// Not the checks whose id matches; may be given more than once
    #[arg(long, value_name = "GLOB")]
    pub(crate) skip: Vec<String>,
    /// Only the checks of requirements that bind at least so: `should` leaves out what may be
    #[arg(long, value_enum, default_value = "may")]
    pub(crate) level: Level,
    #[command(flatten)]
    pub(crate) growth: Growth,
}

/// How binding a requirement is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Level {
    /// Breaking it fails the run
    Must,
    /// Breaking it is a warning
    Should,
    /// Either way is right
    May,
}

/// What generated checks grow from.
#[derive(Clone, Copy, Debug, Args)]
pub(crate) struct Growth {
    /// What the generated checks grow from; the same seed yields the same checks
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u64,
    /// How many packets are generated
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub(crate) cases: u32,
    /// Bytes of the longest bodies of FF, FD, 00 and 01 that are all tried inside every kind of
    /// packet, 7 at most; a byte more means four times as many checks
    #[arg(long, value_name = "N", default_value_t = 4, value_parser = clap::value_parser!(u32).range(..=i64::from(Options::LONGEST_BODY)))]
    pub(crate) body_length: u32,
}

/// An adapter, or none.
#[derive(Debug, Args)]
pub(crate) struct Adapter {
    #[command(flatten)]
    pub(crate) exchange: Exchange,
    /// The adapter's command with its arguments; the built-in codec if there is none
    #[arg(last = true, value_name = "COMMAND")]
    pub(crate) command: Vec<String>,
}

/// How requests and replies are exchanged with an adapter.
#[derive(Debug, Args)]
pub(crate) struct Exchange {
    /// Seconds that the adapter may take for a request
    #[arg(long, value_name = "SECONDS", default_value = "1", value_parser = seconds)]
    pub(crate) timeout: Duration,
    /// Seconds that the adapter may take to start
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = seconds)]
    pub(crate) start_timeout: Duration,
    /// Write every line exchanged with the adapter to this file
    #[arg(long, value_name = "FILE")]
    pub(crate) trace: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct List {
    #[command(flatten)]
    pub(crate) selection: Selection,
}

#[derive(Debug, Args)]
pub(crate) struct Show {
    /// The check's id, as `actucheck list` and reports have it
    pub(crate) id: String,
    #[command(flatten)]
    pub(crate) growth: Growth,
}

#[derive(Debug, Args)]
pub(crate) struct Replay {
    /// The check's id, as `actucheck list` and reports have it, or a file with checks, as
    /// `actucheck fuzz` writes it
    #[arg(value_name = "ID|FILE")]
    pub(crate) what: String,
    #[command(flatten)]
    pub(crate) growth: Growth,
    #[command(flatten)]
    pub(crate) adapter: Adapter,
}

#[derive(Debug, Args)]
pub(crate) struct Fuzz {
    /// The wire whose packets are drawn
    #[arg(long, value_enum, default_value = "dynamixel2")]
    pub(crate) wire: Wire,
    /// How long, as in 90s, 10m or 1h; a minute if neither this nor --cases is given
    #[arg(long, value_name = "TIME", value_parser = duration, conflicts_with = "cases")]
    pub(crate) time: Option<Duration>,
    /// How many probes are drawn
    #[arg(long, value_name = "N")]
    pub(crate) cases: Option<u64>,
    /// What the probes grow from; another number each time if it is not given
    #[arg(long, value_name = "N")]
    pub(crate) seed: Option<u64>,
    /// Where to write what was found
    #[arg(long, value_name = "FILE", default_value = "findings.yaml")]
    pub(crate) out: PathBuf,
    #[command(flatten)]
    pub(crate) adapter: Adapter,
}

#[derive(Debug, Args)]
pub(crate) struct Codec {
    #[command(flatten)]
    pub(crate) selection: Selection,
    /// Ask the checks of this file too, as `actucheck fuzz` writes it; may be given more than once
    #[arg(long, value_name = "FILE")]
    pub(crate) also: Vec<PathBuf>,
    /// Known failures, which do not fail the run as long as they do fail
    #[arg(long, value_name = "FILE")]
    pub(crate) expect: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reports: report::Reports,
    /// How many processes of the adapter share the work
    #[arg(long, value_name = "N", default_value = "1", value_parser = clap::value_parser!(u8).range(1..))]
    pub(crate) jobs: u8,
    /// End the run after so many unexpected failures
    #[arg(long, value_name = "N")]
    pub(crate) max_fail: Option<NonZeroUsize>,
    #[command(flatten)]
    pub(crate) adapter: Adapter,
}

#[derive(Debug, Args)]
pub(crate) struct Decode {
    /// Print the packet object of the adapter protocol
    #[arg(long)]
    pub(crate) json: bool,
    /// The wire that the packet is of
    #[arg(long, value_enum, default_value = "dynamixel2")]
    pub(crate) wire: Wire,
    /// Which way the packet goes; an innfos frame does not tell itself
    #[arg(long, value_enum)]
    pub(crate) kind: Option<Kind>,
    /// The device whose registers are meant
    #[arg(long, value_name = "DEVICE", default_value = "ja40")]
    pub(crate) device: String,
    /// The address at which a status packet's data was read
    #[arg(long, value_name = "ADDRESS")]
    pub(crate) address: Option<u16>,
    /// What a fast status packet answers: bytes a device, and the devices in order
    #[arg(long, value_name = "LENGTH:ID,ID…", value_parser = fast, conflicts_with = "address")]
    pub(crate) fast: Option<Fast>,
    /// The packet's bytes in hex, with or without spaces, commas and 0x; `-` reads them from
    /// standard input
    #[arg(required = true, value_name = "HEX")]
    pub(crate) hex: Vec<String>,
}

#[derive(Debug, Args)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

/// Which way a packet goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Kind {
    /// From the host
    Request,
    /// To the host
    Reply,
}

/// A number of seconds, minutes or hours.
fn duration(text: &str) -> Result<Duration, String> {
    let units = [('s', 1.0), ('m', 60.0), ('h', 3600.0)];
    let unit = units.into_iter().find_map(|(unit, size)| Some((text.strip_suffix(unit)?, size)));
    let (number, size) = unit.unwrap_or((text, 1.0));
    let number: Option<f64> = number.parse().ok().filter(|number| *number > 0.0);
    number
        .and_then(|number| Duration::try_from_secs_f64(number * size).ok())
        .ok_or_else(|| "a time is a number above 0 with s, m or h, such as 90s".to_owned())
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: Option<f64> = text.parse().ok().filter(|seconds| *seconds > 0.0);
    seconds
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or_else(|| "a time is a number of seconds above 0, such as 0.5".to_owned())
}

fn fast(text: &str) -> Result<Fast, String> {
    let parse = || {
        let (length, ids) = text.split_once(':')?;
        let ids = ids.split(',').map(|id| id.trim().parse().ok());
        Some(Fast { length: length.trim().parse().ok()?, ids: ids.collect::<Option<_>>()? })
    };
    parse()
        .ok_or_else(|| "expected the bytes a device and the devices' IDs, such as 4:1,2".to_owned())
}
