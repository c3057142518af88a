//! `actucheck spec` as a user sees it.

#![allow(clippy::unwrap_used, clippy::indexing_slicing)] // tests may stop at a surprise

use actucheck_spec::model::{Level, Role};
use assert_cmd::Command;
use serde_json::Value;

fn spec(arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("actucheck").unwrap();
    let output = command.arg("spec").args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn two_devices_are_compared_fact_by_fact() {
    let (status, stdout, stderr) = spec(&["diff", "ja40", "ja-variant"]);
    assert_eq!((status, stderr.as_str()), (0, ""));
    insta::assert_snapshot!(stdout, @r"
    JA40 and JA variant

    Devices
                                                        ja40                                     ja-variant
      model number                                      5210                                     not told
      instruction Sync Read                             yes                                      -
      instruction Sync Write                            yes                                      -
      backup of Feedforward 1st Gain                    yes                                      not told
      backup of Feedforward 2nd Gain                    yes                                      not told
      backup of Position D Gain                         yes                                      not told
      backup of Position I Gain                         yes                                      not told
      backup of Position P Gain                         yes                                      not told
      backup of Velocity I Gain                         yes                                      not told
      backup of Velocity P Gain                         yes                                      not told
      alarm, Present Position above Max Position Limit  Position Limit Reached Error             Position Limit Error
      alarm, Present Position below Min Position Limit  Position Limit Reached Error             Position Limit Error
      when, Present Position above Max Position Limit   Operating Mode is Position Control Mode  always
      when, Present Position below Min Position Limit   Operating Mode is Position Control Mode  always

    Registers at whose address only ja40 has one
      2    Model Information     u32  EEPROM  R
      38   Current Limit         u16  EEPROM  RW
      40   Acceleration Limit    u32  EEPROM  RW
      550  Goal Current          i16  RAM     RW
      552  Goal Velocity         i32  RAM     RW
      556  Profile Acceleration  u32  RAM     RW
      560  Profile Velocity      u32  RAM     RW
      574  Present Current       i16  RAM     R

    Registers at the same address
                                             ja40                          ja-variant
      0    Model Number           initial    5210                          not told
      10   Drive Mode             initial    0                             2
                                  bit 1      Disable Profile               Enable Profile
                                  bit 2      Profile Configuration         -
                                  bit 1 = 0  Profile enabled               Profile disabled
                                  bit 1 = 1  Profile disabled              Profile enabled
                                  bit 2 = 0  Velocity-based profile        -
                                  bit 2 = 1  Time-based profile            -
      11   Operating Mode         value 0    Current Control Mode          -
                                  value 1    Velocity Control Mode         -
                                  value 3    Position Control Mode         -
      36   PWM Limit              initial    1500                          30000
      518  Hardware Error Status  bit 1      Velocity Limit Reached Error  -
                                  bit 3      Encoder Error                 Motor Encoder Error
                                  bit 4      -                             Electrical Shock Error
                                  bit 6      Position Limit Reached Error  Position Limit Error
      522  Profile Time           name       Profile Time                  Movement Duration
      526  Velocity P Gain        initial    50                            300
      528  Position D Gain        initial    50                            0
      530  Position I Gain        initial    5                             250
      532  Position P Gain        initial    2000                          9000
      536  Feedforward 2nd Gain   initial    2000                          20200
      538  Feedforward 1st Gain   initial    150                           2020
    ");
}

#[test]
fn a_device_does_not_differ_from_itself() {
    assert_eq!(spec(&["diff", "ja40", "ja40"]).1, "JA40 and JA40\nNothing differs.\n");
}

#[test]
fn an_erratum_is_told_whole() {
    let (status, stdout, _) = spec(&["errata", "--document", "ja40"]);
    assert_eq!(status, 0);
    insta::assert_snapshot!(stdout.split("\n\n").next().unwrap(), @r"
    ja40.ping.model-number  resolved
      place       JA40 actuator protocol, 1.6.1 (ja40-protocol.md line 209)
      printed     the ping status carries 5A 17 07 before CRC 10 B9
      held right  5A 14 07
      evidence    CRC 10 B9 fits only 5A 14 07, and 0x145A is 5210, the model number of §2.2.
    ");
}

#[test]
fn errata_are_filtered_and_written_for_programs_too() {
    let (_, stdout, _) = spec(&["errata", "--document", "innfos", "--status", "open", "--json"]);
    let rows: Value = serde_json::from_str(&stdout).unwrap();
    let rows = rows.as_array().unwrap();
    assert!(!rows.is_empty());
    for row in rows {
        assert_eq!(row["status"], "open");
        assert!(row["source"].as_str().unwrap().starts_with("innfos §"), "{row}");
    }
}

#[test]
fn every_requirement_has_a_row_with_its_place_and_what_checks_it() {
    let (status, stdout, _) = spec(&["coverage"]);
    assert_eq!(status, 0);
    let spec = actucheck_spec::Spec::embedded().unwrap();
    for row in spec.requirements.iter().flat_map(|file| &file.content.requirements) {
        let line = stdout.lines().find(|line| line.split_whitespace().next() == Some(&row.id));
        let line = line.unwrap_or_else(|| panic!("no row for {}", row.id));
        assert!(line.contains(&row.source.section), "{line}");
        let told = ["nothing yet", " check", "test ", "not in packets"]
            .iter()
            .any(|words| line.contains(words));
        assert!(told, "{line}");
    }
}

/// `spec show` has the reasons and all tests.
#[test]
fn a_row_of_the_matrix_fits_a_wide_screen() {
    let stdout = spec(&["coverage"]).1;
    let longest = stdout.lines().max_by_key(|line| line.chars().count()).unwrap();
    assert!(longest.chars().count() <= 280, "{longest}");
    for words in [" and 1 more", "; not in packets of a device\n"] {
        assert!(stdout.contains(words), "{words}");
    }
}

/// What packets can't show of a host has a reason, and nothing else has.
#[test]
fn every_must_of_a_host_has_a_check_or_a_reason() {
    let (_, stdout, _) = spec(&["coverage", "--role", "host", "--uncovered"]);
    let without: Vec<_> = stdout.lines().filter(|line| line.contains(" must ")).collect();
    // The last table has the totals.
    let rows = without.iter().filter(|line| !line.starts_with("host"));
    assert_eq!(rows.count(), 0, "{without:#?}");
    let (_, stdout, _) = spec(&["coverage", "--role", "host"]);
    let spec = actucheck_spec::Spec::embedded().unwrap();
    for row in spec.requirements.iter().flat_map(|file| &file.content.requirements) {
        let line = stdout.lines().find(|line| line.split_whitespace().next() == Some(&row.id));
        let is_checked = line.is_some_and(|line| {
            ["check of a host", "checks of a host"].iter().any(|words| line.contains(words))
        });
        assert!(!is_checked || row.unseen.host.is_none(), "{} has a check and a reason", row.id);
    }
}

/// A test of the virtual device shows nothing of another, and a check that only records demands nothing.
#[test]
fn every_must_of_a_device_has_a_check_or_a_reason() {
    let (_, stdout, _) = spec(&["coverage", "--role", "device"]);
    let spec = actucheck_spec::Spec::embedded().unwrap();
    let rows = spec.requirements.iter().flat_map(|file| &file.content.requirements);
    let must = rows.filter(|row| row.level == Level::Must && row.binds.contains(&Role::Device));
    let mut without = Vec::new();
    let mut count = 0;
    for row in must {
        let line = stdout.lines().find(|line| line.split_whitespace().next() == Some(&row.id));
        let is_checked = line.is_some_and(|line| {
            line.split("; ").any(|part| {
                ["check of a device", "checks of a device"].iter().any(|words| part.contains(words))
                    && !part.contains("only recorded")
            })
        });
        if is_checked == row.unseen.device.is_some() {
            without.push(&row.id);
        }
        count += 1;
    }
    assert!(count > 300, "{count} rows");
    assert!(without.is_empty(), "neither a check nor a reason, or both: {without:#?}");
}

#[test]
fn what_is_checked_is_not_among_what_is_not() {
    let (_, stdout, _) =
        spec(&["coverage", "--document", "dynamixel2", "--role", "codec", "--uncovered"]);
    assert!(!stdout.contains("dynamixel2.stuffing.transmit "), "{stdout}");
    assert!(stdout.lines().any(|line| line.starts_with("codec")), "{stdout}");
    assert!(!stdout.lines().any(|line| line.starts_with("device")), "{stdout}");
}

#[test]
fn a_register_is_shown_with_everything_that_belongs_to_it() {
    let (status, stdout, stderr) = spec(&["show", "ja40/Goal Position"]);
    assert_eq!((status, stderr.as_str()), (0, ""));
    assert_eq!(spec(&["show", "ja40/564"]).1, stdout);
    for words in [
        "ja40/Goal Position  i32, RAM, RW",
        "Min Position Limit to Max Position Limit",
        "while Operating Mode is Extended Position Control Mode",
        "2.4.22 Goal Position(564) (ja40-protocol.md line 829)",
        "ja40.goal-position.limits (chosen)",
        "ja40.goal-position.range (must)",
    ] {
        assert!(stdout.contains(words), "{words}\n{stdout}");
    }
}

#[test]
fn whatever_has_an_id_is_shown() {
    let data = actucheck_spec::Spec::embedded().unwrap();
    let requirements = data.requirements.iter().flat_map(|file| &file.content.requirements);
    let first = requirements.map(|row| row.id.clone()).next().unwrap();
    for (id, words) in [
        (first.as_str(), "demands"),
        ("ja40.goal-position.limits", "register ja40/Goal Position"),
        ("ja40.clear.instruction", "truncated"),
        ("dynamixel2/Clear", "key (the rest = 44584c22)"),
        ("dynamixel2/0x10", "dynamixel2/Clear"),
        ("innfos/0x7f", "75.225 times the value"),
        ("dynamixel2.stuffing.transmit", "packet handling"),
    ] {
        let (status, stdout, stderr) = spec(&["show", id]);
        assert_eq!((status, stderr.as_str()), (0, ""), "{id}");
        assert!(stdout.contains(words), "{stdout}");
    }
}

#[test]
fn an_id_that_is_not_there_brings_near_ones() {
    let (status, _, stderr) = spec(&["show", "goal-position.lim"]);
    assert_eq!(status, 2);
    assert!(stderr.contains("did you mean ja-variant.goal-position.limits"), "{stderr}");
    assert_eq!(spec(&["show", "ja40/Goal Positions"]).0, 2);
    assert_eq!(spec(&["show", "dynamixel2/0x99"]).0, 2);
}

#[test]
fn words_find_what_has_all_of_them_names_first() {
    let found = |words: &[&str]| {
        let (status, stdout, stderr) = spec(&[&["find"], words].concat());
        assert_eq!((status, stderr.as_str()), (0, ""), "{words:?}");
        stdout.lines().map(str::to_owned).collect::<Vec<_>>()
    };
    let goal = found(&["GOAL pos"]);
    assert!(goal[1].starts_with("'ja40/Goal Position'  "), "{goal:?}");
    assert_eq!(goal, found(&["goal", "pos"]));
    // Neither word is in the name of this one.
    assert!(found(&["goal", "reached"])[0].starts_with("ja-variant.moving-status.in-position  "));
    for (words, id) in [
        ("clear", "dynamixel2/Clear  "),
        ("clear alarms", "innfos/0xFE  "),
        ("stuffing.transmit", "dynamixel2.stuffing.transmit  "),
        ("goal-position.limits", "ja40.goal-position.limits  "),
    ] {
        let lines = found(&[words]);
        assert!(lines.iter().any(|line| line.starts_with(id)), "{words}: {lines:?}");
    }
    assert!(found(&["velocity"])[0].contains("/Velocity "), "a name that begins so is the first");
    let many = found(&["position"]);
    assert_eq!(many.len(), 42);
    assert!(many[40].starts_with("and ") && many[40].ends_with(" more; add a word"), "{many:?}");
}

#[test]
fn words_that_nothing_has_bring_the_nearest() {
    for (words, says) in [
        (&["goal", "positron"][..], "nothing in the spec has `positron`; did you mean `position`?"),
        (&["xyzzy"], "nothing in the spec has `xyzzy`"),
        (&["handshake", "velocity"], "nothing in the spec has all of these words; leave one out"),
        (&["\u{1b}[31m"], "nothing in the spec has `\\u{1b}[31m`"),
    ] {
        let (status, stdout, stderr) = spec(&[&["find"], words].concat());
        assert_eq!((status, stdout, stderr), (1, String::new(), format!("actucheck: {says}\n")));
    }
}

#[test]
fn the_documents_sentences_are_counted() {
    let (status, stdout, _) = spec(&["coverage", "--sentences"]);
    assert_eq!(status, 0);
    let data = actucheck_spec::Spec::embedded().unwrap();
    let all = data.sentences.iter().map(|file| file.content.sentences().count()).sum::<usize>();
    let last: Vec<_> = stdout.lines().last().unwrap().split_whitespace().collect();
    assert_eq!((last[0], last[1]), ("all", all.to_string().as_str()), "{stdout}");
    let (_, one, _) = spec(&["coverage", "--sentences", "--document", "innfos"]);
    assert_eq!(one.lines().count(), 2, "{one}");
}

#[test]
fn an_export_goes_to_a_file_or_to_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("spec.h");
    let (status, stdout, _) = spec(&["export", "c-header", "--output", file.to_str().unwrap()]);
    assert_eq!((status, stdout.as_str()), (0, ""));
    let text = std::fs::read_to_string(file).unwrap();
    assert_eq!(spec(&["export", "c-header"]).1, text);
    for format in ["json", "vectors", "markdown", "wireshark"] {
        assert_eq!(spec(&["export", format]).0, 0, "{format}");
    }
}

#[test]
fn every_subcommand_has_an_example() {
    for command in ["find", "show", "diff", "errata", "coverage", "export"] {
        let (_, stdout, _) = spec(&[command, "--help"]);
        assert!(stdout.contains(&format!("  actucheck spec {command} ")), "{stdout}");
    }
}

#[test]
fn wrong_usage_is_one_line_and_status_2() {
    for arguments in [
        &["diff", "ja40", "nobody"][..],
        &["errata", "--document", "nothing"],
        &["coverage", "--document", "nothing"],
        &["export", "markdown", "--output", "/no/such/folder/spec.md"],
    ] {
        let (status, stdout, stderr) = spec(arguments);
        assert_eq!((status, stdout.as_str()), (2, ""), "{arguments:?}");
        assert_eq!(stderr.lines().count(), 1, "{stderr}");
    }
    assert_eq!(
        spec(&["diff", "ja40", "nobody"]).2,
        "actucheck: unknown device `nobody`; known are ja-variant, ja40, xl330-m288, xm430-w210\n"
    );
}
