//! The readers of texts that others write: replies of adapters, reports, saved checks,
//! expected-failures files and journals of devices.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use actucheck::adapter::{Greeting, Output, Question, Reported};
use actucheck::journal::{Ask, Journal, restore};
use actucheck::report::merge::merge;
use actucheck::report::{Format, json, read};
use actucheck::suite::check::{Check, Demand};
use actucheck::suite::expect::{Expectations, Failures};
use actucheck::suite::plan::Plan;
use actucheck::suite::{Options, every_device_plan, host_plan, plan, saved};
use actucheck_spec::Spec;
use actucheck_spec::wire::{Packet, Wire};
use serde::Deserialize;

const REPORT: &str = include_str!("readers/report.json");
const HELLO: &str = r#"{"protocol":2,"implementation":{"name":"n","version":"1","language":"C"},
"roles":["host","tester"],"wires":["dynamixel2","can"],"ops":["crc","hello","reset"],
"max_in_flight":4,"limits":{"max_packet":100,"max_send":0}}"#;

const EXPECTED: &str = r#"# Of this build
expected_failures:
- ids: [innfos.alarms.request/encode, "*.plain.*/{de,en}code"]
  reason: a
  upstream: https://example.com
- ids: ["*.basic.one-?*/[!e]*"]
  reason: b
  flaky: true
"#;

const JOURNAL: &str = r#"{"version":2,"date":"2026-01-02T03:04:05Z","wire":"dynamixel2","device":"d",
"model_number":5210,"id":1,"baud":57600,"allowed":["write-ram","motion"],
"layout":{"read":[[64,1],[512,3]],"restored":[{"name":"Led","address":513,"size":2}],
"torque":{"name":"Torque Enable","address":512,"size":1},
"goals_switch":[{"name":"Drive Mode","address":64,"size":1},8]},
"held":[{"address":64,"data":"00"},{"address":512,"data":"000102"}],
"neighbour":{"device":"n","id":2,"layout":{"read":[[64,1]],"restored":[{"name":"Led","address":64,"size":1}]},
"held":[{"address":64,"data":"00"}]}}"#;

static SPEC: LazyLock<Spec> = LazyLock::new(|| Spec::embedded().unwrap());

/// The first check of each op, wire and kind of demand in a short run, by what it is the first of.
static CHECKS: LazyLock<BTreeMap<String, Check>> = LazyLock::new(|| {
    let options = Options { cases: 10, ..Options::new().with_bodies(1) };
    let mut first = BTreeMap::new();
    let of_codecs = plan(&SPEC, &Wire::ALL, &options);
    let (of_hosts, of_devices) =
        (host_plan(&SPEC, &Wire::ALL), every_device_plan(&SPEC, &Wire::ALL));
    for check in of_codecs.checks().chain(of_hosts.checks()).chain(of_devices.checks()) {
        let demand = match check.demand {
            Demand::Yield(_) => "yield",
            Demand::Near { .. } => "near",
            Demand::YieldOneOf(_) => "one-of",
            Demand::Reject(_) => "reject",
            Demand::Send => "send",
            Demand::Withhold => "withhold",
            Demand::Return(_) => "return",
            Demand::Answer(_) => "answer",
            Demand::Record(_) => "record",
        };
        let (wire, op) = (check.question.wire(), check.question.name());
        first.entry(format!("{}.{op}.{demand}", wire.id())).or_insert(check);
    }
    first
});

/// They are all that an expected-failures file can name: to search a whole plan takes too long.
static PLAN: LazyLock<Plan<'_>> = LazyLock::new(|| Plan::of(CHECKS.values().cloned().collect()));

/// The first line of an input says what reads the rest: `# as report`.
///
/// # Panics
/// If a reader panics, or what it accepted says something else when it is written and read again.
pub fn check(input: &[u8]) {
    let Ok(text) = std::str::from_utf8(input) else { return };
    let Some((first, text)) = text.split_once('\n') else { return };
    match first {
        "# as hello" => drop(Greeting::read(text).map(Greeting::meant)),
        "# as reply" => CHECKS.values().for_each(|check| reply(&check.question, text)),
        "# as report" => report(text),
        "# as checks" => checks(text),
        "# as expected" => expected(text),
        "# as journal" => journal(text),
        _ => {}
    }
}

fn reply(question: &Question, text: &str) {
    let Ok(output) = Output::read(question, text) else { return };
    let written = serde_json::to_string(&output).unwrap();
    assert_eq!(Output::read(question, &written).as_ref(), Ok(&output), "{written}");
}

fn report(text: &str) {
    let Ok(report) = read::parse("report", text) else { return };
    let mut written = Vec::new();
    json::write(&report, &mut written).unwrap();
    let written = String::from_utf8(written).unwrap();
    let again = read::parse("report", &written);
    assert_eq!(again.unwrap_or_else(|error| panic!("{error}\n{written}")), report);
    for format in Format::ALL.into_iter().filter(|format| *format != Format::Jsonl) {
        format.write(&report, &mut Vec::new()).unwrap();
    }
    // The part of a run with others that say the same. A merged report is a report too.
    let twins = ["one", "other"].map(|name| (name.to_owned(), report.clone()));
    for parts in [&twins[..1], &twins] {
        if let Ok((whole, _)) = merge(&SPEC, parts.to_vec()) {
            json::write(&whole, &mut Vec::new()).unwrap();
        }
    }
}

