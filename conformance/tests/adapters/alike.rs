//! A run and `adapter check` call the same replies wrong.

use std::process::Command;

use super::{WELL_BEHAVED, check_with};

/// What `adapter check` says.
fn check(script: &str) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["adapter", "check", "--timeout", "5", "--", "sh", "-c", script])
        .output()
        .unwrap();
    String::from_utf8(output.stdout).unwrap()
}

/// Whether it finds nothing wrong with the answers to one op of this adapter.
fn passes_check(op: &str, script: &str) -> bool {
    let text = check(script);
    let wrong = format!("  WRONG  answers {op} ");
    assert!(text.contains(&format!("answers {op} ")), "{text}");
    !text.contains(&wrong)
}

/// Whether a run finds no fault of the adapter itself.
fn passes_run(op: &str, script: &str) -> bool {
    let select = format!("ja40.*read*/{op}");
    let run = check_with(&["--select", &select], script);
    let mut of_op = run.outcomes.iter().filter(|check| check["id"].as_str().unwrap().ends_with(op));
    assert!(of_op.clone().count() > 1, "{}", run.stderr());
    of_op.all(|check| check["verdict"] != "adapter-fault")
}

#[test]
fn a_run_and_the_check_of_an_adapter_agree() {
    let packet = r#""kind":"status","id":1,"error":0"#;
    let decode = |fields: &str| format!(r#""ok":{{"packet":{{{packet},{fields}}}}}"#);
    let crc = |content: &str| ("crc", content.to_owned());
    let cases = [
        (crc(r#""ok":{"crc":1}"#), true),
        (crc(r#""ok":{"crc":1,"more":1}"#), true),
        (crc(r#""more":[1],"ok":{"crc":1}"#), true),
        (crc(r#""err":{"class":"crc","more":1}"#), true),
        (crc(r#""skip":{"reason":"","more":1}"#), true),
        (crc(r#""ok":{"crc":65536}"#), false),
        (crc(r#""ok":{"crc":1e99}"#), false),
        (crc(r#""ok":[1]"#), false),
        (crc(r#""ok":1"#), false),
        (crc(r#""skip":{}"#), false),
        (crc(r#""skip":"no""#), false),
        (crc(r#""err":["crc",""]"#), false),
        (crc(r#""err":{"class":"no-such-class"}"#), false),
        (("decode", decode(r#""params":"0a""#)), true),
        (("decode", decode(r#""params":"0A""#)), false),
        (("decode", decode(r#""params":"0a 0a""#)), false),
        (("decode", decode(r#""params":"0a","more":1"#)), false),
        (
            (
                "decode",
                r#""ok":{"packet":{"kind":"reply","address":1,"command":1,"data":""}}"#.to_owned(),
            ),
            false,
        ),
    ];
    std::thread::scope(|scope| {
        for ((op, content), right) in &cases {
            let answer = format!(r#"printf '{{"id":%s,{content}}}\n' "$id""#);
            let script = WELL_BEHAVED.replace("ANSWER", &answer);
            scope.spawn(move || {
                assert_eq!(passes_check(op, &script), *right, "adapter check: {content}");
                assert_eq!(passes_run(op, &script), *right, "codec: {content}");
            });
        }
    });
}

#[test]
fn a_line_before_the_reply_is_a_fault_of_the_adapter() {
    for line in ["", "[]", "note"] {
        let answer = format!(r#"printf '{line}\n{{"id":%s,"ok":{{"crc":1}}}}\n' "$id""#);
        let script = WELL_BEHAVED.replace("ANSWER", &answer);
        assert!(check(&script).contains("  WRONG  "), "adapter check: {line:?}");
        assert!(!passes_run("crc", &script), "codec: {line:?}");
    }
}
