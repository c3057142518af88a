//! `actucheck adapter check`: each kind of bad adapter fails at the right point.

use std::process::Command;

/// An adapter without a fault, whose library knows one CRC.
const GOOD: &str = r#"
while read -r line; do
    id=${line#'{"id":'} id=${id%%,*}
    case $line in
        *'"op":"hello"'*) printf '{"id":%s,"ok":{"protocol":1,"implementation":{"name":"fake","version":"1","language":"sh"},"wires":["dynamixel2"],"ops":["crc"]}}\n' "$id" ;;
        *'"op":"bye"'*) exit ;;
        *'"op":"crc"'*'"wire":"dynamixel2"'*) printf '{"id":%s,"ok":{"crc":35274}}\n' "$id" ;;
        *) printf '{"id":%s,"skip":{"reason":"unknown"}}\n' "$id" ;;
    esac
done
"#;

/// The exit status and the output.
fn check(script: &str) -> (i32, String) {
    check_with(&[], script)
}

/// The same with more options.
fn check_with(options: &[&str], script: &str) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_actucheck"))
        .args(["adapter", "check", "--timeout", "1.5", "--start-timeout", "2"])
        .args(options)
        .args(["--", "sh", "-c", script])
        .output()
        .unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stdout).unwrap())
}

#[test]
fn a_good_one_is_good() {
    let (status, text) = check(GOOD);
    assert_eq!(status, 0, "{text}");
    insta::assert_snapshot!(text.replace(GOOD, "GOOD"), @r"
      ok     starts and says who it is (fake 1 (sh), dynamixel2: crc)
      ok     says what makes sense
      ok     skips an op that it does not know
      ok     skips a wire that it does not know
      ok     skips what it does not offer
      ok     answers crc on dynamixel2
      ok     takes what is valid
      ok     answers the same when asked again
      ok     passes over a field that it does not know
      ok     outlives requests that lack a field
      ok     answers as many at once as it says (max_in_flight is 1)
      ok     reads a long line
      ok     runs beside another of its kind
      ok     writes nothing but replies
      ok     ends at bye

    well  check its library next: actucheck codec -- sh -c GOOD
    ");
}

#[test]
fn what_is_wrong_is_told_with_the_lines_and_what_to_do() {
    let (status, text) =
        check(&GOOD.replace(ANSWER, r#"printf '{"id":%s,"ok":{"crc":"89ca"}}\n' "$id""#));
    assert_eq!(status, 1, "{text}");
    let told: Vec<_> = text.lines().skip(5).take(4).collect();
    let told = told.join("\n");
    let (id, _) = told.split_once("{\"id\":").unwrap().1.split_once(',').unwrap();
    insta::assert_snapshot!(told.replace(&format!("\"id\":{id},"), "\"id\":ID,"), @r#"
      WRONG  answers crc on dynamixel2: `ok` does not fit crc: invalid type: string "89ca", expected u64
             sent  {"id":ID,"op":"crc","wire":"dynamixel2","bytes":"fffffd0001090003740000020000"}
             got   {"id":ID,"ok":{"crc":"89ca"}}
             mend  `actucheck adapter guide` has a table of what `ok` holds; here it is {"crc":35274}
    "#);
}

#[test]
fn a_wrong_answer_in_the_right_form_is_left_to_the_suite() {
    let (status, text) = check(&GOOD.replace("35274", "1"));
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("answers crc on dynamixel2 (another answer than the document has"));
}

/// The parts of the good adapter: what it offers, a CRC, a skip, and its end.
const OPS: &str = r#""ops":["crc"]"#;
const ANSWER: &str = r#"printf '{"id":%s,"ok":{"crc":35274}}\n' "$id""#;
const SKIP: &str = r#"printf '{"id":%s,"skip":{"reason":"unknown"}}\n' "$id""#;
const BYE: &str = "exit ;;";

/// A change of the good adapter, the exit status, and the first wrong point.
type Bad<'a> = (&'a [(&'a str, &'a str)], i32, &'static str);

/// Checks that each bad adapter fails at the right point. Most of the time is waiting.
fn found(bad: &[Bad<'_>]) {
    std::thread::scope(|scope| {
        for (changes, status, point) in bad {
            scope.spawn(move || {
                let (exit, text) = check(&changed(changes));
                let wrong = text.lines().find(|line| line.contains("WRONG")).unwrap_or_default();
                assert!(wrong.starts_with(&format!("  WRONG  {point}")), "{point}\n{text}");
                assert_eq!(exit, *status, "{point}\n{text}");
            });
        }
    });
}

fn changed(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(GOOD.to_owned(), |script, (from, to)| {
        assert!(script.contains(from), "{from}");
        script.replace(from, to)
    })
}

#[test]
fn a_bad_start_is_found() {
    found(&[
        (
            &[("while", "echo oh no >&2; exit 3; while")],
            4,
            "starts and says who it is: it ended with exit status: 3",
        ),
        (&[("while", "sleep 60; while")], 4, "starts and says who it is: there was no reply"),
        (
            &[("while", "echo hello; while")],
            4,
            "starts and says who it is: the reply is no JSON object",
        ),
        (
            &[(r#","language":"sh""#, "")],
            4,
            "starts and says who it is: `ok` is incomplete: missing field `language`",
        ),
        (
            &[(r#""protocol":1"#, r#""protocol":99"#)],
            4,
            "starts and says who it is: it speaks version 99",
        ),
        (
            &[(r#""ok":{"protocol""#, r#""skip":{"protocol""#)],
            4,
            "starts and says who it is: `skip` has no `reason`",
        ),
    ]);
}

/// The good adapter in version 2.
const NEW: &[(&str, &str)] = &[(r#""protocol":1"#, r#""protocol":2,"roles":["host"]"#)];

#[test]
fn what_makes_no_sense_is_found() {
    let (status, text) = check(&changed(NEW));
    assert_eq!(status, 0, "{text}");
    assert!(text.contains("(fake 1 (sh), host on dynamixel2: crc)"), "{text}");
    let limits = r#"["crc"],"limits""#;
    let point = "says what makes sense";
    let cases = [
        (r#"["crc"]"#, r#"["crc","sing"]"#.to_owned(), "`ops` names `sing`"),
        (r#"["dynamixel2"]"#, r#"["can"]"#.to_owned(), "`wires` names `can`"),
        (r#""roles":["host"],"#, String::new(), "`roles` names neither"),
        (r#"["host"]"#, r#"["codec","host"]"#.to_owned(), "`roles` names `codec`"),
        (r#"["host"]"#, "[]".to_owned(), "`roles` names neither"),
        (r#"["crc"]"#, format!(r#"{limits}:{{"max_send":9}}"#), "`limits.max_send` is 9"),
        (
            r#"["crc"]"#,
            format!(r#"{limits}:{{"max_packet":30,"max_send":10,"max_receive":20}}"#),
            "`limits.max_packet` is 30 beside",
        ),
        (r#"["crc"]"#, r#"["crc"],"max_in_flight":0"#.to_owned(), "`max_in_flight` is 0"),
    ];
    std::thread::scope(|scope| {
        for (from, to, what) in cases {
            scope.spawn(move || {
                let (status, text) = check(&changed(NEW).replace(from, &to));
                assert!(text.contains(&format!("  WRONG  {point}: {what}")), "{text}");
                assert_eq!(status, 1, "{text}");
                assert!(text.contains(r#"got   {"id":0,"ok":{"protocol":2"#), "{text}");
            });
        }
    });
}

/// Answers for every packet what a Write encodes, and for every frame what a Read is answered.
const BOTH_ROLES: &str = r#"*'"op":"encode"'*) printf '{"id":%s,"ok":{"bytes":"fffffd0001090003740000020000ca89"}}\n' "$id" ;;
        *'"op":"decode"'*) printf '{"id":%s,"ok":{"packet":{"kind":"status","id":1,"error":0,"params":"a6000000"}}}\n' "$id" ;;
        *'"op":"crc"'"#;

/// The changes that make the good adapter answer encode and decode, in this role.
fn playing(role: &str) -> String {
    changed(NEW)
        .replace(r#""host""#, &format!("{role:?}"))
        .replace(OPS, r#""ops":["crc","encode","decode"]"#)
        .replace(r#"*'"op":"crc"'"#, BOTH_ROLES)
}

#[test]
fn one_that_answers_for_the_other_role_is_found() {
    for role in ["host", "device"] {
        let (status, text) = check(&playing(role));
        let wrong = "WRONG  skips what only the other role does: the reply is no `skip`";
        assert!(text.contains(wrong), "{text}");
        assert_eq!(status, 1);
    }
}

#[test]
fn one_that_rejects_or_fails_all_is_found() {
    let err = r#"printf '{"id":%s,"err":{"class":"unspecified"}}\n' "$id""#;
    let rejecting = check(&changed(&[(ANSWER, err)]));
    let wrong =
        "WRONG  takes what is valid: each crc on dynamixel2 is rejected, though it is valid";
    assert!(rejecting.1.contains(wrong), "{}", rejecting.1);
    assert_eq!(rejecting.0, 1);
    let building = playing("device").replace(r#"["crc","encode","decode"]"#, r#"["crc","encode"]"#);
    let (status, text) = check(&building);
    assert!(text.contains("WRONG  takes what is valid: no packet is built right"), "{text}");
    assert_eq!(status, 1);
}

#[test]
fn every_line_is_printed_if_wanted() {
    let (status, text) = check_with(&["-v"], GOOD);
    assert_eq!(status, 0, "{text}");
    let count = |what: &str| text.lines().filter(|line| line.starts_with(what)).count();
    let (sent, got) = (count("         sent  {"), count("         got   {"));
    assert!(sent > 20, "{text}");
    assert_eq!(sent, got + 1, "nothing is replied to bye");
    let (_, text) = check(&changed(&[(SKIP, ANSWER)]).replace("35274", "\u{1b}"));
    assert!(!text.contains('\u{1b}'), "{text:?}");
}

#[test]
fn a_bad_reply_is_found() {
    let bad = [
        (r#"printf '{"id":%s}\n' "$id""#, "answers crc on dynamixel2: the reply has none"),
        ("sleep 60", "answers crc on dynamixel2: there was no reply within 1.5 s"),
        ("exit 1", "answers crc on dynamixel2: it ended with exit status: 1"),
    ];
    let changes = bad.map(|(reply, _)| [(ANSWER, reply)]);
    let bad: Vec<Bad<'_>> = changes
        .iter()
        .zip(bad)
        .map(|(changes, (_, point))| (changes.as_slice(), 1, point))
        .collect();
    found(&bad);
}

#[test]
fn what_is_not_skipped_is_found() {
    let stuff =
        r#"*'"op":"stuff"'*) printf '{"id":%s,"ok":{"bytes":""}}\n' "$id" ;; *'"op":"crc"'"#;
    found(&[
        (&[(SKIP, ANSWER)], 1, "skips an op that it does not know: the reply is no `skip`"),
        (
            &[(r#"*'"wire":"dynamixel2"'"#, "")],
            1,
            "skips a wire that it does not know: the reply is no",
        ),
        (&[(r#"*'"op":"crc"'"#, stuff)], 1, "skips what it does not offer: the reply is no `skip`"),
    ]);
}

#[test]
fn bytes_in_capitals_are_found() {
    let stuff =
        r#"*'"op":"stuff"'*) printf '{"id":%s,"ok":{"bytes":"00FF"}}\n' "$id" ;; *'"op":"crc"'"#;
    found(&[(
        &[(OPS, r#""ops":["crc","stuff"]"#), (r#"*'"op":"crc"'"#, stuff)],
        1,
        "answers stuff on dynamixel2: `bytes` has a `F` in it",
    )]);
}

#[test]
fn one_that_tells_requests_apart_wrongly_is_found() {
    let twice = format!("{ANSWER}; {ANSWER}");
    let counting = r#"n=$((n + 1)); printf '{"id":%s,"ok":{"crc":%s}}\n' "$id" "$n""#;
    // The first four requests are sent one at a time.
    let losing = format!("n=$((n + 1)); [ $n = 5 ] || {ANSWER}");
    found(&[
        (
            &[(ANSWER, &twice)],
            1,
            "answers the same when asked again: this is another reply to request",
        ),
        (
            &[(ANSWER, counting)],
            1,
            "answers the same when asked again: crc on dynamixel2 is answered",
        ),
        (
            &[(OPS, r#""ops":["crc"],"max_in_flight":3"#), (ANSWER, &losing)],
            1,
            "answers as many at once as it says: there was no reply",
        ),
    ]);
}

#[test]
fn one_that_reads_requests_wrongly_is_found() {
    let strict = format!("case $line in *no-such-field*) {SKIP} ;; *) {ANSWER} ;; esac");
    let trusting = format!("case $line in *bytes*) {ANSWER} ;; *) exit 1 ;; esac");
    let short = format!("[ ${{#line}} -gt 9000 ] || {SKIP}");
    found(&[
        (&[(ANSWER, &strict)], 1, "passes over a field that it does not know: crc on dynamixel2"),
        (&[(ANSWER, &trusting)], 1, "outlives requests that lack a field: it ended with exit"),
        (&[(SKIP, &short)], 1, "reads a long line: there was no reply within 1.5 s"),
    ]);
}

#[test]
fn one_that_is_alone_or_talks_or_stays_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let alone = format!("mkdir {}/lock || exit 1; while", folder.path().display());
    let talking = format!("{SKIP}; [ ${{#line}} -lt 9000 ] || echo 'what a long line'");
    let replying = format!("{SKIP} ;;");
    found(&[
        (&[("while", &alone)], 1, "runs beside another of its kind: the other one: it ended"),
        (&[(SKIP, &talking)], 1, "writes nothing but replies: it wrote a line that nobody"),
        (&[(BYE, ";;")], 1, "ends at bye: it runs on"),
        (&[(BYE, &replying)], 1, "ends at bye: it replied"),
    ]);
}
