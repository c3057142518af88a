//! `RESULTS.md` from the runs that are kept.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::Path;

use crate::growth::{self, Growth};
use crate::kept::{self, Machine, Run};
use crate::table::{self, Row};
use crate::{chart, growth_chart};

/// The folder with a run of each machine.
pub const MACHINES: &str = "machines";
/// The file with how the program grows.
const GROWTH: &str = "growth.json";
const BEGIN: &str = "<!-- measured -->\n";
const END: &str = "<!-- end of measured -->\n";

/// What is kept.
pub struct Kept {
    /// The runs of all benchmarks.
    pub runs: Vec<Run>,
    /// How the program grows.
    pub growth: Growth,
    /// What each part of a packet's way through the stream parser costs.
    pub way: String,
    /// The table of a micro-controller.
    pub small: String,
}

impl Kept {
    /// All in `folder`.
    ///
    /// # Errors
    /// If something is missing, or is not what it should be.
    pub fn read(folder: &Path) -> io::Result<Self> {
        Ok(Self {
            runs: kept::read(&folder.join(MACHINES))?,
            growth: growth::read(&folder.join(GROWTH))?,
            way: fs::read_to_string(folder.join("way.md"))?,
            small: fs::read_to_string(folder.join("thumbv7em.md"))?,
        })
    }

    /// The pictures, each with the name of its file.
    #[must_use]
    pub fn pictures(&self) -> Vec<(String, String)> {
        let runs = self.runs.iter();
        let throughput = runs.map(|run| (picture(&run.machine), chart::svg(&run.measured)));
        let growth = ("growth.svg".to_owned(), growth_chart::svg(&self.growth));
        throughput.chain([growth]).collect()
    }
}

/// `results` with the text between its two marks written anew; the rest was written by hand. `None` if
/// there are no marks.
#[must_use]
pub fn renewed(results: &str, kept: &Kept) -> Option<String> {
    let (before, _) = results.split_once(BEGIN)?;
    let (_, after) = results.split_once(END)?;
    let Kept { runs, growth, way, small } = kept;
    let (measured, table) = (measured(runs), growth::markdown(growth));
    let circumstances = circumstances(&growth.machine);
    Some(format!(
        "{before}{BEGIN}\n{measured}\n## The way of a packet\n\n{way}\n## How the program grows\n\n{circumstances}\n\
         ![Time and memory over the work](runs/growth.svg)\n\n{table}\n\
         ## On a micro-controller\n\n{small}\n{END}{after}"
    ))
}

/// All goals machine beside machine, then all that each has measured.
fn measured(runs: &[Run]) -> String {
    let mut text = beside(runs);
    for Run { machine, measured } in runs {
        // Writing to a string can't fail.
        let _ = write!(
            text,
            "\n## {}\n\n{}\n![CRC-16/UMTS throughput over message size](runs/{})\n{}",
            machine.short(),
            circumstances(machine),
            picture(machine),
            table::markdown(measured, machine.bits),
        );
    }
    text
}

/// The file of a machine's picture.
fn picture(machine: &Machine) -> String {
    format!("{MACHINES}/{}.svg", machine.name())
}

fn circumstances(machine: &Machine) -> String {
    let mut text = format!(
        "- processor: {} with {}\n- compiler: {}\n- day: {}\n\
         - load over 1, 5 and 15 minutes when the last run ended: {}\n\
         - runs: {}\n",
        machine.processor,
        machine.features.join(", "),
        machine.compiler,
        machine.day,
        machine.load,
        machine.runs,
    );
    if let Some(note) = &machine.note {
        let _ = writeln!(text, "- note: {note}");
    }
    text
}

/// The ratios of all cases with a goal, a column for each machine.
fn beside(runs: &[Run]) -> String {
    let columns: Vec<Vec<Row>> =
        runs.iter().map(|run| table::rows(&run.measured, run.machine.bits)).collect();
    let key = |row: &Row| (row.ours.group.clone(), row.ours.case.clone());
    let mut cases = Vec::new();
    for row in columns.iter().flatten().filter(|row| row.met().is_some()) {
        if !cases.contains(&key(row)) {
            cases.push(key(row));
        }
    }
    cases.sort_by_key(|(group, case)| (group.clone(), case.parse().unwrap_or(u64::MAX)));

    let mut text = "## Goals, machine by machine\n\n| case |".to_owned();
    for run in runs {
        let _ = write!(text, " {} |", run.machine.short());
    }
    let _ = writeln!(text, "\n|---|{}", "---|".repeat(runs.len()));
    for case in cases {
        let _ = write!(text, "| {}, {} |", case.0, case.1);
        for column in &columns {
            let row = column.iter().find(|row| key(row) == case);
            let _ = write!(text, " {} |", row.map(cell).unwrap_or_default());
        }
        text.push('\n');
    }
    text
}

/// `6.42 of 5.0: met`, and how that was.
fn cell(row: &Row) -> String {
    let Some(ratio) = row.ratio() else { return String::new() };
    let goal = row.goal.map(|goal| format!(" of {goal:.1}: {}", row.verdict()));
    format!("{ratio:.2}{}", goal.unwrap_or_default())
}
