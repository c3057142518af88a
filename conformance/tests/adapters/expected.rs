//! Expected failures: the file, and how it is written.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

use super::WELL_BEHAVED;

/// The CRC of a Ping to device 1, which is wrong for nearly every question.
const WRONG: &str = r#"printf '{"id":%s,"ok":{"crc":19993}}\n' "$id""#;

const FEW: [&str; 3] = ["codec", "--select", "ja40.*/crc"];

fn actucheck(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_actucheck"));
    let output = command.current_dir(folder).args(arguments).output().unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

/// Asks a few checks of the adapter that is wrong.
fn wrong(folder: &Path, options: &[&str]) -> (i32, String) {
    let script = WELL_BEHAVED.replace("ANSWER", WRONG);
    let adapter = ["--report=jsonl=lines", "--", "sh", "-c", &script];
    actucheck(folder, &[&FEW, options, &adapter].concat())
}

fn outcomes(folder: &Path) -> Vec<Value> {
    let text = fs::read_to_string(folder.join("lines")).unwrap();
    let lines = text.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
    lines.filter(|line| line["line"] == "check").collect()
}

fn with(rows: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("e.yaml"), rows).unwrap();
    folder
}

#[test]
fn what_is_written_is_what_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let (status, stderr) = wrong(path, &["--write-expect", "e.yaml"]);
    assert_eq!(status, 1, "{stderr}");
    assert!(stderr.contains("e.yaml has ") && stderr.lines().count() == 1, "{stderr}");
    let text = fs::read_to_string(path.join("e.yaml")).unwrap();
    assert!(text.contains("reason: 'TODO: dynamixel2.") && text.len() < 5000, "{text}");
    assert!(outcomes(path).iter().any(|line| line["verdict"] == "pass"), "all is wrong");
    let (status, stderr) = wrong(path, &["--expect", "e.yaml"]);
    assert_eq!((status, stderr.as_str()), (0, ""), "{text}");
    // No glob matches what passes.
    let passing = outcomes(path).into_iter().filter(|line| line["verdict"] == "pass");
    let ids: Vec<_> = passing.map(|line| line["id"].as_str().unwrap().to_owned()).collect();
    let rows: serde_yaml::Value = serde_yaml::from_str(&text).unwrap();
    let rows = rows["expected_failures"].as_sequence().unwrap().clone();
    let patterns = rows.iter().flat_map(|row| row["ids"].as_sequence().unwrap().clone());
    let patterns: Vec<_> = patterns.map(|id| id.as_str().unwrap().to_owned()).collect();
    let patterns = patterns.iter().map(String::as_str);
    let patterns = actucheck::suite::select::Patterns::new(patterns).unwrap();
    assert!(ids.iter().all(|id| !patterns.is_match(id)), "{text}");
}

#[test]
fn rows_that_are_there_stay_and_what_passes_goes() {
    let rows = "# From a person.\nexpected_failures:\n- ids: [ja40.ping.instruction/crc, \
                ja40.read.instruction/crc]\n  reason: mine\n  upstream: there\n";
    let folder = with(rows);
    let path = folder.path();
    let (status, stderr) = wrong(path, &["--write-expect", "e.yaml"]);
    assert_eq!(status, 2, "rows would be lost");
    assert!(stderr.contains("e.yaml has rows already"), "{stderr}");
    assert_eq!(fs::read_to_string(path.join("e.yaml")).unwrap(), rows);

    // The answer is right for a Ping.
    let (status, stderr) = wrong(path, &["--expect", "e.yaml", "--write-expect", "./e.yaml"]);
    assert_eq!(status, 1, "{stderr}");
    assert!(stderr.contains("; ids that pass now are out: 1"), "{stderr}");
    let text = fs::read_to_string(path.join("e.yaml")).unwrap();
    let kept = "# From a person.\nexpected_failures:\n- ids:\n  - ja40.read.instruction/crc\n  \
                reason: mine\n  upstream: there\n- ids:\n";
    assert!(text.starts_with(kept), "{text}");
    assert_eq!(wrong(path, &["--expect", "e.yaml"]), (0, String::new()));
}

#[test]
fn a_comment_without_a_line_end_stays_one() {
    let folder = with("# mine");
    let path = folder.path();
    assert_eq!(wrong(path, &["--expect", "e.yaml", "--write-expect", "e.yaml"]).0, 1);
    let text = fs::read_to_string(path.join("e.yaml")).unwrap();
    assert!(text.starts_with("# mine\nexpected_failures:\n"), "{text}");
    assert_eq!(wrong(path, &["--expect", "e.yaml"]), (0, String::new()));
}

#[test]
fn the_comment_at_the_beginning_stays() {
    for (before, kept) in [
        ("# a\r", "# a\r\n"),
        ("# a\u{85}# b\n", "# a\u{85}# b\n"),
        ("# a\n\n# b\n \n", "# a\n\n# b\n \n"),
        ("\r\n# a\r\n", "\r\n# a\r\n"),
        ("\u{feff}# a\n", "# a\n"),
        ("  # a\n", "  # a\n"),
    ] {
        let folder = with(&format!("{before}expected_failures: []\n"));
        for _ in 0..2 {
            let files = ["--expect", "e.yaml", "--write-expect", "e.yaml"];
            let (status, stderr) = actucheck(folder.path(), &[&FEW[..], &files].concat());
            assert_eq!(status, 0, "{before:?}: {stderr}");
            let text = fs::read_to_string(folder.path().join("e.yaml")).unwrap();
            assert_eq!(text, format!("{kept}expected_failures: []\n"), "{before:?}");
        }
    }
}

