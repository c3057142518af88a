//! How time and memory of the program grow with its work: `runs/growth.json`, its table and its picture.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::kept::Machine;

/// The most times the time that ten times the work may take.
pub const MOST_TIME: f64 = 11.0;
/// The most times the memory that ten times the work may take.
pub const MOST_MEMORY: f64 = 1.1;

/// Commands with more and more work, on one machine.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Growth {
    /// Where and when.
    pub machine: Machine,
    /// The commands.
    pub commands: Vec<Command>,
}

/// A command.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Command {
    /// What it is, such as `codec`.
    pub name: String,
    /// What its work is counted in, such as `checks`.
    pub unit: String,
    /// Its runs, the one with the least work first.
    pub runs: Vec<Run>,
}

/// A run of a command.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    /// How much work it was.
    pub work: u64,
    /// Processor time in seconds, of all its threads.
    pub seconds: f64,
    /// The most memory that was resident, in KiB.
    pub memory: u64,
}

/// Reads it.
///
/// # Errors
/// If the file can't be read or is another.
pub fn read(file: &Path) -> io::Result<Growth> {
    let text = fs::read_to_string(file)?;
    serde_json::from_str(&text)
        .map_err(|error| io::Error::other(format!("{} tells no growth: {error}", file.display())))
}

/// As a table, each run beside the one with the least work.
#[must_use]
pub fn markdown(growth: &Growth) -> String {
    let mut text = "| command | work | time, s | peak memory, MiB | a unit, µs | time, times | memory, times | |\n\
                    |---|---:|---:|---:|---:|---:|---:|---|\n"
        .to_owned();
    for Command { name, unit, runs } in &growth.commands {
        let mut before: Option<&Run> = None;
        for run in runs {
            let (times, verdict) =
                before.map_or_else(|| (" |".to_owned(), ""), |before| compared(before, run));
            // Writing to a string can't fail.
            let _ = writeln!(
                text,
                "| {name} | {} {unit} | {:.2} | {:.1} | {:.2} | {times} | {verdict} |",
                run.work,
                run.seconds,
                run.mebibytes(),
                run.seconds / float(run.work) * 1e6,
            );
            before = Some(run);
        }
    }
    text
}

/// How many times the time and the memory, and whether that is as it must be.
fn compared(before: &Run, run: &Run) -> (String, &'static str) {
    let work = float(run.work) / float(before.work);
    let (time, memory) = (run.seconds / before.seconds, float(run.memory) / float(before.memory));
    let is_met = time <= MOST_TIME / 10.0 * work && memory <= MOST_MEMORY;
    (format!("{time:.1} | {memory:.2}"), if is_met { "met" } else { "**missed**" })
}

impl Run {
    /// The most memory in MiB.
    #[must_use]
    pub fn mebibytes(&self) -> f64 {
        float(self.memory) / 1024.0
    }
}

#[expect(clippy::cast_precision_loss, reason = "far below 2^52")]
pub(crate) fn float(number: u64) -> f64 {
    number as f64
}
