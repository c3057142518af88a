//! What fails is asked again: whether it is a fact, and what brings it about.

use serde_json::Value;

use super::{Run, WELL_BEHAVED, check_with};

/// Answers as `$1` says where `BAD` holds, and rightly otherwise. `$n` counts the requests of the
/// process, `$bytes` are those of the request.
const MOSTLY_RIGHT: &str = r#"
    n=$((n + 1))
    bytes=${line#*'"bytes":"'} bytes=${bytes%%'"'*}
    if BAD; then
        WRONG
    else
        rest=$bytes
        crc=0
        while [ -n "$rest" ]; do
            more=${rest#??}
            crc=$((crc ^ (0x${rest%"$more"} << 8)))
            rest=$more
            for bit in 1 2 3 4 5 6 7 8; do
                crc=$(((crc << 1 ^ (crc >> 15) * 0x8005) & 0xffff))
            done
        done
        printf '{"id":%s,"ok":{"crc":%s}}\n' "$id" "$crc"
    fi
"#;

const WRONG: &str = r#"printf '{"id":%s,"ok":{"crc":1}}\n' "$id""#;

fn script(bad: &str, wrong: &str) -> String {
    WELL_BEHAVED.replace("ANSWER", &MOSTLY_RIGHT.replace("BAD", bad).replace("WRONG", wrong))
}

fn bad_if(bad: &str, wrong: &str) -> Run {
    check_with(&[], &script(bad, wrong))
}

impl Run {
    fn with(&self, verdict: &str) -> Vec<&Value> {
        self.outcomes.iter().filter(|outcome| outcome["verdict"] == verdict).collect()
    }

    /// The wrong answers of which it is known what brings them about. On a busy machine there are
    /// late ones too.
    fn known(&self) -> Vec<&Value> {
        let mut known = self.with("flaky");
        known.retain(|it| {
            !it["after"].is_null() && it["detail"].as_str().unwrap().starts_with("the answer")
        });
        known
    }

    /// The words of the first replay line of a flaky outcome.
    fn replay(&self) -> Option<Vec<String>> {
        let mut lines = self.with("flaky").into_iter();
        let line = lines.find_map(|outcome| outcome["replay"].as_str())?;
        shlex::split(line)
    }
}

#[test]
fn a_right_adapter_has_no_second_process() {
    let folder = tempfile::tempdir().unwrap();
    let started = format!("echo >>{}/$$;{}", folder.path().display(), script("false", ":"));
    let run = check_with(&[], &started);
    assert_eq!((run.exit(), run.total("pass")), (0, run.sum()), "{}", run.report["totals"]);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_counter_that_errs_now_and_then_accuses_no_check() {
    let run = bad_if("[ $((n % 5)) -eq 0 ]", WRONG);
    let totals = &run.report["totals"];
    assert_eq!((run.exit(), run.total("fail")), (1, 0), "{totals}");
    assert!(run.total("flaky") > 3 && run.total("pass") > 3 * run.total("flaky"), "{totals}");
    assert_eq!(run.report["causes"], Value::Array(Vec::new()));
    let known = run.known();
    assert!(!known.is_empty(), "{:?}", run.with("flaky"));
    for outcome in &known {
        assert_eq!(outcome["after"]["count"], 4, "{outcome}");
        assert_eq!(outcome["after"]["checks"].as_array().unwrap().len(), 4);
        assert!(outcome["detail"].as_str().unwrap().ends_with("fails after 4 earlier requests"));
    }
}

/// Also if it is not twice as many each time.
#[test]
fn what_a_counter_needs_is_found_whatever_its_number() {
    let run = bad_if("[ $((n % 7)) -eq 0 ]", WRONG);
    let known = run.known();
    assert_eq!(known.first().map(|it| &it["after"]["count"]), Some(&Value::from(6)), "{known:?}");
}

#[test]
fn what_is_broken_after_a_request_names_that_request() {
    let answer = script("[ -n \"$broken\" ]", WRONG).replace(
        "n=$((n + 1))",
        "case $line in *'\"bytes\":\"fffffd0001030001\"'*) late=1 ;; esac",
    );
    let answer = answer.replace("esac\ndone", "esac\n broken=$late\ndone");
    let run = check_with(&[], &answer);
    assert_eq!((run.exit(), run.total("fail")), (1, 0), "{}", run.report["totals"]);
    let words = run.replay().unwrap();
    let after = words.iter().filter(|word| *word == "--after").count();
    assert_eq!(after, 1, "{words:?}");
    // It fails when it is asked as the line says, and not without the request before it.
    let replay = |words: &[String]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_actucheck"));
        command.args(&words[1..]).output().unwrap().status.code()
    };
    assert_eq!(replay(&words), Some(1));
    let place = words.iter().position(|word| word == "--after").unwrap();
    let alone = [&words[..place], &words[place + 2..]].concat();
    assert_eq!(replay(&alone), Some(0));
}

#[test]
fn each_crash_is_a_finding_and_costs_no_other_check() {
    let died = "echo '==7==ERROR: AddressSanitizer: heap-buffer-overflow' >&2; exit 134";
    let run = bad_if("[ ${#bytes} -eq 16 ]", died);
    let totals = &run.report["totals"];
    assert!(run.total("crash") > 0 && run.exit() == 1, "{totals}");
    assert_eq!(run.total("crash") + run.total("pass"), run.sum(), "{totals}");
    for crash in run.with("crash") {
        assert_eq!(crash["log"], "==7==ERROR: AddressSanitizer: heap-buffer-overflow");
        assert!(crash["replay"].is_string() && crash["after"].is_null(), "{crash}");
    }
}

#[test]
fn one_that_hangs_now_and_then_is_asked_everything() {
    let run = bad_if("[ $((n % 20)) -eq 0 ]", "sleep 60");
    let totals = &run.report["totals"];
    assert_eq!((run.exit(), run.total("timeout"), run.total("not-run")), (1, 0, 0), "{totals}");
    assert!(run.total("flaky") > 0, "{totals}");
    assert!(run.detail("flaky").contains("--timeout gives it more"), "{}", run.detail("flaky"));
}

#[test]
fn one_that_ends_at_each_second_request_fails_after_one() {
    let run = bad_if("[ $n -gt 1 ]", "exit");
    let totals = &run.report["totals"];
    assert_eq!((run.exit(), run.total("crash")), (1, 0), "{totals}");
    assert_eq!(run.total("flaky") + run.total("pass"), run.sum(), "{totals}");
    let flaky = run.with("flaky");
    let mut counts = flaky.iter().map(|it| &it["after"]["count"]).filter(|it| !it.is_null());
    assert!(counts.clone().count() > 0 && counts.all(|count| *count == 1), "{flaky:?}");
}

#[test]
fn answers_that_change_by_themselves_are_seen() {
    let answer = script("[ $n -eq 30 ]", WRONG);
    let run = check_with(&["--repeat", "3"], &answer);
    assert_eq!((run.exit(), run.total("flaky")), (1, 1), "{}", run.report["totals"]);
    let detail = run.detail("flaky");
    assert!(detail.starts_with("asked in a row, it answers "), "{detail}");
    assert!(detail.contains(" and then 0x0001") || detail.contains("answers 0x0001, and then "));
    let once = check_with(&["--repeat", "3"], &script("false", ":"));
    assert_eq!((once.exit(), once.total("pass")), (0, once.sum()));
}