fn checks(text: &str) {
    let Ok(checks) = saved::parse("checks", text) else { return };
    let written = saved::write(&checks).unwrap();
    let again = saved::parse("checks", &written);
    assert_eq!(again.unwrap_or_else(|error| panic!("{error}\n{written}")), checks);
}

/// The file is held to another reading of it, as it can't be compared itself.
fn expected(text: &str) {
    let Ok(expected) = Expectations::parse("expected", text, &PLAN, &PLAN) else { return };
    let written = expected.with(&Failures::default(), &PLAN, &SPEC).unwrap().text;
    let again = Expectations::parse("expected", &written, &PLAN, &PLAN);
    again.unwrap_or_else(|error| panic!("{error}\n{written}"));
    assert_eq!(rows(&written), rows(text), "{written}");
    // A line of a text file can be several of YAML's.
    let breaks = ['\r', '\u{85}', '\u{2028}', '\u{2029}'];
    let is_comment = |line: &&str| line.starts_with('#') && !line.trim_end().contains(breaks);
    let comment: String = text.split_inclusive('\n').take_while(is_comment).collect();
    assert!(written.starts_with(&comment), "{written}");
}

/// What is taken says the same when it is written, and to restore any device by it comes to an end.
fn journal(text: &str) {
    let Ok(journal) = Journal::parse("journal", text) else { return };
    let written = serde_json::to_string(&journal).unwrap();
    let again = Journal::parse("journal", &written);
    assert_eq!(again.unwrap_or_else(|error| panic!("{error}\n{written}")), journal);
    // Only a journal of which nothing has to be written is restored on such a device.
    let of_neighbour = journal.neighbour.iter().flat_map(|neighbour| &neighbour.held.0);
    let mut held = journal.held.0.iter().chain(of_neighbour);
    let is_blank = held.all(|run| run.data.0.iter().all(|byte| *byte == 0));
    if is_blank {
        restore(&journal, &mut Stubborn).unwrap();
    } else {
        drop(restore(&journal, &mut Stubborn));
    }
}

/// A device whose registers are all 0, whatever is written to them.
struct Stubborn;

impl Ask for Stubborn {
    fn ask(&mut self, id: u8, packet: &Packet) -> Result<Option<Reported>, String> {
        let call = packet.wire().call(packet);
        let length = call.and_then(|call| call.length).map_or(0, usize::from);
        let data = Some(vec![0; length].into());
        Ok(Some(Reported { id, data, error: Some(0), ..Reported::default() }))
    }
}

#[derive(Debug, PartialEq, Deserialize)]
struct Row {
    ids: Vec<String>,
    reason: String,
    upstream: Option<String>,
    #[serde(default)]
    flaky: bool,
}

/// The rows of an expected-failures file; none if it is empty.
fn rows(text: &str) -> Vec<Row> {
    // White space that YAML does not allow is an empty file too.
    if text.trim().is_empty() {
        return Vec::new();
    }
    let file: Option<BTreeMap<String, Option<Vec<Row>>>> = serde_yaml::from_str(text).unwrap();
    file.into_iter().flat_map(BTreeMap::into_values).flatten().flatten().collect()
}

/// An answer to `hello`, a report, an expected-failures file, a journal, and checks with their right answers.
pub(crate) fn seeds() -> Vec<(String, Vec<u8>)> {
    let seed = |name: &str, form: &str, text: &str| {
        (format!("{form}.{name}"), format!("# as {form}\n{text}").into_bytes())
    };
    let small =
        [("hello", HELLO), ("report", REPORT), ("expected", EXPECTED), ("journal", JOURNAL)];
    let mut seeds: Vec<_> = small.map(|(form, text)| seed("small", form, text)).into();
    for (name, check) in &*CHECKS {
        let text = saved::write(std::slice::from_ref(check)).unwrap();
        seeds.push(seed(name, "checks", &text));
        if let Demand::Yield(output) | Demand::Near { output, .. } = &check.demand {
            let text = serde_json::to_string(output).unwrap();
            seeds.push(seed(name, "reply", &text));
        }
    }
    seeds
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Else every input is refused, and nothing is held.
    #[test]
    fn there_is_something_to_read() {
        read::parse("report", REPORT).unwrap();
        Greeting::read(HELLO).unwrap();
        let journal = Journal::parse("journal", JOURNAL).unwrap();
        let left = restore(&journal, &mut Stubborn).unwrap_err().to_string();
        assert!(left.contains("Led"), "{left}");
        Expectations::parse("expected", EXPECTED, &PLAN, &PLAN).unwrap();
        assert!(CHECKS.len() > Wire::ALL.len() * 4, "{} checks", CHECKS.len());
        for check in CHECKS.values() {
            if let Demand::Yield(output) = &check.demand {
                let text = serde_json::to_string(output).unwrap();
                assert_eq!(Output::read(&check.question, &text).as_ref(), Ok(output));
            }
        }
    }
}
