//! `--report` and `actucheck report`, as a user sees them.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

use super::sample;

fn actucheck(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("actucheck").unwrap();
    let output = command.current_dir(folder).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// A folder with the report of a short run, `report.json`.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let select = ["codec", "--select", "*goal-position/*", "--report", "json=report.json"];
    assert_eq!(actucheck(folder.path(), &select).0, 0);
    folder
}

#[test]
fn several_reports_are_written_at_once_and_again_from_json() {
    let folder = tempfile::tempdir().unwrap();
    let reports = |name: &str| {
        let formats = ["text", "junit", "markdown", "html"];
        formats.map(|format| format!("--report={format}={name}.{format}"))
    };
    let (first, again) = (reports("first"), reports("again"));
    let run = ["codec", "--select", "*goal-position/*", "--report=json=report.json"];
    let run: Vec<_> = run.into_iter().chain(first.iter().map(String::as_str)).collect();
    let (status, stdout, stderr) = actucheck(folder.path(), &run);
    assert_eq!((status, stderr.as_str()), (0, ""));
    let render = ["report", "render", "report.json"];
    let render: Vec<_> = render.into_iter().chain(again.iter().map(String::as_str)).collect();
    assert_eq!(actucheck(folder.path(), &render), (0, stdout.clone(), String::new()));

    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("first.text"), read("again.text"));
    let printed = |option| actucheck(folder.path(), &["report", "render", "report.json", option]).1;
    assert_eq!(printed("-v"), read("first.text"));
    assert_eq!(
        printed("--quiet").lines().collect::<Vec<_>>(),
        stdout.lines().rev().take(1).collect::<Vec<_>>()
    );
    for (format, start) in [
        ("junit", "<?xml"),
        ("markdown", "## passed: actucheck-codec"),
        ("html", "<!doctype html>"),
    ] {
        let first = read(&format!("first.{format}"));
        assert!(first.starts_with(start), "{format}: {first}");
        assert_eq!(first, read(&format!("again.{format}")));
    }
}

#[test]
fn a_report_says_when_and_how_it_was_made() {
    let header = |epoch: &str| {
        let mut command = Command::cargo_bin("actucheck").unwrap();
        command.args(["codec", "--select", "*goal-position/encode", "--report", "json=-"]);
        let output = command.env("SOURCE_DATE_EPOCH", epoch).output().unwrap();
        serde_json::from_slice::<Value>(&output.stdout).unwrap()
    };
    let fixed = header("1795777200");
    assert_eq!(fixed["date"], "2026-11-27T11:00:00Z");
    let said = "actucheck codec --select '*goal-position/encode' --report 'json=-'";
    assert_eq!(fixed["command_line"], said);
    // No date has so many seconds, so it is the time of the run.
    let now = header("99999999999999999");
    assert!(now["date"].as_str().unwrap().starts_with("20"), "{}", now["date"]);
}

/// Answers every question with `reply`.
fn adapter(reply: &str) -> String {
    let hello = r#"{"protocol":2,"implementation":{"name":"a","version":"1","language":"sh"},"roles":["host"],"wires":["dynamixel2"],"ops":["crc"]}"#;
    format!(
        r#"while read -r line; do
            id=${{line#'{{"id":'}} id=${{id%%,*}}
            case $line in
                *'"op":"hello"'*) printf '{{"id":%s,"ok":%s}}\n' "$id" '{hello}' ;;
                *) printf '{{"id":%s,%s}}\n' "$id" '{reply}' ;;
            esac
        done"#
    )
}

