//! Several questions at once, to one adapter or to several.

use super::{WELL_BEHAVED, check_with};

/// An adapter that takes eight questions at once.
fn taking_eight(answer: &str) -> String {
    WELL_BEHAVED.replace(r#""ops":["#, r#""max_in_flight":8,"ops":["#).replace("ANSWER", answer)
}

const WRONG: &str = r#"printf '{"id":%s,"ok":{"crc":1}}\n' "$id""#;

#[test]
fn replies_may_come_in_any_order() {
    // Every other reply is late, so that other replies overtake it.
    let answer = format!(r"case $id in *[13579]) (sleep 0.05; {WRONG}) & ;; *) {WRONG} ;; esac");
    let run = check_with(&[], &taking_eight(&answer));
    assert_eq!((run.exit(), run.total("fail")), (1, run.sum()), "{}", run.report["totals"]);
}

#[test]
fn questions_are_outstanding_together() {
    // Nothing is answered before four questions have arrived; the last few questions get no answer.
    let answer = r#"printf '%s\n' "$id" >>"$IDS"
        if [ "$(wc -l <"$IDS")" -ge 4 ]; then
            while read -r id; do printf '{"id":%s,"skip":{"reason":"no"}}\n' "$id"; done <"$IDS"; : >"$IDS"
        fi"#;
    let folder = tempfile::tempdir().unwrap();
    let ids = folder.path().join("ids");
    let script = format!("IDS={}\n: >$IDS\n{}", ids.display(), taking_eight(answer));
    let run = check_with(&[], &script);
    let rest = run.sum() % 4;
    assert_eq!(run.total("skip"), run.sum() - rest, "{}", run.report["totals"]);
    assert_eq!(run.total("timeout"), rest, "{}", run.report["totals"]);
}

#[test]
fn a_crash_among_several_is_blamed_on_the_one_that_causes_it() {
    let answer =
        format!("case $line in *'\"bytes\":\"fffffd0001030001\"'*) exit 9 ;; *) {WRONG} ;; esac");
    let run = check_with(&[], &taking_eight(&answer));
    assert_eq!(run.total("crash"), 1, "{}", run.report["totals"]);
    assert_eq!(run.detail("crash"), "the adapter ended with exit status: 9");
    assert_eq!(run.total("fail"), run.sum() - 1);
}

#[test]
fn a_reply_twice_is_seen_among_several() {
    let run = check_with(&[], &taking_eight(&format!("{WRONG}; {WRONG}")));
    assert_eq!(run.exit(), 1);
    assert!(run.total("flaky") > 0, "{}", run.report["totals"]);
    let detail = run.detail("flaky");
    assert!(detail.contains("not the first one"), "{detail}");
}

#[test]
fn jobs_share_the_checks_and_keep_their_order() {
    let folder = tempfile::tempdir().unwrap();
    let script = WELL_BEHAVED
        .replace("ANSWER", &format!("echo >{}/$$; sleep 0.02; {WRONG}", folder.path().display()));
    let one = check_with(&[], &script);
    let started_by_one = std::fs::read_dir(folder.path()).unwrap().count();
    let three = check_with(&["--jobs", "3"], &script);
    let started = std::fs::read_dir(folder.path()).unwrap().count();
    assert!(started_by_one < started && started >= 4, "{started_by_one} {started}");
    assert!(!one.outcomes.is_empty() && one.outcomes == three.outcomes);
    assert_eq!(one.report["not_passed"], three.report["not_passed"]);
    assert!(three.took < one.took, "{:?} {:?}", three.took, one.took);
}
