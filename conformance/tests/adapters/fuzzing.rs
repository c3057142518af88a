//! `actucheck fuzz` at the command line, and the use of its findings.

use std::path::Path;
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use super::WELL_BEHAVED;

const WRONG: &str = r#"printf '{"id":%s,"ok":{"crc":1}}\n' "$id""#;

fn actucheck(folder: &Path, arguments: &[&str], answer: &str) -> (Output, String) {
    let script = WELL_BEHAVED.replace("ANSWER", answer).replace(r#","decode"]"#, "]");
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .current_dir(folder)
        .args(arguments)
        .args(["--", "sh", "-c", &script])
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    (output, text)
}

#[test]
fn a_finding_is_shown_kept_and_asked_again() {
    let folder = tempfile::tempdir().unwrap();
    let fuzz = ["fuzz", "--seed", "3", "--cases", "200"];
    let (output, text) = actucheck(folder.path(), &fuzz, WRONG);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("crc dynamixel2.crc.value: wrong CRC"), "{text}");
    assert!(text.contains("seed 3: 1 kind of finding, kept in findings.yaml"), "{text}");
    let (output, text) = actucheck(folder.path(), &["replay", "findings.yaml"], WRONG);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("actucheck replay findings.yaml -- sh -c"), "{text}");
    let also = ["codec", "-v", "--also", "findings.yaml", "--select", "*.fuzz-3.*"];
    let (output, text) = actucheck(folder.path(), &also, WRONG);
    assert_eq!((output.status.code(), text.contains("1 fail")), (Some(1), true), "{text}");
    assert!(text.contains("actucheck replay findings.yaml -- sh -c"), "{text}");
}

#[test]
fn several_processes_find_what_one_finds_with_as_many_probes() {
    let folder = tempfile::tempdir().unwrap();
    let found = |jobs: &str| {
        let fuzz = ["fuzz", "--seed", "3", "--cases", "300", "--jobs", jobs];
        let (output, text) = actucheck(folder.path(), &fuzz, WRONG);
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert!(text.contains("300 probes in "), "{text}");
        std::fs::read_to_string(folder.path().join("findings.yaml")).unwrap()
    };
    assert_eq!(found("1"), found("3"));
}

/// Wrong at the second request of every process, and right at the others.
const WRONG_ONCE: &str = r#"count=$((count + 1))
    if [ $count = 2 ]; then printf '{"id":%s,"ok":{"crc":1}}\n' "$id"
    else printf '{"id":%s,"skip":{"reason":"it has no CRC"}}\n' "$id"; fi"#;

#[test]
fn what_depends_on_earlier_requests_is_told_with_them() {
    let folder = tempfile::tempdir().unwrap();
    let fuzz = ["fuzz", "--seed", "3", "--cases", "100"];
    let (output, text) = actucheck(folder.path(), &fuzz, WRONG_ONCE);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("it depends on what came before: it needs dynamixel2.fuzz-3."), "{text}");
    assert!(text.contains(".before-1 first"), "{text}");
}

#[test]
fn an_adapter_that_hangs_does_not_outlast_the_time() {
    let folder = tempfile::tempdir().unwrap();
    let fuzz = ["fuzz", "--time", "2s", "--timeout", "0.2"];
    let started = Instant::now();
    let (output, text) = actucheck(folder.path(), &fuzz, "sleep 60");
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("does not answer in time"), "{text}");
    assert!(started.elapsed() < Duration::from_secs(15), "{:?}", started.elapsed());
}

#[test]
fn what_an_adapter_says_does_not_control_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let skip = r#"printf '{"id":%s,"skip":{"reason":"no \\u001b[31mCRC"}}\n' "$id""#;
    let (_, text) = actucheck(folder.path(), &["fuzz", "--cases", "50"], skip);
    assert!(text.contains(r"not asked, no \u{1b}[31mCRC: crc"), "{text}");
    assert!(!text.contains('\u{1b}'), "{text}");
}

#[test]
fn a_place_that_cannot_be_written_is_told_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    let fuzz = ["fuzz", "--seed", "3", "--cases", "50", "--out", "missing/findings.yaml"];
    let (output, text) = actucheck(folder.path(), &fuzz, "touch asked");
    assert_eq!((output.status.code(), text.as_str()), (Some(2), ""));
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(stderr.contains("cannot write missing/findings.yaml"), "{stderr}");
    assert!(!folder.path().join("asked").exists(), "the adapter was asked");
}

/// The folder goes while the adapter is asked.
#[test]
fn findings_that_cannot_be_kept_are_shown() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("gone")).unwrap();
    let fuzz = ["fuzz", "--seed", "3", "--cases", "50", "--out", "gone/findings.yaml"];
    let (output, text) = actucheck(folder.path(), &fuzz, &format!("rm -rf gone; {WRONG}"));
    assert_eq!(output.status.code(), Some(3), "{text}");
    assert!(text.contains("crc dynamixel2.crc.value: wrong CRC"), "{text}");
    assert!(text.ends_with("seed 3: 1 kind of finding\n"), "{text}");
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(stderr.contains("cannot write gone/findings.yaml"), "{stderr}");
}

#[test]
fn a_file_that_keeps_no_checks_says_so() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("findings.yaml"), "checks: 3\n").unwrap();
    let (output, _) = actucheck(folder.path(), &["replay", "findings.yaml"], WRONG);
    assert_eq!(output.status.code(), Some(2));
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(stderr.contains("findings.yaml is no file with checks: "), "{stderr}");
}
