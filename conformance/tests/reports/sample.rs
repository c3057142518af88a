//! Sample reports.

use std::collections::BTreeMap;
use std::sync::LazyLock;
use std::sync::atomic::AtomicBool;

use actucheck::adapter::{Hello, Implementation, Output, Question, Rejection};
use actucheck::report::model::Summary;
use actucheck::report::{Collector, End, Format, Report, Run, Stopped};
use actucheck::run::outcomes;
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck::suite::expect::Expectations;
use actucheck::suite::plan::Plan;
use actucheck::suite::{self, Options};
use actucheck::traffic::{Response, Spread, Traffic};
use actucheck::verdict::{After, Outcome, Verdict};
use actucheck_spec::Spec;
use actucheck_spec::model::{Fault, Level};
use actucheck_spec::wire::dynamixel2::Packet::{Instruction, Status};
use actucheck_spec::wire::dynamixel2::{self, reference};
use actucheck_spec::wire::{Packet, Wire};
use crc::{CRC_16_T10_DIF, Crc};

/// A name that must be escaped.
pub(crate) const NAME: &str = "<script>alert('odd')</script> & |co|";

/// The built-in codec under another name, with other answers.
pub(crate) struct Odd {
    codec: Builtin,
    hello: Hello,
    bend: fn(&Question, Answer) -> Answer,
}

impl Subject for Odd {
    fn hello(&self) -> &Hello {
        &self.hello
    }

    fn ask(&mut self, op: &Question) -> Answer {
        (self.bend)(op, self.codec.ask(op))
    }
}

/// Sends without byte stuffing, as several libraries do.
pub(crate) fn unstuffed(op: &Question, answer: Answer) -> Answer {
    match op {
        Question::Encode { packet, .. } => match &packet.packet {
            Packet::Dynamixel2(Instruction { id, instruction, params }) => {
                let body = [&[*instruction], params.0.as_slice()].concat();
                Answer::Ok(Output::Bytes(reference::frame(*id, &body).into()))
            }
            _ => answer,
        },
        _ => answer,
    }
}

/// Sends a CRC with another polynomial.
fn unknown_crc(op: &Question, answer: Answer) -> Answer {
    match (op, answer) {
        (Question::Encode { .. }, Answer::Ok(Output::Bytes(mut frame))) => {
            if let Some((before, sent)) = frame.0.split_last_chunk_mut() {
                *sent = Crc::<u16>::new(&CRC_16_T10_DIF).checksum(before).to_le_bytes();
            }
            Answer::Ok(Output::Bytes(frame))
        }
        (_, answer) => answer,
    }
}

/// Meets every verdict.
pub(crate) fn odd(op: &Question, answer: Answer) -> Answer {
    let said = || "<b>said</b> \u{1b}[31mthis\n```".to_owned();
    match (op, answer) {
        (Question::Crc { bytes, .. }, answer) => match bytes.len() {
            8 => Answer::TimedOut(said()),
            9 => Answer::Crashed(said()),
            11 => Answer::Faulty(said()),
            12 => Answer::NotAsked(said()),
            _ => answer,
        },
        (Question::Unstuff { .. }, _) => Answer::Skipped(said()),
        (_, Answer::Rejected(_)) => {
            Answer::Rejected(Rejection { class: Fault::Parameter, detail: said() })
        }
        (_, answer) => unstuffed(op, answer),
    }
}

pub(crate) static SPEC: LazyLock<Spec> = LazyLock::new(|| Spec::embedded().unwrap());
static COMMAND: LazyLock<[String; 2]> =
    LazyLock::new(|| ["./adapter", "two words"].map(str::to_owned));
pub(crate) const WIRES: [Wire; 1] = [dynamixel2::WIRE];
pub(crate) const OPTIONS: Options = Options { cases: 10, ..Options::new() };

/// Reads without taking the byte stuffing out.
fn left_in(op: &Question, answer: Answer) -> Answer {
    match (op, answer) {
        (
            Question::Decode { .. },
            Answer::Ok(Output::Packet(Packet::Dynamixel2(Status { id, error, params }))),
        ) => {
            let params = reference::stuff(&params).into();
            Answer::Ok(Output::Packet(Status { id, error, params }.into()))
        }
        (_, answer) => answer,
    }
}

impl Odd {
    pub(crate) fn new(name: &str, bend: fn(&Question, Answer) -> Answer) -> Self {
        let codec = Builtin::default();
        let mut hello = codec.hello().clone();
        hello.implementation = Implementation {
            name: name.to_owned(),
            version: "1.0".to_owned(),
            language: "C".to_owned(),
            url: None,
        };
        Self { codec, hello, bend }
    }
}

/// What an expected-failures file with these rows expects of a plan.
pub(crate) fn expectations(rows: &str, plan: &Plan<'_>) -> Expectations {
    let text = format!("expected_failures: {rows}\n");
    Expectations::parse("expected-failures.yaml", &text, plan, plan).unwrap()
}