#[test]
fn rows_of_checks_that_did_not_pass_stay() {
    // The one that ends at every question is given up.
    for answer in [r#"printf '{"id":%s,"skip":{"reason":"no"}}\n' "$id""#, "exit"] {
        let all = "ja40.ping.instruction/crc, ja40.write.status/crc, ja40.backup.status/crc";
        let folder = with(&format!("expected_failures: [{{ids: [{all}], reason: mine}}]"));
        let script = WELL_BEHAVED.replace("ANSWER", answer);
        let write = ["--expect", "e.yaml", "--write-expect", "e.yaml", "--", "sh", "-c", &script];
        let (_, stderr) = actucheck(folder.path(), &[&FEW[..], &write].concat());
        let text = fs::read_to_string(folder.path().join("e.yaml")).unwrap();
        for id in all.split(", ") {
            assert!(text.contains(&format!("  - {id}\n")), "{stderr}\n{text}");
        }
    }
}

/// Thousands of checks fail, each of what it offers.
#[test]
fn a_file_is_small_if_everything_fails() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let answer = r#"printf '{"id":%s,"err":{"class":"internal","detail":"x"}}\n' "$id""#;
    let ops = r#"["crc","encode","decode","stream"]"#;
    let all = WELL_BEHAVED.replace(r#"["crc","decode"]"#, ops).replace("ANSWER", answer);
    let run = ["codec", "--cases=5", "--body-length=1", "--wire=dynamixel2"];
    let skip = ["--skip=*.body.*", "--skip=*.limit.*", "--skip=*.in-*", "--skip=*stream*"];
    let run = [&run[..], &skip].concat();
    let adapter = ["--", "sh", "-c", &all];
    let write = [&run[..], &["--write-expect", "e.yaml"], &adapter].concat();
    let (status, stderr) = actucheck(path, &write);
    assert_eq!(status, 1, "{stderr}");
    let text = fs::read_to_string(path.join("e.yaml")).unwrap();
    assert!(text.len() < 10_000, "{} bytes: {text}", text.len());
    let (status, stderr) = actucheck(path, &[&run[..], &["--expect", "e.yaml"], &adapter].concat());
    assert_eq!((status, stderr.as_str()), (0, ""), "{text}");
}

#[test]
fn ids_of_other_options_are_told_and_others_refused() {
    for (id, is_known) in [
        ("dynamixel2.seed-7.12.status/decode", true),
        ("dynamixel2.seed-1.200000.status/decode", true),
        ("dynamixel2.stuffing.in-sync-write.fffffffdfd/encode", true),
        ("dynamixel2.fuzz-7.1/decode", true),
        ("dynamixel2.limit.receive.*", true),
        ("dynamixel2.seed-7.12.statsu/decode", false),
        ("dynamixel2.stufing.*", false),
        ("ja40.pong.instruction/crc", false),
    ] {
        let folder = with(&format!("expected_failures: [{{ids: ['{id}'], reason: r}}]"));
        let run = ["codec", "--select", "ja40.ping.instruction/crc", "--expect", "e.yaml"];
        let (status, stderr) = actucheck(folder.path(), &run);
        assert_eq!((status, stderr.lines().count()), (if is_known { 0 } else { 2 }, 1), "{stderr}");
        let sentence = if is_known { "1 of 1 ids name no check" } else { "is the id of no check" };
        assert!(stderr.contains(sentence) && stderr.contains(id), "{stderr}");
    }
    let folder = with("expected_failures: [{ids: [ja40.ping.instruction/crcc], reason: r}]");
    let (_, stderr) = actucheck(folder.path(), &["codec", "--expect", "e.yaml"]);
    assert!(stderr.contains("did you mean `ja40.ping.instruction/crc`?"), "{stderr}");
}

#[test]
fn what_a_file_lacks_or_has_twice_is_told() {
    let run = ["codec", "--select", "ja40.ping.instruction/crc", "--expect", "e.yaml"];
    for (text, status, sentence) in [
        ("", 0, "e.yaml is empty, so no failure is expected"),
        ("expected_failures:\n", 0, ""),
        ("expected_failures: []\n", 0, ""),
        ("expected_failures: [{ids: [], reason: r}]", 2, "row 1: it names no check"),
        ("rows: []", 2, "e.yaml: "),
    ] {
        let folder = with(text);
        let (code, stderr) = actucheck(folder.path(), &run);
        assert_eq!(code, status, "{stderr}");
        assert!(stderr.contains(sentence) && stderr.lines().count() <= 1, "{stderr}");
        assert_eq!(stderr.is_empty(), sentence.is_empty(), "{stderr}");
    }
    let folder = with(
        "expected_failures: [{ids: ['ja40.*/crc', ja40.read.instruction/crc], reason: one}, \
         {ids: ['ja40.read.*/crc'], reason: other}]",
    );
    let (status, stderr) = wrong(folder.path(), &["--expect", "e.yaml"]);
    assert_eq!((status, stderr.lines().count()), (0, 1), "{stderr}");
    assert!(stderr.contains("row 2 names `ja40.read.") && stderr.contains("row 1"), "{stderr}");
    let failed = |line: &&Value| line["verdict"] == "expected-failure";
    let reasons = outcomes(folder.path());
    assert!(reasons.iter().filter(failed).all(|line| line["reason"] == "one"));
}

#[test]
fn a_flaky_check_may_pass() {
    let row = "expected_failures: [{ids: [ja40.ping.instruction/crc], reason: r, flaky: true}]";
    let folder = with(row);
    assert_eq!(actucheck(folder.path(), &[&FEW[..], &["--expect", "e.yaml"]].concat()).0, 0);
    let folder = with(&row.replace("true", "false"));
    assert_eq!(actucheck(folder.path(), &[&FEW[..], &["--expect", "e.yaml"]].concat()).0, 1);
}
