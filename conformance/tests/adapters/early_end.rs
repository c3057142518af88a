//! Runs that end early, and their reports.

use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

use super::{WELL_BEHAVED, check_with};

const WRONG: &str = r#"printf '{"id":%s,"ok":{"crc":1}}\n' "$id""#;

#[test]
fn a_run_ends_after_so_many_failures() {
    let run = check_with(&["--max-fail", "3"], &WELL_BEHAVED.replace("ANSWER", WRONG));
    assert_eq!((run.exit(), run.total("fail")), (1, 3));
    assert_eq!(run.report["stopped"], "max-fail");
    assert!(run.report["left"].as_u64().unwrap() > 0);
}

#[test]
fn expected_failures_do_not_count_towards_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("expected.yaml");
    std::fs::write(&file, "expected_failures: [{ids: ['*/crc'], reason: no CRC}]").unwrap();
    let options = ["--max-fail", "1", "--expect", file.to_str().unwrap()];
    let run = check_with(&options, &WELL_BEHAVED.replace("ANSWER", WRONG));
    assert_eq!((run.exit(), run.total("expected-failure")), (0, run.sum()));
    assert!(run.report["stopped"].is_null(), "{}", run.report["stopped"]);
}

/// Answers every CRC with that of a Ping to device 1, which is right for a few packets.
#[test]
fn two_rows_may_name_the_same_failures() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("expected.yaml");
    let row = "{ids: ['*/crc'], reason: no CRC}";
    std::fs::write(&file, format!("expected_failures: [{row}, {row}]")).unwrap();
    let constant = WRONG.replace(r#""crc":1"#, r#""crc":19993"#);
    let options = ["--expect", file.to_str().unwrap()];
    let run = check_with(&options, &WELL_BEHAVED.replace("ANSWER", &constant));
    assert!(run.total("pass") > 0 && run.total("expected-failure") > 0, "{:?}", run.report);
    assert_eq!((run.exit(), run.total("unexpected-pass")), (0, 0));
}

/// How a run ended that was interrupted.
struct Interrupted {
    took: Duration,
    status: Option<i32>,
    folder: TempDir,
    stdout: String,
    stderr: String,
}

/// How long a run may take to end, and how long before it is killed.
const SECOND: Duration = Duration::from_secs(1);
const PATIENCE: Duration = Duration::from_secs(20);

fn interrupt(run: &Child) {
    let pid = run.id().to_string();
    assert!(Command::new("kill").args(["-INT", &pid]).status().unwrap().success());
}

/// Asks CRCs, and waits for long.
const CODEC: [&str; 9] = [
    "codec",
    "--select",
    "ja40.*/crc",
    "--timeout",
    "600",
    "--start-timeout",
    "600",
    "--report",
    "json=report.json",
];

/// Waits for the end of a run.
fn end(run: &mut Child) -> Option<i32> {
    let patience = Instant::now() + PATIENCE;
    loop {
        if let Some(status) = run.try_wait().unwrap() {
            return status.code();
        }
        if Instant::now() > patience {
            run.kill().unwrap();
        }
        sleep(Duration::from_millis(5));
    }
}

