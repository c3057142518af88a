//! Files that a user names: one without an end, one that nests deep, or one that says what moves a
//! cursor costs a sentence.

use std::fs::{self, File};
use std::path::Path;
use std::time::{Duration, Instant};

use assert_cmd::Command;
use serde_json::Value;

use super::sample;

fn actucheck(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("actucheck").unwrap();
    let output = command.current_dir(folder).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn a_file_that_would_exhaust_its_reader_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).display().to_string();
    for (name, deep) in [("list", "["), ("map", "{a: "), ("json", "[{\"a\":"), ("block", "- ")] {
        fs::write(path(name), deep.repeat(100_000)).unwrap();
    }
    File::create(path("long")).unwrap().set_len(65 << 20).unwrap();
    fs::write(path("no-text"), b"version: \xff").unwrap();
    fs::write(path("hostile"), "\"\\e[2J\\r\\u2028\": [1]\n").unwrap();
    let made = std::process::Command::new("mkfifo").arg(path("pipe")).status();
    let pipe = made.is_ok_and(|status| status.success()).then(|| path("pipe"));
    let zeros = Path::new("/dev/zero").exists().then(|| "/dev/zero".to_owned());
    let names = ["list", "map", "json", "block", "long", "no-text", "hostile", "missing", "."];
    for file in names.map(path).into_iter().chain(pipe).chain(zeros) {
        for command in [
            &["codec", "--select", "*goal-position/*", "--expect", &file][..],
            &["codec", "--select", "*goal-position/*", "--also", &file],
            &["replay", &file],
            &["report", "render", &file],
            &["report", "compare", &file, &file],
        ] {
            let started = Instant::now();
            let (status, _, stderr) = actucheck(folder.path(), command);
            assert_eq!(status, 2, "{command:?}: {stderr}");
            assert_eq!(stderr.lines().count(), 1, "{command:?}: {stderr}");
            // What is no file is an id for `replay`.
            let sentence = match file.rsplit('/').next() {
                Some("long") => "MiB; split it",
                Some("no-text") => "is not a text in UTF-8",
                Some("pipe" | "zero" | ".") if command[0] != "replay" => "not a file with an end",
                _ => "",
            };
            assert!(stderr.contains(sentence), "{command:?}: {stderr}");
            assert!(!stderr.trim_end().contains(char::is_control), "{command:?}: {stderr:?}");
            assert!(started.elapsed() < Duration::from_secs(10), "{command:?}");
        }
    }
}

/// Puts this after every text that nothing depends on.
fn spoil(content: &mut Value, with: &str) {
    const FREE: [&str; 9] = [
        "name", "version", "language", "detail", "text", "replay", "section", "document", "answer",
    ];
    match content {
        Value::Array(values) => values.iter_mut().for_each(|value| spoil(value, with)),
        Value::Object(fields) => fields.iter_mut().for_each(|(name, value)| match value {
            Value::String(text) if FREE.contains(&name.as_str()) => text.push_str(with),
            value => spoil(value, with),
        }),
        _ => {}
    }
}

/// Whether a line has a character that does not show.
fn hides(line: &str) -> bool {
    line.contains(|it: char| it.is_control() || "\u{2028}\u{202e}\u{200b}".contains(it))
}

#[test]
fn a_report_of_anybody_moves_no_cursor_and_forges_no_line() {
    let folder = tempfile::tempdir().unwrap();
    let mut report = serde_json::to_value(sample::every_verdict()).unwrap();
    spoil(&mut report, "\u{1b}[2J\r\nFORGED\u{2028}FORGED\u{202e}\u{200b}\u{9b}\0");
    fs::write(folder.path().join("report.json"), report.to_string()).unwrap();
    let formats = ["text", "markdown", "html"];
    let targets = formats.map(|format| format!("--report={format}=out.{format}"));
    for command in [&["render", "report.json"][..], &["compare", "report.json", "report.json"]] {
        let mut arguments = vec!["report"];
        arguments.extend(command);
        arguments.extend(targets.iter().map(String::as_str));
        let (status, stdout, stderr) = actucheck(folder.path(), &arguments);
        assert_eq!((status, stderr.as_str()), (0, ""));
        let files = formats.map(|format| folder.path().join(format!("out.{format}")));
        let files = files.map(|file| fs::read_to_string(file).unwrap());
        for text in files.iter().chain([&stdout]) {
            assert!(text.contains("FORGED"), "{text}");
            for line in text.split('\n') {
                assert!(!hides(line), "{command:?}: {line:?}");
                let forged = line.starts_with("FORGED");
                assert!(!forged, "{command:?}: {line:?}");
            }
        }
    }
}

/// A check whose requirement and register are in YAML's double quotes.
fn check(requirement: &str, register: &str) -> String {
    format!(
        r#"version: 1
checks:
- id: a/value
  requirement: "{requirement}"
  level: must
  source: "ja40 §1 (meaning)"
  request: {{op: value, wire: dynamixel2, device: ja40, register: "{register}", address: 65, size: 1,
    unit: null, value: {{number: 7.0}}}}
  demand: {{yield: {{bytes: "07"}}}}
"#
    )
}

#[test]
fn a_check_of_anybody_has_no_text_that_does_not_show() {
    let folder = tempfile::tempdir().unwrap();
    let replay = |requirement, register| {
        fs::write(folder.path().join("checks.yaml"), check(requirement, register)).unwrap();
        let (status, _, stderr) = actucheck(folder.path(), &["replay", "checks.yaml"]);
        (status, stderr)
    };
    let hostile = r"x\e[2J\r\nFORGED\u2028\u202e";
    for (requirement, register) in [(hostile, "LED"), ("a", hostile)] {
        let (status, stderr) = replay(requirement, register);
        assert_eq!(status, 2, "{stderr}");
        let sentence = r"FORGED\u{2028}\u{202e}` has characters that do not show";
        assert!(stderr.contains(sentence), "{stderr}");
        assert_eq!(stderr.split('\n').find(|it| hides(it) || it.starts_with("FORGED")), None);
    }
}
