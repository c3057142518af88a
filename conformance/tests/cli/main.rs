//! The program as a user sees it: its output and exit status.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

mod decode;
mod outputs;
mod pipelines;

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::{Value, json};

fn actucheck(arguments: &[&str]) -> (i32, String, String) {
    let output = Command::cargo_bin("actucheck").unwrap().args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

const WRITE: &str = "FF FF FD 00 01 09 00 03 34 02 D0 07 00 00 1E C9";

/// The command line belongs to the program: the library must not need `clap`.
#[test]
fn the_library_does_not_name_clap() {
    let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
    let mut seen = 0;
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() && !path.ends_with("src/command") {
                folders.push(path);
            } else if path.is_file() && !path.ends_with("src/main.rs") {
                assert!(!fs::read_to_string(&path).unwrap().contains("clap"), "{}", path.display());
                seen += 1;
            }
        }
    }
    assert!(seen > 10, "{seen} files");
}

#[test]
fn the_main_job_passes_on_the_builtin_codec() {
    let (status, stdout, stderr) = actucheck(&["codec"]);
    assert_eq!((status, stderr.as_str()), (0, ""));
    assert!(stdout.starts_with("actucheck-codec "), "{stdout}");
    assert!(stdout.contains("\npassed  "), "{stdout}");
}

/// The half million checks of longer bodies are asked only on request, but each can be replayed.
#[test]
fn bodies_inside_packets_are_as_long_as_asked_for() {
    let id = "dynamixel2.stuffing.in-sync-write.fffffffdfd/encode";
    let list = |options: &[&str]| actucheck(&[&["list", "--select", id], options].concat()).1;
    assert_eq!(list(&[]), "");
    assert_eq!(list(&["--body-length", "5"]).lines().count(), 1);
    assert_eq!(actucheck(&["replay", id]).0, 0);
    assert_eq!(actucheck(&["list", "--body-length", "8"]).0, 2);
}

#[test]
fn the_json_report_counts_every_verdict() {
    let (status, stdout, _) = actucheck(&["codec", "--report", "json=-"]);
    let report: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!((status, &report["version"]), (0, &Value::from(6)));
    let sum = |totals: &Value| {
        let totals = totals.as_object().unwrap();
        assert_eq!(totals.len(), 12);
        totals.values().map(|count| count.as_u64().unwrap()).sum::<u64>()
    };
    let requirements = report["requirements"].as_array().unwrap().iter();
    let checks = requirements.map(|row| sum(&row["totals"])).sum::<u64>();
    assert_eq!(checks, sum(&report["totals"]));
}

#[test]
fn every_wire_is_checked_unless_some_are_named() {
    let wires = |options: &[&str]| {
        let all = [&["codec", "--cases", "0", "--report", "json=-"], options].concat();
        let (status, stdout, stderr) = actucheck(&all);
        assert_eq!(status, 0, "{stderr}");
        let report: Value = serde_json::from_str(&stdout).unwrap();
        let has = |document: &str| {
            let rows = report["requirements"].as_array().unwrap().iter();
            rows.into_iter().any(|row| row["id"].as_str().unwrap().starts_with(document))
        };
        (report["wires"].clone(), has("ja40."), has("innfos."))
    };
    let (both, one) = (json!(["dynamixel2", "innfos"]), json!(["innfos"]));
    assert_eq!(wires(&[]), (both.clone(), true, true));
    assert_eq!(wires(&["--wire", "innfos"]), (one, false, true));
    assert_eq!(wires(&["--wire", "innfos", "--wire", "dynamixel2"]), (both, true, true));
}

#[test]
fn wrong_usage_is_one_line_and_status_2() {
    for arguments in [
        &["decode", "0G"][..],
        &["decode", "FFF"],
        &["decode"],
        &["decode", "--device", "nobody", WRITE],
        &["codec", "--select", "no.such.check"],
        &["codec", "--select", "[", "--"],
        &["codec", "--report", "yaml=x"],
        &["codec", "--report", "json=/no/such/folder/report.json"],
        &["codec", "--timeout", "0"],
        &["codec", "--wire", "modbus"],
        &["codec", "--expect", "/no/such/file"],
        &["codec", "--frobnicate"],
        &["frobnicate"],
        &["codec", "--"],
        &[],
    ] {
        let (status, stdout, stderr) = actucheck(arguments);
        assert_eq!((status, stdout.as_str()), (2, ""), "{arguments:?}: {stderr}");
        assert!(stderr.starts_with("actucheck: "), "{arguments:?}: {stderr}");
        assert_eq!(stderr.lines().count(), 1, "{arguments:?}: {stderr}");
    }
    assert_eq!(
        actucheck(&["decode", "0G"]).2,
        "actucheck: line 1: `0G` is no byte; bytes are written as `FF FF FD 00`\n"
    );
}

