//! Adapters whose texts control a terminal, break lines and look like tags: they reach no output.

use std::fs;
use std::process::Command;

use super::WELL_BEHAVED;

/// In JSON: what would clear a terminal, begin a line, turn the script, hide, and be markup.
const HOSTILE: &str = concat!(
    r"\u001b[2J\u001b]0;title\u0007\u009b2J\u0000\u0008\r\n\n\u0085\u2028\u2029\u000b\u000c",
    r"\u061c\u200e\u200f\u202e\u2066\u2069\u200b\u200d\u2060\ufeff\ufffe\uffff\u007f\ud83d\ude00",
    r"FORGED</td></pre><script>x</script>]]>&lt;|`]`|**FORGED** @someone https://example.org",
);

const FORMATS: [&str; 6] = ["text", "json", "jsonl", "junit", "markdown", "html"];

/// Whether a terminal or a reader does not show a character as it is.
fn is_hidden(character: char) -> bool {
    let hidden = "\u{61c}\u{200b}\u{200d}\u{200e}\u{200f}\u{202e}\u{2028}\u{2029}\u{2060}\u{2066}\
                  \u{2069}\u{feff}\u{fffe}\u{ffff}";
    character.is_control() || hidden.contains(character)
}

/// Asserts that a text of ours has nothing in it that an adapter may not say.
fn assert_clean(what: &str, text: &str) {
    for line in text.split('\n') {
        assert!(!line.contains(is_hidden), "{what} has what is hidden: {line:?}");
        assert!(!line.trim_start().starts_with("FORGED"), "{what} has a forged line: {line}");
    }
}

fn script(answer: &str) -> String {
    // `printf` reads its format once.
    let hostile = HOSTILE.replace('\\', "\\\\");
    let named = |field: &str, old: &str| {
        (format!(r#""{field}":"{old}""#), format!(r#""{field}":"{hostile}""#))
    };
    let mut script = WELL_BEHAVED.to_owned();
    for (old, new) in [named("name", "fake"), named("version", "1"), named("language", "sh")] {
        script = script.replace(&old, &new);
    }
    script
        .replace(
            r#""ops":["crc","decode"]"#,
            &format!(r#""ops":["crc","decode","message","{hostile}"]"#),
        )
        .replace(
            r#""wires":["dynamixel2"]"#,
            &format!(r#""wires":["dynamixel2","innfos","{hostile}"]"#),
        )
        .replace(
            r#""protocol":1"#,
            &format!(r#""protocol":2,"roles":["host","device","{hostile}"]"#),
        )
        .replace("ANSWER", answer)
}

/// Prints an answer as it is, whatever `printf` would make of it.
fn answer(content: &str) -> String {
    format!("printf '{{\"id\":%s,%s}}\\n' \"$id\" '{content}'")
}

fn run(arguments: &[&str], script: &str) -> (tempfile::TempDir, String, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("adapter"), script).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .current_dir(folder.path())
        .args(arguments)
        .args(["--", "sh", "adapter"])
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (folder, text(output.stdout), text(output.stderr))
}

/// Every kind of text that an adapter can say.
fn answers() -> Vec<String> {
    let noise = "printf '\\033[2J\\rFORGED\\n\\342\\200\\256FORGED\\n\\233\\n' >&2; ";
    let contents = [
        format!(r#""err":{{"class":"crc","detail":"{HOSTILE}"}}"#),
        format!(r#""err":{{"class":"{HOSTILE}","detail":""}}"#),
        format!(r#""err":{{"class":"internal","detail":"{HOSTILE}"}}"#),
        format!(r#""skip":{{"reason":"{HOSTILE}"}}"#),
        format!(r#""ok":{{"crc":"{HOSTILE}","packet":{{"kind":"{HOSTILE}"}}}}"#),
        format!(
            r#""ok":{{"packet":{{"kind":"status","id":1,"error":0,"params":"","{HOSTILE}":0}}}}"#
        ),
        format!(r#""ok":{{"packet":{{"kind":"status","id":1,"error":0,"params":"{HOSTILE}"}}}}"#),
        format!(
            r#""ok":{{"message":{{"direction":"reply","address":6,"command":6,"value":{{"name":"{HOSTILE}"}}}}}}"#
        ),
        r#""err":{"class":"crc","detail":"\ud800"}"#.to_owned(),
    ];
    let replies = contents.iter().map(|content| format!("{noise}{}", answer(content)));
    let lines = ["printf '\\033[2J\\rFORGED\\233\\n'", "printf '\\377\\376FORGED\\n'"];
    replies.chain(lines.map(str::to_owned)).collect()
}

#[test]
fn no_report_says_what_moves_a_cursor_or_forges_a_line() {
    for answer in answers() {
        let reports = FORMATS.map(|format| format!("--report={format}=report.{format}"));
        let mut arguments = vec!["codec", "--max-fail", "40", "--trace", "trace", "--timeout", "5"];
        let select = ["--select", "ja40.*sync-read*/decode", "--select", "innfos.basic.*/message"];
        arguments.extend(select.into_iter().chain(reports.iter().map(String::as_str)));
        let (folder, stdout, stderr) = run(&arguments, &script(&answer));
        assert!(stdout.contains(r"\u{1b}"), "{stdout}{stderr}");
        assert_clean("standard output", &stdout);
        assert_clean("standard error", &stderr);
        for name in FORMATS
            .map(|format| format!("report.{format}"))
            .iter()
            .map(String::as_str)
            .chain(["trace"])
        {
            let text = fs::read_to_string(folder.path().join(name)).unwrap();
            assert_clean(name, &text);
            match name {
                "report.html" => assert!(!text.contains("<script>"), "{text}"),
                "report.junit" => drop(roxmltree::Document::parse(&text).unwrap()),
                "report.jsonl" => {
                    for line in text.lines() {
                        serde_json::from_str::<serde_json::Value>(line).unwrap();
                    }
                }
                "report.markdown" => {
                    for mark in ["<script>", "@someone", "https://example", "**FORGED**"] {
                        let free = text.lines().filter(|line| !line.starts_with("    "));
                        assert!(free.into_iter().all(|line| !line.contains(mark)), "{text}");
                    }
                }
                _ => {}
            }
        }
    }
}

#[test]
fn nor_do_other_commands() {
    for answer in answers() {
        let script = script(&answer);
        for arguments in [
            &["adapter", "check", "--verbose", "--timeout", "5"][..],
            &["fuzz", "--cases", "20", "--seed", "1", "--timeout", "5"],
            &["replay", "ja40.fast-sync-read.status/decode", "--timeout", "5"],
        ] {
            let (_folder, stdout, stderr) = run(arguments, &script);
            assert_clean(&format!("standard output of {arguments:?}"), &stdout);
            assert_clean("standard error", &stderr);
        }
    }
}

#[test]
fn nor_does_one_that_does_not_start() {
    for hello in [
        format!(r#"printf '%s\n' '{{"id":0,"ok":{{"protocol":"{HOSTILE}"}}}}'; sleep 9"#),
        "printf '\\033[2J\\rFORGED\\233\\n'; sleep 9".to_owned(),
        "printf '\\033[2J\\rFORGED\\n\\233\\n' >&2; exit 1".to_owned(),
    ] {
        for command in [&["codec"][..], &["adapter", "check"]] {
            let (_folder, stdout, stderr) = run(command, &hello);
            assert!(format!("{stdout}{stderr}").contains("FORGED"), "{stdout}{stderr}");
            assert_clean("standard output", &stdout);
            assert_clean("standard error", &stderr);
        }
    }
}