impl Interrupted {
    /// Runs the program with an adapter, and interrupts it when the adapter has written so many lines
    /// to `asked`: twice at once, as a person in a hurry does.
    fn once(arguments: &[&str], script: &str, lines: usize) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let output = |name| std::fs::File::create(folder.path().join(name)).unwrap();
        let mut run = Command::new(env!("CARGO_BIN_EXE_actucheck"))
            .current_dir(folder.path())
            .args(arguments)
            .args(["--", "sh", "-c", &format!("echo $$ >>started\n{script}")])
            .stdout(output("stdout"))
            .stderr(output("stderr"))
            .spawn()
            .unwrap();
        let patience = Instant::now() + PATIENCE;
        let asked = || std::fs::read(folder.path().join("asked")).map_or(0, |lines| lines.len());
        while asked() < lines {
            assert!(Instant::now() < patience, "nothing was asked");
            sleep(Duration::from_millis(10));
        }
        let interrupted = Instant::now();
        interrupt(&run);
        sleep(Duration::from_millis(20));
        interrupt(&run);
        let status = end(&mut run);
        let took = interrupted.elapsed();
        let text = |name| std::fs::read_to_string(folder.path().join(name)).unwrap();
        let (stdout, stderr) = (text("stdout"), text("stderr"));
        Self { took, status, folder, stdout, stderr }
    }

    /// The same, and it ends within a second, unless this machine is busy three times in a row.
    fn of(arguments: &[&str], script: &str, lines: usize) -> Self {
        let mut run = Self::once(arguments, script, lines);
        for _ in 0..2 {
            if run.took > SECOND && run.status.is_some() {
                run = Self::once(arguments, script, lines);
            }
        }
        assert!(run.took < SECOND, "{:?} for {arguments:?} and {script}", run.took);
        let started = std::fs::read_to_string(run.folder.path().join("started")).unwrap();
        for process in started.lines() {
            let mut probe = Command::new("kill");
            let is_there = probe.args(["-0", process]).stderr(Stdio::null()).status().unwrap();
            assert!(!is_there.success(), "an adapter is left by {script}");
        }
        run
    }

    fn report(&self) -> Value {
        let text = std::fs::read_to_string(self.folder.path().join("report.json")).unwrap();
        serde_json::from_str(&text).unwrap()
    }
}

