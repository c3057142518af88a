//! Adapters that misbehave: the run ends in bounded time with a report and the right exit status.

use std::process::Command;
use std::time::{Duration, Instant};

use super::{WELL_BEHAVED, answering, check, check_with};

#[test]
fn one_that_skips_all_leaves_the_run_incomplete() {
    let run = answering(r#"printf '{"id":%s,"skip":{"reason":"no"}}\n' "$id""#);
    assert_eq!(run.exit(), 3);
    assert!(run.total("skip") > 10);
}

#[test]
fn a_wrong_answer_fails_with_both_values() {
    let run = answering(r#"printf '{"id":%s,"ok":{"crc":1}}\n' "$id""#);
    assert_eq!(run.exit(), 1);
    let text = String::from_utf8_lossy(&run.output.stdout).into_owned();
    assert!(text.contains("expected  0x4E19\n  got       0x0001"), "{text}");
}

#[test]
fn one_that_hangs_times_out_and_is_given_up() {
    let run = answering("sleep 60");
    assert_eq!(run.exit(), 1);
    assert_eq!(run.total("timeout"), 5 * run.requirements(), "five of each requirement");
    assert!(run.total("not-run") > 0);
    assert!(run.took < Duration::from_secs(20), "{:?}", run.took);
}

#[test]
fn one_that_dies_is_a_crash_with_its_status_and_log() {
    let run = answering("echo 'out of luck' >&2; exit 7");
    assert_eq!(run.exit(), 1);
    assert_eq!(run.detail("crash"), "the adapter ended with exit status: 7");
    let text = String::from_utf8_lossy(&run.output.stdout).into_owned();
    assert!(text.contains("log       out of luck"), "{text}");
}

#[test]
fn nothing_found_before_a_crash_is_lost() {
    let answer =
        r#"case $line in *2102*) exit 1 ;; *) printf '{"id":%s,"ok":{"crc":1}}\n' "$id" ;; esac"#;
    let run = answering(answer);
    assert_eq!(run.exit(), 1);
    assert!(run.total("fail") > 10, "{}", run.report["totals"]);
}

#[test]
fn garbage_is_an_adapter_fault() {
    let run = answering("echo hello there");
    assert_eq!(run.exit(), 3);
    assert!(run.detail("adapter-fault").contains("`hello there`"));
}

#[test]
fn a_reply_to_another_request_is_an_adapter_fault() {
    let run = answering(r#"printf '{"id":999999,"ok":{"crc":1}}\n'"#);
    assert_eq!(run.exit(), 3);
    assert!(
        run.detail("adapter-fault").starts_with("a reply to request 999999, which was not sent")
    );
}

#[test]
fn a_reply_with_ok_and_err_is_an_adapter_fault() {
    let answer = r#"printf '{"id":%s,"ok":{"crc":1},"err":{"class":"crc"}}\n' "$id""#;
    assert_eq!(answering(answer).total("pass"), 0);
    assert_eq!(answering(answer).exit(), 3);
}

#[test]
fn a_wrong_reply_to_the_right_request_costs_that_one_alone() {
    for reply in [r#""err":{"class":"no-such-class"}"#, r#""ok":{"crc":"much"}"#, r#""none":1"#] {
        let run = answering(&format!(r#"printf '{{"id":%s,{reply}}}\n' "$id""#));
        let faults = run.total("adapter-fault");
        assert_eq!((run.exit(), faults), (3, run.sum()), "{}", run.report["totals"]);
    }
}

#[test]
fn an_empty_line_is_called_one() {
    let run = answering("echo");
    assert_eq!(run.exit(), 3);
    assert!(run.detail("adapter-fault").starts_with("an empty line"), "{}", run.report);
}

#[test]
fn answering_an_op_that_does_not_exist_is_an_adapter_fault() {
    let script = WELL_BEHAVED
        .replace(r#"'{"id":%s,"skip":{"reason":"unknown"}}\n'"#, r#"'{"id":%s,"ok":{}}\n'"#)
        .replace("ANSWER", r#"printf '{"id":%s,"skip":{"reason":"no"}}\n' "$id""#);
    let run = check(&script);
    assert_eq!(run.exit(), 3);
    assert!(run.detail("adapter-fault").contains("must be answered with `skip`"));
}

#[test]
fn one_that_never_says_hello_is_not_started() {
    let started = Instant::now();
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["codec", "--start-timeout", "0.2", "--", "sleep", "60"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(4));
    let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(stderr.contains("did not say hello within 0.2 s"), "{stderr}");
    assert!(started.elapsed() < Duration::from_secs(5));
}

#[test]
fn one_that_ends_or_babbles_at_the_start_is_not_started() {
    let run = check("echo 'no module named x' >&2; exit 1");
    assert_eq!(run.exit(), 4);
    assert!(run.stderr().contains("ended before it said hello"), "{}", run.stderr());
    assert!(run.stderr().contains("no module named x"), "{}", run.stderr());
    let run = check("echo hi; sleep 60");
    assert_eq!(run.exit(), 4);
    assert!(run.stderr().contains("answered hello wrongly"), "{}", run.stderr());
}

/// An adapter of version 2 that says these things of itself.
fn saying(said: &str, answer: &str) -> super::Run {
    check(&WELL_BEHAVED.replace(r#""protocol":1"#, said).replace("ANSWER", answer))
}

#[test]
fn what_makes_no_sense_is_said_and_passed_over() {
    let wrong = r#"printf '{"id":%s,"ok":{"crc":1}}\n' "$id""#;
    let said = r#""protocol":2,"roles":["host","robot"],"limits":{"max_send":3}"#;
    let run = saying(said, wrong);
    assert_eq!(run.exit(), 1);
    for sentence in [
        "actucheck: the adapter says in hello: `roles` names `robot`; that is passed over\n",
        "`limits.max_send` is 3, and the shortest packet has 10 bytes; that is passed over\n",
    ] {
        assert_eq!(run.stderr().matches(sentence).count(), 1, "{}", run.stderr());
    }
}

#[test]
fn one_that_answers_for_the_other_role_is_named() {
    let packet = r#"{"kind":"status","id":1,"error":0,"params":""}"#;
    let both = format!(
        r#"case $line in
            *'"op":"crc"'*) printf '{{"id":%s,"ok":{{"crc":1}}}}\n' "$id" ;;
            *) printf '{{"id":%s,"ok":{{"packet":{packet}}}}}\n' "$id" ;;
        esac"#
    );
    let run = saying(r#""protocol":2,"roles":["host"]"#, &both);
    let sentence = "actucheck: the adapter plays host only, but answers decode of an instruction \
                    packet; what only the other role does is not asked\n";
    assert!(run.stderr().contains(sentence), "{}", run.stderr());
    let run = saying(r#""protocol":2,"roles":["host","device"]"#, &both);
    assert!(!run.stderr().contains("plays"), "{}", run.stderr());
}

/// One in a session of its own is in no group of the adapter's, and its parent has ended.
#[test]
#[cfg(target_os = "linux")]
fn its_children_in_a_session_of_their_own_end_with_it_too() {
    end_with_it("(setsid sh -c 'echo $$ > PID; exec sleep 600' &) ; sleep 600");
    end_with_it("(setsid sh -c 'echo $$ > PID; exec sleep 600' &) ; sleep 0.2; exit 1");
}

/// Runs an adapter that answers so, and writes the number of a child to `PID`.
fn end_with_it(answer: &str) {
    let folder = tempfile::tempdir().unwrap();
    let pid_file = folder.path().join("pid");
    let script = WELL_BEHAVED.replace("ANSWER", &answer.replace("PID", pid_file.to_str().unwrap()));
    // Two are enough, as each takes a second.
    let run = check_with(&["--max-fail", "2"], &script);
    assert_eq!(run.exit(), 1);
    let pid = std::fs::read_to_string(pid_file).unwrap();
    // A killed process that nobody waits for stays as a zombie, which counts as ended.
    let ended = || {
        let state = Command::new("ps").args(["-o", "stat=", "-p", pid.trim()]).output().unwrap();
        let state = String::from_utf8_lossy(&state.stdout).into_owned();
        state.trim().is_empty() || state.starts_with('Z')
    };
    let patience = Instant::now() + Duration::from_secs(5);
    while !ended() {
        assert!(Instant::now() < patience, "process {pid} is still there");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_wire_that_is_not_offered_is_an_error() {
    let script = WELL_BEHAVED.replace("ANSWER", ":");
    let refused = check_with(&["--wire", "innfos"], &script);
    assert_eq!(refused.exit(), 2);
    assert!(refused.stderr().contains("the adapter offers no innfos; it offers dynamixel2"));
    let none = check(&script.replace(r#"["dynamixel2"]"#, r#"["can"]"#));
    assert_eq!(none.exit(), 2);
    assert!(none.stderr().contains("no wire that this program knows: dynamixel2 and innfos"));
}