#[test]
fn an_unknown_name_gets_the_nearest_known_one_and_the_subcommands_help() {
    let said = |arguments: &[&str]| actucheck(arguments).2;
    insta::assert_snapshot!(said(&["decod"]), @"actucheck: unrecognized subcommand 'decod'; did you mean `decode`? (see `actucheck --help`)");
    insta::assert_snapshot!(said(&["spec", "dif"]), @"actucheck: unrecognized subcommand 'dif'; did you mean `diff`? (see `actucheck spec --help`)");
    insta::assert_snapshot!(said(&["codec", "--jobz", "3"]), @"actucheck: unexpected argument '--jobz' found; did you mean `--jobs`? (see `actucheck codec --help`)");
    insta::assert_snapshot!(said(&["list", "--wire", "inofs"]), @"actucheck: invalid value 'inofs' for '--wire <WIRE>' [possible values: dynamixel2, innfos]; did you mean `innfos`? (see `actucheck list --help`)");
    insta::assert_snapshot!(said(&["decode", "--device", "ja4", WRITE]), @"actucheck: no device is called `ja4`; did you mean `ja40`?");
    insta::assert_snapshot!(said(&["adapter"]), @"actucheck: no subcommand; `actucheck adapter --help` lists them");
    insta::assert_snapshot!(said(&["codec", "python3", "adapter.py"]), @"actucheck: unexpected argument 'python3' found; put `--` before an adapter's command: `actucheck codec -- python3 …` (see `actucheck codec --help`)");
    insta::assert_snapshot!(said(&["codec", "--wire", "modbus"]), @"actucheck: invalid value 'modbus' for '--wire <WIRE>' [possible values: dynamixel2, innfos] (see `actucheck codec --help`)");
    insta::assert_snapshot!(said(&["show", "dynamixel2.stufing.goal-position/encode"]), @"actucheck: no check has the id `dynamixel2.stufing.goal-position/encode`; did you mean `dynamixel2.stuffing.goal-position/encode`?");
    insta::assert_snapshot!(said(&["replay", "dynamixel2.stuffing.transmit"]), @"actucheck: no check has the id `dynamixel2.stuffing.transmit`; it is a requirement's, which `actucheck spec show dynamixel2.stuffing.transmit` shows");
    insta::assert_snapshot!(said(&["list", "--select", "goal-position/encode"]), @"actucheck: `goal-position/encode` matches no check; did you mean `*goal-position/encode*`?");
    insta::assert_snapshot!(said(&["spec", "show", "dynamixel2.stufing.transmit"]), @"actucheck: the spec has no `dynamixel2.stufing.transmit`; did you mean dynamixel2.stuffing.transmit?");
}

