//! Adapters that say too much: the run keeps a little of it.
#![cfg(target_os = "linux")]

use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::WELL_BEHAVED;

/// The most memory that the run had, in MB, and the sizes of its reports, in kB.
fn measure(options: &[&str], script: &str) -> (u64, Vec<u64>) {
    let folder = tempfile::tempdir().unwrap();
    let formats = ["json", "jsonl", "junit", "markdown", "html", "text"];
    let path = |format: &str| folder.path().join(format);
    let mut child = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .current_dir(folder.path())
        .args(["codec", "--timeout", "8", "--start-timeout", "8"])
        .args(options)
        .args(formats.map(|format| format!("--report={format}={}", path(format).display())))
        .args(["--", "sh", "-c", script])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let status = format!("/proc/{}/status", child.id());
    let started = Instant::now();
    let mut most = 0;
    while child.try_wait().unwrap().is_none() {
        let text = fs::read_to_string(&status).unwrap_or_default();
        let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse().ok());
        most = most.max(kilobytes.unwrap_or(0));
        assert!(started.elapsed() < Duration::from_secs(100));
        sleep(Duration::from_millis(20));
    }
    let size = |format| fs::metadata(path(format)).unwrap().len() / 1024;
    (most / 1024, formats.map(size).to_vec())
}

/// Answers with 1 MB of this kind, and says of itself what `said` is.
fn verbose(said: &str, answer: &str) -> String {
    let answer = format!(r#"printf '{{"id":%s,{answer}}}\n' "$id" "$big""#);
    let big = "big=$(head -c 1000000 /dev/zero | tr '\\0' 0)\n";
    format!("{big}{WELL_BEHAVED}").replace(r#""protocol":1"#, said).replace("ANSWER", &answer)
}

const VERSION_2: &str = r#""protocol":2,"roles":["host","device"]"#;

#[test]
fn long_texts_are_not_kept() {
    for answer in [
        r#""err":{"class":"crc","detail":"%s"}"#,
        r#""err":{"class":"%s","detail":""}"#,
        r#""skip":{"reason":"%s"}"#,
        r#""ok":{"packet":{"kind":"%s"}}"#,
        r#""ok":{"packet":{"kind":"status","id":1,"error":0,"params":"%s"}}"#,
    ] {
        let script = verbose(VERSION_2, answer);
        let (memory, reports) =
            measure(&["--select", "ja40.*sync-read*/decode", "--max-fail", "60"], &script);
        assert!(memory < 80, "{memory} MB for {answer}");
        // Of them `jsonl` has every outcome.
        assert!(reports.iter().all(|size| *size < 2000), "{reports:?} kB for {answer}");
    }
}

#[test]
fn what_is_held_back_for_a_slow_process_is_small() {
    let folder = tempfile::tempdir().unwrap();
    let lock = folder.path().join("lock");
    let slow =
        format!("case $line in *decode*) mkdir {} 2>&- && sleep 6 ;; esac\n", lock.display());
    let script = verbose(VERSION_2, r#""err":{"class":"crc","detail":"%s"}"#)
        .replace("while read -r line; do\n", &format!("while read -r line; do\n{slow}"));
    let options = ["--select", "dynamixel2.*/decode", "--jobs", "2", "--max-fail", "400"];
    let (memory, reports) = measure(&options, &script);
    assert!(memory < 80, "{memory} MB");
    assert!(reports.iter().all(|size| *size < 2000), "{reports:?} kB");
}
