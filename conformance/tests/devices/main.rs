//! Right devices, and faults that firmware may have, one a row of a table.
//!
//! This program is the firmware too, so that a test needs nothing built but itself and `actucheck`:
//!
//! ```sh
//! cargo test --workspace --test devices                          # every test
//! cargo test -q --workspace --test devices -- table              # the faults, as a table in Markdown
//! actucheck device --device ja40 -- target/debug/deps/devices-… firmware ja40@1 reads-for-all
//!                                                                 # a run against one of them
//! ```

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic)] // tests may stop at a surprise
#![cfg(unix)]

mod alarm;
mod backup;
mod bad;
mod bench;
mod change;
mod code;
mod covered;
mod effects;
mod fault;
mod faults;
mod firmware;
mod fuzzed;
mod innfos;
mod interrupted;
mod killing;
mod modes;
mod motion;
mod packets;
mod pair;
mod profile;
mod programs;
mod rewrite;
mod right;
mod several;
mod tables;
mod writing;

use std::collections::BTreeSet;
use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial};

use self::fault::Fault;
use self::firmware::Firmware;

/// How often a run is tried until it is as it should be, on a machine that may be busy.
const TRIES: usize = 3;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["firmware", devices, fault] => {
            Firmware::new(devices, fault).run();
            ExitCode::SUCCESS
        }
        ["table"] => print_table(),
        _ => tests(),
    }
}

/// The faults of all wires.
fn every() -> impl Iterator<Item = &'static Fault> {
    let tables = [
        faults::FAULTS,
        packets::FAULTS,
        tables::FAULTS,
        several::FAULTS,
        pair::FAULTS,
        writing::FAULTS,
        effects::FAULTS,
        modes::FAULTS,
        motion::FAULTS,
        backup::FAULTS,
        alarm::FAULTS,
        innfos::FAULTS,
    ];
    tables.into_iter().flatten()
}

fn tests() -> ExitCode {
    let names: BTreeSet<_> =
        every().chain(bad::FAULTS).chain(profile::FAULTS).map(|row| row.name).collect();
    assert_eq!(
        names.len(),
        every().chain(bad::FAULTS).chain(profile::FAULTS).count(),
        "two faults have the same name"
    );
    let mut arguments = Arguments::from_args();
    // Most of the time is waited.
    arguments.test_threads.get_or_insert(24);
    let test = |name: String, wrong: Box<dyn Fn() -> String + Send>| {
        Trial::test(name, move || {
            let tries: Vec<_> =
                (0..TRIES).map(|_| wrong()).take_while(|wrong| !wrong.is_empty()).collect();
            if tries.len() < TRIES { Ok(()) } else { Err(Failed::from(tries.join("\n"))) }
        })
    };
    // These wait for the longest, so they begin first.
    let everywhere = right::everywhere().into_iter();
    let mut trials: Vec<_> =
        everywhere.map(|(name, wrong)| test(format!("right::{name}"), wrong)).collect();
    for (name, wrong) in right::TESTS {
        trials.push(test(format!("right::{name}"), Box::new(wrong)));
    }
    for (name, wrong) in fuzzed::TESTS {
        trials.push(test(format!("fuzzed::{name}"), Box::new(wrong)));
    }
    for row in every() {
        trials.push(test(format!("killed::{}", row.name), Box::new(|| killing::wrong(row))));
    }
    trials.push(test("checks::each_has_a_requirement".to_owned(), Box::new(right::requirements)));
    let still = Box::new(right::torque_without_a_goal);
    trials.push(test("checks::torque_moves_nothing".to_owned(), still));
    let covered = Box::new(covered::without_a_fault);
    trials.push(test("checks::each_must_finds_a_fault".to_owned(), covered));
    for (name, wrong) in interrupted::TESTS {
        trials.push(Trial::test(format!("interrupted::{name}"), move || {
            let wrong = wrong();
            if wrong.is_empty() { Ok(()) } else { Err(Failed::from(wrong)) }
        }));
    }
    for (name, wrong) in profile::TESTS {
        trials.push(test(format!("profile::{name}"), Box::new(wrong)));
    }
    for (name, wrong) in bad::TESTS {
        trials.push(test(format!("bad::{name}"), Box::new(wrong)));
    }
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn print_table() -> ExitCode {
    println!("| fault | of | the device | found by |");
    println!("|---|---|---|---|");
    for row in every() {
        println!("| `{}` | `{}` | {} | `{}` |", row.name, row.devices, row.does, row.found_by);
    }
    ExitCode::SUCCESS
}