#[cfg(unix)]
#[test]
fn help_lists_the_subcommands_and_the_exit_status() {
    let (status, stdout, stderr) = actucheck(&["--help"]);
    assert_eq!((status, stderr.as_str()), (0, ""));
    insta::assert_snapshot!(stdout, @"
    Checks implementations of robot actuators' protocols against the documents

    Usage: actucheck <COMMAND>

    Commands:
      codec        Checks a codec: the built-in one, or a library behind an adapter
      host         Checks a host: a library that talks with devices, behind an adapter
      device       Checks a device: firmware, on its port
      scan         Looks which devices are at a port, and at which rate
      fuzz         Looks for failures that no check foresees, and shrinks them
      decode       Explains packets field by field: one, or all in a log, a dump or a capture
      encode       Builds a packet from words
      bus          Puts virtual devices on a bus that programs open as they open a serial port
      list         Lists the checks of codecs, then those of hosts, then those of devices
      show         Shows one check: what it asks, what it demands, and which sentence demands it
      replay       Asks one check again and shows the exchange
      adapter      Helps to write an adapter, and checks it
      report       Compares reports, merges the parts of a run, or writes one in another format
      spec         Shows, compares and exports what the documents say
      completions  Prints a shell's completion script
      man          Prints the manual page, or writes those of all subcommands
      help         Print this message or the help of the given subcommand(s)

    Options:
      -h, --help     Print help
      -V, --version  Print version

    Exit status: 0 all passed, 1 something failed, was flaky, crashed or gave no answer in time, 2 wrong
    usage, 3 something could not be run or written, or the adapter itself is at fault, 4 the adapter
    could not be started, 130 another Ctrl-C ended it, a second after the first.
    ");
}

#[test]
fn the_help_of_each_subcommand_has_an_example_of_it() {
    let subcommands = |of: &[&str]| -> Vec<String> {
        let help = actucheck(&[of, &["--help"]].concat()).1;
        let list = help.split("Commands:\n").nth(1).unwrap_or_default();
        let names = list.lines().map_while(|line| line.split_whitespace().next());
        names.filter(|name| *name != "help").map(str::to_owned).collect()
    };
    let (mut seen, mut ran) = (0, 0);
    for name in subcommands(&[]) {
        let nested = subcommands(&[&name]);
        let paths = if nested.is_empty() {
            vec![vec![name.as_str()]]
        } else {
            nested.iter().map(|nested| vec![name.as_str(), nested]).collect()
        };
        for path in paths {
            let (status, help, _) = actucheck(&[&path[..], &["--help"]].concat());
            let examples = help.split("Example").nth(1).unwrap_or_default();
            let example = format!("  actucheck {}", path.join(" "));
            assert!(status == 0 && examples.contains(&example), "{path:?}: {help}");
            assert!(help.contains("Exit status: "), "{path:?}: {help}");
            ran += succeed(examples);
            seen += 1;
        }
    }
    assert_eq!(seen, if cfg!(unix) { 26 } else { 22 });
    assert!(ran > 35, "{ran} examples");
}

/// Runs the examples that need no adapter, no file and no port, each without what a shell does with its
/// output; returns how many they are.
fn succeed(examples: &str) -> usize {
    let needs = [" -- ", "@", "~/", "/dev/", "://", ".log", ".yaml", ".model", ".json", ".lua"];
    let lines = examples.lines().filter_map(|line| line.strip_prefix("  actucheck "));
    let lines = lines.filter_map(|line| line.split(" | ").next()?.split(" > ").next());
    let lines: Vec<_> = lines.filter(|line| !needs.iter().any(|it| line.contains(it))).collect();
    for line in &lines {
        let words = shlex::split(line).unwrap();
        Command::cargo_bin("actucheck").unwrap().args(words).assert().success();
    }
    lines.len()
}

/// A second Ctrl-C ends what has begun to listen for the first.
#[cfg(unix)]
#[test]
fn the_help_of_what_ctrl_c_ends_has_its_status() {
    let commands = [
        &["codec"][..],
        &["host"],
        &["device"],
        &["fuzz"],
        &["replay"],
        &["bus"],
        &["adapter", "check"],
        &[],
    ];
    for command in commands {
        let help = actucheck(&[command, &["--help"]].concat()).1;
        let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(help.contains("130 another Ctrl-C ended it, a second after the first."), "{help}");
    }
}

#[test]
fn the_help_names_every_format_of_a_report() {
    let help = actucheck(&["codec", "--help"]).1;
    for format in actucheck::report::Format::ALL {
        assert!(help.contains(format.name()), "{}", format.name());
    }
}

#[test]
fn an_expected_failure_that_does_not_fail_fails_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("expected.yaml");
    let rows = "expected_failures:\n  - ids: [ja40.ping.instruction/crc]\n    reason: none\n";
    fs::write(&file, rows).unwrap();
    let (status, stdout, _) = actucheck(&["codec", "--expect", file.to_str().unwrap()]);
    assert_eq!(status, 1);
    assert!(stdout.contains("UNEXPECTED PASS"), "{stdout}");

    fs::write(&file, rows.replace("ping", "pong")).unwrap();
    let (status, _, stderr) = actucheck(&["codec", "--expect", file.to_str().unwrap()]);
    assert_eq!(status, 2);
    assert!(stderr.contains("row 1: `ja40.pong.instruction/crc` is the id of no check"));
}