#[test]
fn ctrl_c_ends_a_run_within_a_second_with_a_report() {
    let answers = WELL_BEHAVED.replace("ANSWER", &format!("echo >>asked; sleep 0.1; {WRONG}"));
    let hangs = WELL_BEHAVED.replace(
        "ANSWER",
        &format!("if [ \"$id\" -gt 2 ]; then echo >>asked; sleep 600; else {WRONG}; fi"),
    );
    let takes_eight = hangs.replace(r#""ops":["#, r#""max_in_flight":8,"ops":["#);
    // The first process is right twice and then wrong; the second one does not answer.
    let is_first = "first=; mkdir first 2>&- && first=1\n";
    let again = WELL_BEHAVED.replace(
        "ANSWER",
        &format!("if [ $first ]; then {WRONG}; else echo >>asked; sleep 600; fi"),
    );
    let starts_again = format!("{is_first}[ $first ] || {{ echo >>asked; sleep 600; }}\n{again}");
    let again = format!("{is_first}{again}");
    let cases = [
        (&[][..], &answers, 3),
        (&[], &hangs, 1),
        (&["--jobs", "4"], &hangs, 4),
        (&[], &takes_eight, 1),
        (&[], &again, 1),
        (&[], &starts_again, 1),
    ];
    std::thread::scope(|scope| {
        for (options, script, lines) in &cases {
            scope.spawn(move || {
                let run = Interrupted::of(&[&CODEC, *options].concat(), script, *lines);
                let report = run.report();
                assert_eq!(report["stopped"], "interrupted", "{}", run.stderr);
                let totals = &report["totals"];
                assert!(totals["fail"].as_u64().unwrap() > 0, "{totals} of {script}");
                let others = ["timeout", "flaky", "crash", "not-run", "adapter-fault"];
                assert!(others.iter().all(|verdict| totals[*verdict] == 0), "{totals} of {script}");
                assert!(report["left"].as_u64().unwrap() > 0);
                assert_eq!(run.status, Some(1), "what failed still counts");
            });
        }
    });
}

#[test]
fn ctrl_c_ends_an_adapter_that_does_not_start() {
    let run = Interrupted::of(
        &[&CODEC[..], &["--report=junit=j.xml"]].concat(),
        "echo >>asked; sleep 600",
        1,
    );
    assert_eq!(run.status, Some(4), "{}", run.stderr);
    let sentence = "had not said hello when the program was interrupted";
    assert!(run.stderr.contains(sentence), "{}", run.stderr);
    let junit = std::fs::read_to_string(run.folder.path().join("j.xml")).unwrap();
    assert!(junit.contains(sentence) && !run.folder.path().join("report.json").exists(), "{junit}");
}

#[test]
fn ctrl_c_ends_a_replay_too() {
    let mut arguments = vec!["replay", "ja40.reboot.instruction/crc"];
    arguments.extend(["--after", "ja40.ping.instruction/crc"].repeat(60));
    let script = WELL_BEHAVED.replace("ANSWER", &format!("echo >>asked; sleep 0.05; {WRONG}"));
    let run = Interrupted::of(&arguments, &script, 3);
    assert_eq!(run.status, Some(3), "{}", run.stdout);
    assert!(run.stdout.contains("interrupted"), "{}", run.stdout);
}

#[test]
fn an_adapter_is_not_at_fault_for_ctrl_c() {
    let hangs = WELL_BEHAVED.replace("ANSWER", "echo >>asked; sleep 600");
    for script in [&hangs, "echo >>asked; sleep 600"] {
        let arguments = ["adapter", "check", "--timeout", "600", "--start-timeout", "600"];
        let run = Interrupted::of(&arguments, script, 1);
        assert_eq!((run.status, run.stdout.as_str()), (Some(3), ""), "{}", run.stderr);
        let sentence = "interrupted; the adapter was not checked to its end";
        assert!(run.stderr.contains(sentence), "{}", run.stderr);
    }
}

/// A pipe takes less than the report has, so that the run waits for its reader.
#[test]
fn ctrl_c_while_a_report_is_written_leaves_it_whole() {
    for times in [1, 2] {
        let folder = tempfile::tempdir().unwrap();
        let pipe = folder.path().join("pipe");
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let mut run = Command::new(env!("CARGO_BIN_EXE_actucheck"))
            .args(["codec", "--select", "ja40.*", "--select", "*.basic.*", "--select", "*.open.*"])
            .arg(format!("--report=json={}", pipe.display()))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let mut report = std::fs::File::open(&pipe).unwrap();
        let mut text = vec![0];
        report.read_exact(&mut text).unwrap();
        for _ in 0..times {
            interrupt(&run);
            // Another one counts when no adapter can be there any more.
            sleep(SECOND + Duration::from_millis(100));
        }
        if times == 1 {
            assert_eq!(run.try_wait().unwrap(), None);
            report.read_to_end(&mut text).unwrap();
            let report: Value = serde_json::from_slice(&text).unwrap();
            assert_eq!((report["left"].as_u64(), end(&mut run)), (Some(0), Some(0)));
        } else {
            // Nobody reads.
            assert_eq!(end(&mut run), Some(130));
        }
    }
}

#[test]
fn a_trace_has_every_line_in_both_directions() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("trace");
    let options = ["--trace", file.to_str().unwrap(), "--max-fail", "1"];
    check_with(&options, &WELL_BEHAVED.replace("ANSWER", WRONG));
    let trace = std::fs::read_to_string(file).unwrap();
    let starts: Vec<_> = trace.lines().map(|line| line.get(..11).unwrap()).collect();
    let expected = [
        r#"1> {"id":0,"#,
        r#"1< {"id":0,"#,
        r#"1> {"id":1,"#,
        r#"1< {"id":1,"#,
        r#"1> {"id":2,"#,
        r#"1< {"id":2,"#,
        // What failed is asked again in another process.
        r#"0> {"id":0,"#,
        r#"0< {"id":0,"#,
        r#"0> {"id":1,"#,
        r#"0< {"id":1,"#,
        r#"0> {"id":2,"#,
        r#"1> {"id":3,"#,
    ];
    assert_eq!(starts, expected);
    assert!(trace.ends_with("\"op\":\"bye\"}\n"), "{trace}");
}
