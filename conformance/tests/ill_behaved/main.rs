//! Adapters that misbehave, one way a row: each run ends in bounded time and memory, leaves no process
//! behind, asks all other checks, and ends with the right status.
//!
//! This program is the adapter too, so that a test needs nothing built but itself:
//!
//! ```sh
//! cargo test --workspace --test ill_behaved                     # every row
//! cargo test --workspace --test ill_behaved -- setsid           # those with this in their name
//! cargo test --workspace --test ill_behaved --release -- table  # what each took
//! cargo run -- codec -- cargo test -q --workspace --test ill_behaved -- adapter hangs crc
//! ```

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic)] // tests may stop at a surprise
#![cfg(unix)]

mod adapter;
mod rows;
mod watch;

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::io;
use std::process::{Command, ExitCode};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

use libtest_mimic::{Arguments, Failed, Trial};
use serde_json::Value;

use self::adapter::Adapter;
use self::rows::{ROWS, Row};
use self::watch::{Watched, watch};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["adapter", "in-its-own-session"] => adapter::sleep_in_own_session(),
        ["adapter", mode, when] => Adapter::new(mode, when).run(),
        ["table"] => print_table(),
        _ => return tests(),
    }
    ExitCode::SUCCESS
}

fn tests() -> ExitCode {
    let mut arguments = Arguments::from_args();
    // Most of the time is waited.
    arguments.test_threads.get_or_insert(8);
    let test = |row: &'static Row| {
        Trial::test(row.name.replace(' ', "_"), move || {
            let wrong = Run::of(row).wrong();
            if wrong.is_empty() { Ok(()) } else { Err(Failed::from(wrong)) }
        })
    };
    libtest_mimic::run(&arguments, ROWS.iter().map(test).collect()).exit_code()
}

/// The run that a row leads to.
struct Run<'r> {
    row: &'r Row,
    watched: Watched,
    /// The JSON report; null if there is none.
    report: Value,
    /// The reports and what was printed, by name.
    files: BTreeMap<String, String>,
}

/// The exit status if the adapter could not be started.
const NOT_STARTED: i32 = 4;
/// The verdicts that a well-behaved adapter gets.
const GOOD: [&str; 2] = ["pass", "recorded"];

type Totals = BTreeMap<String, u64>;

impl<'r> Run<'r> {
    fn of(row: &'r Row) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let report = |format| format!("--report={format}={}", folder.path().join(format).display());
        let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
        command.args(["codec", "--start-timeout", "5", "--timeout", row.timeout]);
        command.args(["json", "markdown", "html", "junit"].map(report));
        command.args(row.select.iter().map(|glob| format!("--select={glob}")));
        command.arg("--").arg(std::env::current_exe().unwrap()).arg("adapter");
        command.args(row.adapter.splitn(2, ' '));
        let limit = Duration::from_secs_f64(row.seconds * 2.0);
        let watched = watch(&mut command, folder.path(), limit);
        let read = |entry: io::Result<fs::DirEntry>| {
            let entry = entry.unwrap();
            let text = fs::read_to_string(entry.path()).unwrap();
            (entry.file_name().into_string().unwrap(), text)
        };
        let files: BTreeMap<_, _> = fs::read_dir(folder.path()).unwrap().map(read).collect();
        let report = files.get("json").map_or("null", String::as_str);
        let report = serde_json::from_str(report).unwrap();
        Self { row, watched, report, files }
    }

    /// How many bytes were written.
    fn written(&self) -> usize {
        self.files.values().map(String::len).sum()
    }

    fn totals(&self) -> Totals {
        let totals = self.report["totals"].as_object().cloned().unwrap_or_default();
        totals.into_iter().map(|(verdict, count)| (verdict, count.as_u64().unwrap())).collect()
    }

    /// What is not as the row says, a line each; empty if there is nothing.
    fn wrong(&self) -> String {
        let Self { row, watched, .. } = self;
        let mut wrong = String::new();
        let mut hold = |holds: bool, what: String| {
            if !holds {
                wrong += &(what + "\n");
            }
        };
        hold(watched.status == Some(row.exit), format!("exit status {:?}", watched.status));
        hold(watched.took.as_secs_f64() < row.seconds, format!("took {:?}", watched.took));
        match watched.megabytes {
            Some(megabytes) => hold(megabytes < row.megabytes, format!("took {megabytes} MB")),
            None => eprintln!("SKIPPED: this system does not tell how much memory was taken"),
        }
        hold(self.written() < 4 << 20, format!("wrote {} bytes", self.written()));
        hold(watched.left.is_empty(), format!("left the processes {:?}", watched.left));
        for (name, text) in &self.files {
            let raw = text.find(|c: char| c.is_control() && c != '\n' || c == '\u{202e}');
            hold(raw.is_none(), format!("a control at byte {raw:?} of {name}"));
            let forged = text.lines().any(|line| line.trim() == "passed  9 pass");
            let tag = name == "html" && text.contains("</script>");
            hold(!forged && !tag, format!("{name} is forged"));
        }
        if row.exit != NOT_STARTED {
            let totals = self.totals();
            for (verdict, count) in &totals {
                let right = match row.counts(verdict) {
                    Some(counts) => counts.contains(count),
                    None => *count == 0 || GOOD.contains(&verdict.as_str()),
                };
                hold(right, format!("{count} {verdict}"));
            }
            let (asked, all) = (totals.values().sum::<u64>(), well_behaved(row.select));
            hold(asked == all, format!("{asked} of {all} checks"));
            hold(self.report["left"] == 0, format!("left {}", self.report["left"]));
        }
        if !wrong.is_empty() {
            // Writing to a string can't fail.
            let _ = writeln!(
                wrong,
                "{:?}\n{}{}",
                self.totals(),
                self.files["stdout"],
                self.files["stderr"]
            );
        }
        wrong
    }
}

/// How many checks these are, according to the run of an adapter that behaves well.
fn well_behaved(select: &'static [&'static str]) -> u64 {
    static KNOWN: Mutex<BTreeMap<&[&str], u64>> = Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    *known.entry(select).or_insert_with(|| {
        let row = Row { name: "", adapter: "well never", select, exit: 0, verdicts: "", ..ROWS[0] };
        let run = Run::of(&row);
        let totals = run.totals();
        assert!(GOOD.iter().any(|verdict| totals[*verdict] > 0), "{}", run.files["stderr"]);
        totals.values().sum()
    })
}

/// What the run of each row took, as a table in Markdown.
fn print_table() {
    println!("| the adapter | exit | verdicts | seconds | MB | reports, kB |");
    println!("|---|---:|---|---:|---:|---:|");
    for row in ROWS {
        let run = Run::of(row);
        let totals = run.totals().into_iter().filter(|(_, count)| *count > 0);
        let totals: Vec<_> = totals.map(|(verdict, count)| format!("{count} {verdict}")).collect();
        println!(
            "| {} | {} | {} | {:.1} | {} | {} |{}",
            row.name,
            run.watched.status.map_or("killed".to_owned(), |status| status.to_string()),
            totals.join(", "),
            run.watched.took.as_secs_f64(),
            run.watched.megabytes.unwrap_or_default(),
            run.written() / 1000,
            if run.wrong().is_empty() { "" } else { " **not as expected**" },
        );
    }
}