#[test]
fn who_has_a_broken_adapter_is_told_to_check_that_first() {
    let folder = tempfile::tempdir().unwrap();
    let next = |reply: &str| {
        let run = ["codec", "--select", "ja40.ping.*/crc", "--", "sh", "-c", &adapter(reply)];
        let (_, stdout, _) = actucheck(folder.path(), &run);
        let line = stdout.lines().find(|line| line.starts_with("Next: "));
        line.unwrap_or_else(|| panic!("{stdout}")).to_owned()
    };
    assert!(next(r#""ok":{"crc":"none"}"#).contains("`actucheck adapter check -- COMMAND`"));
    assert!(next(r#""ok":{"crc":17}"#).contains("run a replay line"));
}

#[test]
fn a_whole_run_that_passes_makes_a_small_report() {
    let folder = tempfile::tempdir().unwrap();
    // The built-in codec at its default settings is asked 66,000 checks.
    let run = ["codec", "--report=json=report.json", "--report=junit=report.xml"];
    assert_eq!(actucheck(folder.path(), &run).0, 0);
    for (name, most) in [("report.json", 200_000), ("report.xml", 100_000)] {
        let size = fs::metadata(folder.path().join(name)).unwrap().len();
        assert!(size < most, "{name} has {size} bytes");
    }
}

#[test]
fn every_outcome_is_written_as_it_comes() {
    let folder = tempfile::tempdir().unwrap();
    let run = ["codec", "--select", "*goal-position/*", "--report", "jsonl=-"];
    let (status, stdout, stderr) = actucheck(folder.path(), &run);
    let lines: Vec<Value> =
        stdout.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((status, lines.first().unwrap()["line"].as_str()), (0, Some("header")));
    let checks = lines.iter().filter(|line| line["line"] == "check" && line["verdict"] == "pass");
    let last = lines.last().unwrap();
    assert_eq!(last["totals"]["pass"], checks.count());
    assert_eq!(last["line"], "summary");
    assert!(stderr.contains("\npassed  "), "{stderr}");
}

#[cfg(target_os = "linux")]
#[test]
fn one_report_that_can_not_be_written_spoils_no_other() {
    let folder = tempfile::tempdir().unwrap();
    for broken in ["json=/dev/full", "jsonl=/dev/full"] {
        let run = ["codec", "--select", "*goal-position/*", "--report", broken];
        let run = [&run[..], &["--report", "html=page.html"]].concat();
        let (status, stdout, stderr) = actucheck(folder.path(), &run);
        assert_eq!(status, 3);
        assert!(stderr.starts_with("actucheck: cannot write /dev/full: "), "{stderr}");
        assert!(stdout.contains("\npassed  "), "{stdout}");
        assert!(fs::metadata(folder.path().join("page.html")).unwrap().len() > 1000);
    }
}

#[test]
fn a_report_on_standard_output_stands_there_alone() {
    let folder = folder();
    let (status, stdout, stderr) =
        actucheck(folder.path(), &["report", "render", "report.json", "--report", "json=-"]);
    let report: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!((status, &report["implementation"]["name"]), (0, &"actucheck-codec".into()));
    assert!(stderr.contains("\npassed  "), "{stderr}");

    let text = &["report", "render", "report.json", "--report", "text=-"];
    let (_, stdout, stderr) = actucheck(folder.path(), text);
    assert_eq!((stdout.matches("passed  ").count(), stderr.as_str()), (1, ""));
}

#[test]
fn reports_are_compared() {
    let folder = folder();
    let mut other = Vec::new();
    actucheck::report::Format::Json.write(&sample::small(), &mut other).unwrap();
    fs::write(folder.path().join("other.json"), other).unwrap();
    let compare = ["report", "compare", "report.json", "other.json", "--report", "html=page.html"];
    let (status, stdout, stderr) = actucheck(folder.path(), &compare);
    assert_eq!((status, stderr.as_str()), (0, ""));
    assert!(stdout.contains("    dynamixel2.stuffing.transmit  pass  fail 1/2\n"), "{stdout}");
    assert!(fs::read_to_string(folder.path().join("page.html")).unwrap().contains("unstuffed"));

    let judged = |first, second| {
        let compare = ["report", "compare", first, second, "--fail-on-regression"];
        actucheck(folder.path(), &compare)
    };
    let (status, stdout, stderr) = judged("report.json", "other.json");
    assert_eq!(status, 1);
    assert!(
        stdout.contains("dynamixel2.stuffing.transmit"),
        "the comparison is written all the same"
    );
    let sentence = "actucheck: worse than in the first report: ";
    assert!(stderr.starts_with(sentence), "{stderr}");
    assert!(stderr.contains("dynamixel2.stuffing.transmit: 1 check failed, 0 before"), "{stderr}");
    let (status, _, stderr) = judged("other.json", "other.json");
    assert_eq!((status, stderr.as_str()), (0, ""));
}

#[test]
fn what_can_not_be_is_refused_in_a_sentence() {
    let folder = folder();
    fs::write(folder.path().join("old.json"), "{\"version\": 1}").unwrap();
    for (arguments, sentence) in [
        (
            &["codec", "--report", "pdf=x"][..],
            "a report is written as FORMAT=PATH; formats are text, json, jsonl, junit, tap, github, badge, markdown, html",
        ),
        (&["codec", "--report", "html="], "a report is written as FORMAT=PATH"),
        (
            &["codec", "--report", "json=-", "--report", "html=-"],
            "two outputs go to -; give each a path of its own",
        ),
        (&["report", "render", "none.json"], "cannot read none.json"),
        (&["codec", "-v", "-q"], "'--verbose' cannot be used with '--quiet'"),
        (&["report", "render", "old.json"], "old.json is a report of version 1"),
        (&["report", "compare", "report.json"], "<REPORT>..."),
        (&["report", "compare", "report.json", "old.json"], "old.json is a report of version 1"),
        (
            &["report", "compare", "report.json", "report.json", "--report", "junit=x"],
            "that format describes one run",
        ),
        (&["report", "render", "report.json", "--report", "jsonl=x"], "jsonl has every check"),
    ] {
        let (status, stdout, stderr) = actucheck(folder.path(), arguments);
        assert_eq!((status, stdout.as_str()), (2, ""), "{arguments:?}: {stderr}");
        assert!(stderr.starts_with("actucheck: ") && stderr.contains(sentence), "{stderr}");
        assert_eq!(stderr.lines().count(), 1, "{stderr}");
    }
    assert!(!folder.path().join("x").exists());
}
