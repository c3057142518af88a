//! Where the output goes: a pipe, a terminal with colours, a full disk, a reader that has seen enough.

#[cfg(target_os = "linux")]
use std::fs;

use assert_cmd::Command;

use super::{WRITE, actucheck};

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
        "man",
        "decode fffffd0001030001194e",
        "decode --show lines fffffd0001030001194e",
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