fn report(name: &str, only: &str, bend: fn(&Question, Answer) -> Answer, expect: &str) -> Report {
    let mut plan = suite::plan(&SPEC, &WIRES, &OPTIONS);
    let not = ["*.stuffing.body.*".to_owned()];
    plan.restrict(&[only.to_owned()], &not, Level::May).unwrap();
    let subject = Odd::new(name, bend);
    let implementation = subject.hello.implementation.clone();
    let mut outcomes = outcomes(&mut [Box::new(subject)], &plan, &AtomicBool::new(false));
    make_flaky(&mut outcomes);
    let mut expectations = expectations(expect, &plan);
    let run = run(&implementation);
    let mut collector = Collector::new(&run);
    for mut outcome in outcomes {
        expectations.apply(&mut outcome);
        collector.add(outcome);
    }
    expectations.audit().unexpected().into_iter().for_each(|passes| collector.revise(passes));
    collector.finish(End { seconds: 1.5, ..End::default() })
}

/// Every other crash comes only after something else, a few of them after much else.
fn make_flaky(outcomes: &mut [Outcome]) {
    let crashes = outcomes.iter_mut().filter(|outcome| outcome.verdict == Verdict::Crash);
    for (place, outcome) in crashes.skip(1).step_by(2).enumerate() {
        let before = [outcome.id.as_str(), "dynamixel2.crc.ping/crc"].repeat(1 + place * 9);
        outcome.after = Some(After::of(&before));
        outcome.log = Some("==1==ERROR: <b>Sanitizer</b>\n\n    #0 in crc".to_owned());
        (outcome.verdict, outcome.because) = (Verdict::Flaky, None);
    }
}

/// A report in a format.
pub(crate) fn written(format: Format, report: &Report) -> String {
    let mut text = Vec::new();
    format.write(report, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

pub(crate) fn run(implementation: &Implementation) -> Run<'_> {
    Run {
        spec: &SPEC,
        date: "2026-11-27T11:00:00Z".to_owned(),
        command_line: "actucheck codec -- ./adapter 'two words'".to_owned(),
        implementation,
        wires: &WIRES,
        options: OPTIONS,
        part: None,
        port: None,
        again: &[],
        command: COMMAND.as_slice(),
        records: BTreeMap::new(),
    }
}

// Many tests look at the same report, and a run takes a while.

/// A report with a hostile name and every verdict.
pub(crate) fn every_verdict() -> Report {
    static KEPT: LazyLock<Report> = LazyLock::new(|| {
        let expect = "[{ids: [dynamixel2.stuffing.twice/encode], reason: '<i>known</i>'}, \
                       {ids: [ja40.ping.instruction/encode], reason: none}]";
        Report { log: "the last <em>words</em>".to_owned(), ..report(NAME, "*", odd, expect) }
    });
    KEPT.clone()
}

const FEW: &str = "*stuffing.goal-position/{encode,stuff,unstuff}";

/// A short report of an implementation that does not stuff.
pub(crate) fn small() -> Report {
    static KEPT: LazyLock<Report> = LazyLock::new(|| report("unstuffed", FEW, unstuffed, "[]"));
    KEPT.clone()
}

/// A whole report of an implementation that does not stuff.
pub(crate) fn unstuffed_whole() -> Report {
    static KEPT: LazyLock<Report> = LazyLock::new(|| report("unstuffed", "*", unstuffed, "[]"));
    KEPT.clone()
}

/// A whole report of an implementation whose CRC has a polynomial that no mistake has.
pub(crate) fn unknown_crc_whole() -> Report {
    report("unknown CRC", "*", unknown_crc, "[]")
}

/// A report without failures.
pub(crate) fn right() -> Report {
    static KEPT: LazyLock<Report> =
        LazyLock::new(|| report("right", "*", |_, answer| answer, "[]"));
    KEPT.clone()
}

/// A report of a device.
pub(crate) fn of_device() -> Report {
    let spread = |count, least_us, median_us, p99_us, most_us| Spread {
        count,
        least_us,
        median_us,
        p99_us,
        most_us,
    };
    let traffic = Traffic {
        pieces: 1234,
        sent: 20_000,
        received: 30_000,
        unasked: 7,
        response: Some(spread(300, 510, 700, 1500, 20_000)),
        by_instruction: vec![
            Response { instruction: "ping".to_owned(), spread: spread(100, 510, 520, 530, 540) },
            Response {
                instruction: "read".to_owned(),
                spread: spread(200, 600, 800, 1600, 20_000),
            },
        ],
    };
    let small = small();
    Report { summary: Summary { traffic: Some(traffic), ..small.summary }, ..small }
}

/// A report of an interrupted run.
pub(crate) fn interrupted() -> Report {
    let small = small();
    let summary = Summary { stopped: Some(Stopped::Interrupted), left: 7, ..small.summary };
    Report { summary, ..small }
}

/// A short report without failures.
pub(crate) fn small_right() -> Report {
    report("right", FEW, |_, answer| answer, "[]")
}

/// A report of an implementation that reads byte stuffing as data.
pub(crate) fn left_in_whole() -> Report {
    report("left in", "*", left_in, "[]")
}

/// A short report of the same.
pub(crate) fn leaves_stuffing_in() -> Report {
    report("left in", "*stuffing.*/decode", left_in, "[]")
}