/// Whoever mistypes a name waits neither for an adapter to start nor for a device.
#[cfg(unix)]
#[test]
fn expected_failures_are_read_before_anything_is_started_or_opened() {
    let folder = tempfile::tempdir().unwrap();
    let [marker, list, missing] =
        ["started", "list.yaml", "missing.yaml"].map(|name| folder.path().join(name));
    fs::write(&list, "expected_failures: 7\n").unwrap();
    let touch = format!("touch '{}'", marker.display());
    let command = ["--", "sh", "-c", &touch];
    for expect in [&list, &missing] {
        let expect = ["--expect", expect.to_str().unwrap()];
        for role in ["codec", "host", "device"] {
            let (status, _, stderr) = actucheck(&[&[role][..], &expect, &command].concat());
            assert_eq!((status, stderr.lines().count()), (2, 1), "{stderr}");
            assert!(stderr.contains(expect[1]), "{stderr}");
            assert!(!marker.exists(), "{role} started the command");
        }
        let (status, _, stderr) = actucheck(&[&["device", "/no/such/port"][..], &expect].concat());
        assert_eq!(status, 2, "{stderr}");
    }
    let (status, ..) = actucheck(&[&["codec"][..], &command].concat());
    assert!(status == 4 && marker.exists(), "without the file the command is started");
}

/// A byte has ten bits on the line. A Ping has 10 bytes, and its answer 11 at least.
#[cfg(unix)]
#[test]
fn a_plan_tells_how_long_it_takes() {
    let plan = |select: &str, options: &[&str]| {
        let select = ["--select", select];
        let all = [&["device", "--device", "ja40", "--dry-run"], &select[..], options].concat();
        let (status, stdout, stderr) = actucheck(&all);
        assert_eq!((status, stderr.as_str()), (0, ""));
        stdout.lines().last().unwrap().to_owned()
    };
    let ping = "*.basic.ping/answer";
    assert_eq!(
        plan(ping, &["--baud", "100"]),
        "with --allow read, checks that are asked: 1; packets and parts of packets: 1, with 10 bytes; \
         about 2.1 s at 100 bit/s, if answers begin after 1.0 ms"
    );
    let write = "*.basic.write/answer";
    let asked = |options: &[&str]| plan(write, options).contains("checks that are asked: 1;");
    assert_eq!((asked(&[]), asked(&["--allow", "write-ram"])), (false, true));
    // Nothing is asked of a device, so nobody knows its control table.
    let (status, _, said) = actucheck(&["device", "--dry-run"]);
    assert!(status == 0 && said.contains("the checks of its control table are left out"), "{said}");
}

#[test]
fn completions_are_there_for_a_shell() {
    let (status, stdout, _) = actucheck(&["completions", "bash"]);
    assert_eq!(status, 0);
    assert!(stdout.contains("_actucheck"));
}

/// A page for each subcommand, which have `-h`, their examples and their exit status in them.
#[test]
fn manual_pages_are_there_for_every_subcommand() {
    let (status, stdout, _) = actucheck(&["man"]);
    assert_eq!(status, 0);
    assert!(stdout.contains(".TH actucheck 1") && stdout.contains("Exit status: 0 all passed"));
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(actucheck(&["man", "--out", folder.path().to_str().unwrap()]).0, 0);
    let page = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(page("actucheck-spec-errata.1").contains("actucheck spec errata"));
    let codec = page("actucheck-codec.1");
    assert!(
        codec.contains("Examples:")
            && codec.contains(concat!("actucheck ", env!("CARGO_PKG_VERSION")))
    );
    assert!(!page("actucheck-device.1").contains("device\\-help"), "there is no such page");
    let pages = fs::read_dir(&folder).unwrap().count();
    assert!(pages > 20, "{pages} pages");
    let (status, _, stderr) = actucheck(&["man", "--out", "/nowhere"]);
    assert_eq!((status, stderr.lines().count()), (3, 1), "{stderr}");
}

#[test]
fn a_level_leaves_out_what_binds_less() {
    let levels = |level: &str| -> BTreeSet<String> {
        let (status, stdout, _) = actucheck(&["list", "--wire", "innfos", "--level", level]);
        assert_eq!(status, 0);
        stdout.lines().map(|line| line.split_whitespace().nth(1).unwrap().to_owned()).collect()
    };
    assert_eq!(levels("must"), ["must".to_owned()].into());
    assert_eq!(levels("should"), ["must".to_owned(), "should".to_owned()].into());
}

#[test]
fn a_trace_without_an_adapter_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let trace = folder.path().join("trace");
    for command in
        [&["codec"][..], &["fuzz", "--cases=1"], &["replay", "ja40.ping.instruction/crc"]]
    {
        let option = format!("--trace={}", trace.display());
        let (status, _, stderr) = actucheck(&[command, &[&option]].concat());
        assert_eq!((status, stderr.lines().count()), (2, 1), "{stderr}");
        assert!(stderr.contains("--trace needs an adapter"), "{stderr}");
    }
    assert!(!trace.exists());
}
