//! The program as a user sees it: its output and exit status.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

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
fn a_write_is_explained_field_by_field() {
    insta::assert_snapshot!(actucheck(&["decode", "--device", "ja40", WRITE]).1, @r"
    instruction packet: Write to device 1
        0  ff ff fd 00  header
        4  01           ID           1
        5  09 00        length       9 bytes follow
        7  03           instruction  Write
        8  34 02        address      564 (Goal Position, JA40)
       10  d0 07 00 00  data         Goal Position = 2000 (2000 count)
       14  1e c9        CRC          0xC91E, right
    ");
}

#[test]
fn stuffing_bytes_are_marked() {
    let frame = "ffff fd00 01 0a00 03 3402 fffffdfdff 2351";
    insta::assert_snapshot!(actucheck(&["decode", "--device", "ja40", frame]).1, @r"
    instruction packet: Write to device 1
        0  ff ff fd 00       header
        4  01                ID           1
        5  0a 00             length       10 bytes follow
        7  03                instruction  Write
        8  34 02             address      564 (Goal Position, JA40)
       10  ff ff fd (fd) ff  data         Goal Position = -131073 (-131073 count)
       15  23 51             CRC          0x5123, right
    ");
}

#[test]
fn bits_and_names_are_explained_where_the_address_is_known() {
    // Drive Mode and Operating Mode, read in one go; the CRC by long division.
    let frame = "ff ff fd 00 01 06 00 55 00 05 11 A0 C5";
    let (status, stdout, stderr) =
        actucheck(&["decode", "--device", "ja40", "--address", "10", frame]);
    assert_eq!(status, 0, "{stderr}");
    insta::assert_snapshot!(stdout, @r"
    status packet of device 1: no error
        0  ff ff fd 00  header
        4  01           ID           1
        5  06 00        length       6 bytes follow
        7  55           instruction  Status
        8  00           error        no error
        9  05           data         Drive Mode = 5 (Reverse Mode: Reverse (positive is clockwise), Disable Profile: Profile enabled, Profile Configuration: Time-based profile)
       10  11           data         Operating Mode = 17 (Calibration Mode)
       11  a0 c5        CRC          0xC5A0, right
    ");
}

#[test]
fn an_innfos_frame_is_explained_if_it_is_told_which_way_it_goes() {
    let frame = "EE 06 0A 00 04 01 00 00 00 01 D8 ED";
    let (status, stdout, stderr) =
        actucheck(&["decode", "--wire", "innfos", "--direction", "request", frame]);
    assert_eq!(status, 0, "{stderr}");
    insta::assert_snapshot!(stdout, @r"
    request to 6: Write Position
        0  ee           header
        1  06           address  6
        2  0a           command  0x0A (Write Position)
        3  00 04        length   4 bytes of data
        5  01 00 00 00  data     1 R
        9  01 d8        CRC      of the data, right
       11  ed           end
    ");
    let alarms = "EE 06 FF 00 02 00 05 E1 83 ED";
    let (status, stdout, _) =
        actucheck(&["decode", "--wire", "innfos", "--direction", "reply", alarms]);
    assert_eq!(status, 1, "the CRC is wrong");
    insta::assert_snapshot!(stdout, @r"
    no valid packet, from byte 7 on: crc: bytes 7 and 8 are E1 83, C1 B3 is expected
        0  ee     header
        1  06     address  6
        2  ff     command  0xFF (Read Alarms)
        3  00 02  length   2 bytes of data
        5  00 05  data     Overvoltage, Locked rotor
        7  e1 83  CRC      C1 B3 is expected
        9  ed     end
           fits if byte 5 is 7F (2470 were tried, so 1 in 26 wrong packets fits by chance)
    ");
    let others = "EE 01 FF 00 02 08 00 06 70 ED";
    let (_, stdout, _) = actucheck(&["decode", "--wire", "innfos", "--kind", "reply", others]);
    assert!(stdout.contains("Equipment error"), "{stdout}");
    // Only a request to write a position has a position; a command without a name may go both ways.
    assert_eq!(
        actucheck(&["decode", frame]).1.lines().next(),
        Some("request to 6: Write Position")
    );
    let unknown = "EE 06 99 00 00 ED";
    let (status, _, stderr) = actucheck(&["decode", unknown]);
    assert_eq!(status, 2);
    assert!(stderr.contains("--direction request"), "{stderr}");
}

#[test]
fn a_packet_is_printed_as_the_adapter_protocol_has_it() {
    let (status, stdout, _) = actucheck(&["decode", "--json", WRITE]);
    assert_eq!(status, 0);
    assert_eq!(
        stdout,
        "{\"kind\":\"instruction\",\"id\":1,\"instruction\":3,\"params\":\"3402d0070000\"}\n"
    );
}

#[test]
fn bytes_come_from_standard_input_too() {
    let mut command = Command::cargo_bin("actucheck").unwrap();
    let output = command.args(["decode", "--json", "-"]).write_stdin(WRITE).output().unwrap();
    assert!(output.status.success());
}

#[test]
fn what_is_no_packet_is_told_with_reason_offset_and_expectation() {
    let damaged = WRITE.replace("1E C9", "1E C8");
    let (status, stdout, stderr) = actucheck(&["decode", &damaged]);
    assert_eq!((status, stderr.as_str()), (1, ""));
    insta::assert_snapshot!(stdout, @r"
    no valid packet, from byte 14 on: crc: bytes 14 and 15 are 1E C8, 1E C9 is expected
        0  ff ff fd 00  header
        4  01           ID           1
        5  09 00        length       9 bytes follow
        7  03           instruction  Write
        8  34 02        address      564 (if ja40 or ja-variant: Goal Position)
       10  d0 07 00 00  data         2000
       14  1e c8        CRC          1E C9 is expected
           fits if byte 15 is C9
    ");
    let (status, stdout, _) = actucheck(&["decode", "--json", &damaged]);
    let fits = r#""fits":[{"mistake":"one bit changed","conditions":["byte 15 is C9"]"#;
    assert!(status == 1 && stdout.contains(fits), "{stdout}");
    let (status, stdout, _) = actucheck(&["decode", "ff ff fd 00 01"]);
    assert_eq!(status, 1);
    insta::assert_snapshot!(stdout, @r"
    no valid packet, from byte 5 on: truncated: 5 bytes are there, 7 are needed
           fits if the rest of the packet follows
    ");
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

#[test]
fn help_lists_the_subcommands_and_the_exit_status() {
    let (status, stdout, stderr) = actucheck(&["--help"]);
    assert_eq!((status, stderr.as_str()), (0, ""));
    insta::assert_snapshot!(stdout, @"
    Checks implementations of robot actuators' protocols against the documents

    Usage: actucheck <COMMAND>

    Commands:
      codec        Checks a codec: the built-in one, or a library behind an adapter
      fuzz         Looks for failures that no check foresees, and shrinks them
      decode       Explains packets field by field: one, or all in a log, a dump or a capture
      encode       Builds a packet from words
      list         Lists the checks
      show         Shows one check: what it asks, what it demands, and which sentence demands it
      replay       Asks one check again and shows the exchange
      adapter      Helps to write an adapter, and checks it
      report       Compares the reports of several runs, or writes one in another format
      spec         Shows, compares and exports what the documents say
      completions  Prints a shell's completion script
      help         Print this message or the help of the given subcommand(s)

    Options:
      -h, --help     Print help
      -V, --version  Print version

    Exit status: 0 all passed, 1 something failed, crashed or gave no answer in time, 2 wrong usage, 3
    something could not be run, or the adapter itself is at fault, 4 the adapter could not be started.
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
    let mut seen = 0;
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
            seen += 1;
        }
    }
    assert_eq!(seen, 20);
}

#[test]
fn the_help_names_every_format_of_a_report() {
    let help = actucheck(&["codec", "--help"]).1;
    for format in actucheck::report::Format::ALL {
        assert!(help.contains(format.name()), "{}", format.name());
    }
}

#[test]
fn a_packet_that_goes_the_other_way_is_refused() {
    assert_eq!(actucheck(&["decode", "--direction", "request", WRITE]).0, 0);
    // The option's old name.
    let (status, _, stderr) = actucheck(&["decode", "--kind", "reply", WRITE]);
    assert_eq!(status, 1);
    insta::assert_snapshot!(stderr, @"actucheck: no valid reply: the packet is a request");
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

#[test]
fn a_pipe_gets_no_colour_and_no_progress() {
    let (_, stdout, stderr) = actucheck(&["codec"]);
    assert!(!stdout.contains('\u{1b}') && stderr.is_empty());
}

#[test]
fn packets_are_drawn_in_colours_only_where_there_are_some() {
    let decode = |colour: &str, arguments: &[&str]| {
        let mut command = Command::cargo_bin("actucheck").unwrap();
        let output = command.arg("decode").args(arguments).env(colour, "1").output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let innfos = ["--direction", "request", "ee 06 0a 00 04 01 00 00 00 01 d8 ed"];
    let stream = [WRITE, WRITE];
    for arguments in [&[WRITE][..], &stream, &innfos] {
        let coloured = decode("CLICOLOR_FORCE", arguments);
        let plain = decode("NO_COLOR", arguments);
        assert!(!plain.contains('\u{1b}'));
        // All bytes of a packet, those of a field next to each other.
        let shown = anstream::adapter::strip_str(&coloured).to_string();
        let bytes = |line: &&str| line.starts_with("       ");
        let drawn: Vec<_> = shown.lines().filter(bytes).collect();
        assert!(!drawn.is_empty(), "{shown}");
        for line in &drawn {
            let hex: Vec<_> = line.split_whitespace().collect();
            assert!(
                arguments.iter().any(|told| told.eq_ignore_ascii_case(&hex.join(" "))),
                "{line}"
            );
        }
        let rest: Vec<_> = shown.lines().filter(|line| !drawn.contains(line)).collect();
        assert_eq!(rest, plain.lines().collect::<Vec<_>>());
    }
}

#[test]
fn completions_are_there_for_a_shell() {
    let (status, stdout, _) = actucheck(&["completions", "bash"]);
    assert_eq!(status, 0);
    assert!(stdout.contains("_actucheck"));
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

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_and_a_reader_that_has_seen_enough_is_not() {
    let (reader, closed) = std::io::pipe().unwrap();
    drop(reader);
    for command in [
        "list --wire innfos",
        "show ja40.ping.instruction/crc",
        "replay ja40.ping.instruction/crc",
        "fuzz --cases 1",
        "adapter guide",
        "adapter schema reply",
        "adapter template c",
        "completions bash",
        "decode fffffd0001030001194e",
        "encode ping --id 1",
        "spec errata",
    ] {
        let run = |out: fs::File| {
            let mut program = std::process::Command::new(env!("CARGO_BIN_EXE_actucheck"));
            let output = program.args(command.split(' ')).stdout(out).output().unwrap();
            (output.status.code(), String::from_utf8(output.stderr).unwrap())
        };
        let (status, stderr) = run(fs::OpenOptions::new().write(true).open("/dev/full").unwrap());
        assert_eq!(status, Some(3), "{command}: {stderr}");
        assert!(stderr.starts_with("actucheck: cannot write "), "{command}: {stderr}");
        assert_eq!(stderr.lines().count(), 1, "{command}: {stderr}");
        let closed = std::os::fd::OwnedFd::from(closed.try_clone().unwrap());
        assert_eq!(run(closed.into()), (Some(0), String::new()), "{command}");
    }
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
        assert!(stderr.contains("--trace is of an adapter, and none is given"), "{stderr}");
    }
    assert!(!trace.exists());
}

/// The examples in the README print what it says. Those of libraries need a registry.
#[test]
fn the_readme_shows_what_the_program_prints() {
    let readme = Path::new(env!("CARGO_MANIFEST_DIR")).join("../README.md");
    let readme = fs::read_to_string(readme).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let mut run = Vec::new();
    for block in readme.split("\n```").skip(1).step_by(2) {
        for example in block.split("\n$ ").skip(1) {
            let (line, printed) = example.split_once('\n').unwrap();
            let words = shlex::split(line).unwrap();
            match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
                ["cat", file] => fs::write(folder.path().join(file), printed).unwrap(),
                ["actucheck", "codec", ..] => assert!(line.contains(" -- conformance/adapters/")),
                ["actucheck", subcommand, ..] => {
                    let mut command = Command::cargo_bin("actucheck").unwrap();
                    let command = command.args(&words[1..]).current_dir(&folder);
                    let output = String::from_utf8(command.output().unwrap().stdout).unwrap();
                    assert_eq!(output.trim_end(), printed.trim_end(), "{line}");
                    run.push(subcommand.to_owned());
                }
                _ => panic!("{line} is no example of the program"),
            }
        }
    }
    assert_eq!(run, ["decode", "decode", "decode", "encode"]);
}
