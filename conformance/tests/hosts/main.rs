//! A right host of each wire, and faults that it may have, one a row of a table. The one on DYNAMIXEL is in
//! this folder, the one on INNFOS in a folder of its own.
//!
//! This program is the hosts' adapter too, so that a test needs nothing built but itself:
//!
//! ```sh
//! cargo test --workspace --test hosts                    # every test
//! cargo test --workspace --test hosts -- no-drain        # those with this in their name
//! cargo test -q --workspace --test hosts -- table        # the faults, as a table in Markdown
//! cargo test -q --workspace --test hosts -- adapter none # the right host, as an adapter
//! cargo test -q --workspace --test hosts -- adapter no-drain 50
//!                                   # one that waits 50 ms for an answer, and does not drain
//! cargo test -q --workspace --test hosts -- adapter no-drain 50 memory
//!                                   # the same on a port in memory, where nobody waits
//! cargo test -q --workspace --test hosts -- adapter none 50 udp
//!                                   # the host on INNFOS
//! ```

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic)] // tests may stop at a surprise
#![cfg(unix)]

mod adapter;
mod answer;
mod bus;
mod busy;
mod cases;
mod faults;
mod fuzzed;
mod host;
mod inbox;
mod innfos;
mod killing;
mod line;
mod memory;
mod packet;
mod parts;
mod port;
mod request;
mod shown;
mod talk;

use std::process::ExitCode;
use std::time::Duration;

use libtest_mimic::{Arguments, Failed, Trial};

use self::adapter::{Adapter, Kind};
use self::faults::{FAULTS, Judged, Row, Switch};
use self::shown::CASES;

/// How long a call waits for its answer, in milliseconds.
const LIMIT: &str = "30";
/// How often a conversation is tried until it is as it should be. A machine may be too busy for a host's
/// limit, but hardly so often.
const TRIES: usize = 3;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["adapter", fault] => adapter(fault, LIMIT, "terminal"),
        ["adapter", fault, limit] => adapter(fault, limit, "terminal"),
        ["adapter", fault, limit, port] => adapter(fault, limit, port),
        ["table"] => print_tables(),
        _ => tests(),
    }
}

fn adapter(fault: &str, limit: &str, port: &str) -> ExitCode {
    let limit = Duration::from_millis(limit.parse().unwrap());
    let run = if port == "udp" {
        let switch = Switch::named(innfos::FAULTS, fault);
        switch.map(|switch| innfos::Adapter::new(switch, limit).run())
    } else {
        let host = Switch::named(FAULTS, fault).zip(Kind::named(port));
        host.map(|(switch, port)| Adapter::new(switch, limit, port).run())
    };
    let Some(run) = run else {
        eprintln!("`{fault}` is no fault, or `{port}` no port; `table` prints the faults");
        return ExitCode::from(2);
    };
    // An error is the end of the pipe.
    run.map_or(ExitCode::FAILURE, |()| ExitCode::SUCCESS)
}

fn tests() -> ExitCode {
    let mut arguments = Arguments::from_args();
    // Most of the time is waited.
    arguments.test_threads.get_or_insert(8);
    let test = |name: String, test: Box<dyn Fn() -> String + Send>| {
        Trial::test(name, move || {
            let tries: Vec<_> =
                (0..TRIES).map(|_| test()).take_while(|wrong| !wrong.is_empty()).collect();
            if tries.len() < TRIES { Ok(()) } else { Err(Failed::from(tries.join("\n"))) }
        })
    };
    let mut trials = Vec::new();
    // These take the longest, so they begin first.
    for port in ["terminal", "memory", "udp"] {
        let name = format!("fuzzed::nothing_in_the_right_host::{port}");
        trials.push(test(name, Box::new(move || fuzzed::right(port))));
    }
    for port in ["terminal", "memory", "udp"] {
        let name = format!("killed::none_is_right::{port}");
        trials.push(test(name, Box::new(move || killing::right(port))));
    }
    let cases =
        CASES.iter().map(|case| test(format!("fault::{}", case.fault), Box::new(|| case.wrong())));
    trials.extend(cases);
    let found = |faults: &'static [&str], port: &'static str| {
        let named = faults.iter().map(move |fault| (format!("fuzzed::{fault}::{port}"), fault));
        named.map(move |(name, fault)| test(name, Box::new(move || fuzzed::wrong(fault, port))))
    };
    trials.extend(found(&fuzzed::FOUND, "memory"));
    trials.extend(found(&fuzzed::FOUND_IN_DATAGRAMS, "udp"));
    for port in ["terminal", "memory"] {
        trials.extend(killed("dynamixel2", port, FAULTS).map(|(name, killed)| test(name, killed)));
    }
    trials.extend(killed("innfos", "udp", innfos::FAULTS).map(|(name, killed)| test(name, killed)));
    let shared = parts::SHARED.iter().map(|fault| {
        test(format!("parts::{fault}::memory"), Box::new(move || parts::wrong(fault)))
    });
    trials.extend(shared);
    trials.push(test("parts::conversations".to_owned(), Box::new(parts::wrong_conversations)));
    trials.push(test("bus::every_call".to_owned(), Box::new(bus::every_call)));
    trials.push(test("busy::a_late_host_is_found".to_owned(), Box::new(busy::wrong)));
    trials.push(test("faults::each_is_shown".to_owned(), Box::new(shown)));
    trials.push(test("faults::each_has_one_place".to_owned(), Box::new(one_place)));
    libtest_mimic::run(&arguments, trials).exit_code()
}

