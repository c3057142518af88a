//! `actucheck device restore`.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use actucheck::journal::{Journal, restore};
use actucheck::port::Place;
use clap::Args;

use super::super::shared::{self, Failure, milliseconds};
use super::open::Opening;

const EXAMPLES: &str = "\
Examples:
  actucheck device restore actucheck-ja40-1-20260102T030405Z.journal.json
      at the port that the journal names
  actucheck device restore actucheck-ja40-1-20260102T030405Z.journal.json /dev/ttyUSB1
      at another port
  actucheck device restore actucheck-ja40-1-20260102T030405Z.journal.json -- ./firmware-on-this-machine
      firmware that was compiled for this machine, which is started for it

Only what differs is written, then all is read again. The journal is removed when the device holds what it
held, and stays otherwise.

Exit status: 0 restored, 2 wrong usage, or a damaged journal, 3 the device could not be restored, 4 the port \
can't be used";

/// Gives a device back what it held before a run that could not do it itself
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct Restore {
    /// The journal, which the run left
    #[arg(value_name = "JOURNAL")]
    journal: PathBuf,
    /// Where the device is, if not where it was: the path of a serial port, tcp://HOST:PORT or
    /// udp://HOST:PORT
    #[arg(value_name = "PORT")]
    port: Option<String>,
    /// COMMAND is an adapter with the op `device`
    #[arg(long, requires = "command")]
    adapter: bool,
    /// The command of firmware that speaks raw bytes on its standard input and output
    #[arg(last = true, value_name = "COMMAND", conflicts_with = "port")]
    command: Vec<String>,
    /// The rate of a serial port in bit/s [default: that of the journal]
    #[arg(long, value_name = "RATE", value_parser = clap::value_parser!(u32).range(1..))]
    baud: Option<u32>,
    /// How many milliseconds an answer is awaited
    #[arg(long, value_name = "MS", default_value = "500", value_parser = milliseconds)]
    answer_within: Duration,
}

impl Restore {
    /// Where the device is now.
    fn place(&self, journal: &Journal) -> Result<Place, Failure> {
        if !self.command.is_empty() {
            return Ok(Place::Program(self.command.clone()));
        }
        let Some(port) = self.port.as_ref().or(journal.port.as_ref()) else {
            return Err(Failure::usage(format!(
                "the device of {} was a program; give its command after `--`, or name the PORT after the \
                 journal, if it is at one now",
                self.journal.display()
            )));
        };
        let Ok(place) = port.parse();
        Ok(place)
    }
}

pub(super) fn run(options: &Restore) -> Result<ExitCode, Failure> {
    let path = &options.journal;
    let journal = Journal::read(path).map_err(Failure::usage)?;
    let interrupted = shared::interrupted()?;
    let place = options.place(&journal)?;
    let baud = options.baud.unwrap_or(journal.baud);
    let opening = Opening {
        wire: journal.wire,
        place: &place,
        is_adapter: options.adapter,
        baud: Some(baud),
        limit: options.answer_within,
        id: journal.id,
    };
    let (mut line, _) = opening.line(baud, &interrupted)?;
    // A board answers who has greeted it.
    line.greet(options.answer_within).map_err(Failure::not_started)?;
    let count = restore(&journal, &mut line).map_err(|error| {
        Failure::incomplete(format!("{} is not restored: {error}", journal.device))
    })?;
    Journal::remove(path).map_err(Failure::incomplete)?;
    let what = match count {
        0 => "held what it held before already".to_owned(),
        1 => "holds what it held before: 1 register was written".to_owned(),
        many => format!("holds what it held before: {many} registers were written"),
    };
    let beside = journal.neighbour.as_ref().map_or_else(String::new, |neighbour| {
        format!(", with its neighbour {} with ID {},", neighbour.device, neighbour.id)
    });
    let (device, id, path) = (&journal.device, journal.id, path.display());
    let text = format!("{device} with ID {id}{beside} {what}; {path} is removed\n");
    shared::print(text.as_bytes())?;
    Ok(ExitCode::SUCCESS)
}