/// A test, by its name.
type Named = (String, Box<dyn Fn() -> String + Send>);

/// A test for each fault of a host that a check finds, and for its adapter.
fn killed<F: Sync>(
    wire: &'static str,
    port: &'static str,
    table: &'static [Row<F>],
) -> impl Iterator<Item = Named> {
    let name = move |fault: &str| format!("killed::{fault}::{port}");
    let of_row = move |row: &'static Row<F>| -> Named {
        (name(row.name), Box::new(move || killing::wrong(wire, port, row)))
    };
    let well: Named = (format!("adapter::is_well::{port}"), Box::new(move || killing::well(port)));
    // A port in memory has no other.
    let is_seen = move |row: &&Row<F>| port != "memory" || !matches!(row.judged, Judged::Unfit(_));
    table.iter().filter(is_seen).map(of_row).chain([well])
}

/// The faults whose switch is not in exactly one place.
fn one_place() -> String {
    let sources = [
        include_str!("adapter.rs"),
        include_str!("answer.rs"),
        include_str!("host.rs"),
        include_str!("inbox.rs"),
        include_str!("memory.rs"),
        include_str!("packet.rs"),
        include_str!("port.rs"),
        include_str!("request.rs"),
    ];
    let wrong = [places(FAULTS, &sources), places(innfos::FAULTS, innfos::SOURCES)];
    wrong.concat().join(" ")
}

/// The faults whose name is not exactly once in sources.
fn places<F: std::fmt::Debug>(table: &[Row<F>], sources: &[&str]) -> Vec<&'static str> {
    let words = || sources.iter().flat_map(|text| text.split(|c: char| !c.is_alphanumeric()));
    let places = |fault: &str| words().filter(|word| *word == fault).count();
    let wrong = table.iter().filter(|row| places(&format!("{:?}", row.fault)) != 1);
    wrong.map(|row| row.name).collect()
}

/// The faults that no case shows, or several.
fn shown() -> String {
    let cases = |name: &str| CASES.iter().filter(|case| case.fault == name).count();
    let wrong = FAULTS.iter().map(|row| row.name).filter(|name| cases(name) != 1);
    wrong.collect::<Vec<_>>().join(" ")
}

fn print_tables() -> ExitCode {
    print_table("dynamixel2", FAULTS);
    println!();
    print_table("innfos", innfos::FAULTS);
    ExitCode::SUCCESS
}

fn print_table<F>(wire: &str, table: &[Row<F>]) {
    println!("| fault on {wire} | the host | found by |");
    println!("|---|---|---|");
    for row in table {
        let found = match row.judged {
            Judged::Fails(check) => format!("`{check}`"),
            Judged::Warns(check) => format!("`{check}`, a warning"),
            Judged::Recorded => "nothing: it is unspecified".to_owned(),
            Judged::Passes => "nothing: it is right".to_owned(),
            Judged::Unfit(point) => format!("`adapter check`: {point}"),
        };
        println!("| `{}` | {} | {found} |", row.name, row.does);
    }
}
