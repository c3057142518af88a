//! Fuzzing finds the mutants too, without a list of checks, and shrinks the failures.

use std::collections::{BTreeMap, BTreeSet};
use std::iter;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use actucheck::adapter::{Hello, Question, Wire};
use actucheck::blackbox::{self, Asks, Finding, Fuzzed, Options, Symptom, fuzz};
use actucheck::run;
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck::suite::plan::Plan;
use actucheck::suite::saved;
use actucheck::verdict::Verdict;
use actucheck_spec::Spec;
use actucheck_spec::model::Role;
use actucheck_spec::wire::{Packet, dynamixel2};

use super::dynamixel2::MUTANTS;
use super::killing::{is_found, mutants};
use super::{LIMITS, Mutant, Mutated, Wrong};

fn several(subjects: Vec<Box<dyn Subject + Send>>, wire: Wire, seed: u64, cases: u64) -> Fuzzed {
    let spec = Spec::embedded().unwrap();
    let mut subjects = subjects;
    let options = Options { wire, seed, cases, asks: Asks::Codec, part: None };
    fuzz(&spec, &options, &mut subjects, &|_, _| ControlFlow::Continue(()))
}

fn fuzzed(subject: impl Subject + Send + 'static, seed: u64, cases: u64) -> Fuzzed {
    several(vec![Box::new(subject)], dynamixel2::WIRE, seed, cases)
}

/// The size of a question.
fn size(op: &Question) -> usize {
    serde_json::to_string(op).unwrap().len()
}

#[test]
fn nothing_is_found_in_the_builtin_codec() {
    for wire in Wire::ALL {
        let fuzzed = several(vec![Box::<Builtin>::default()], wire, 1, 4_000);
        assert_eq!(fuzzed.asked, 4_000);
        assert_eq!((fuzzed.findings, fuzzed.passing), (Vec::new(), Vec::new()));
        assert!(fuzzed.not_asked.is_empty(), "{:?}", fuzzed.not_asked);
    }
}

/// A Python adapter answers several thousand probes a second. This is a part of what it answers in
/// half a minute.
#[test]
fn every_mutant_is_found() {
    let spec = Spec::embedded().unwrap();
    // The limit of the mutants that have one.
    let mut hello = Builtin::default().hello().clone();
    hello.limits = LIMITS;
    let mut missed = Vec::new();
    for wire in Wire::ALL {
        let options = Options { wire, seed: 1, cases: 24_000, asks: Asks::Codec, part: None };
        let checks = blackbox::checks(&spec, &options, &hello);
        let ops: BTreeSet<_> = checks.iter().map(|check| check.question.name()).collect();
        // Those whose fault is in an op that is fuzzed.
        let asked: BTreeSet<_> = super::checks(wire)
            .into_iter()
            .filter(|check| ops.contains(check.question.name()))
            .map(|check| check.id)
            .collect();
        for mutant in mutants(wire).filter(|mutant| asked.contains(mutant.found_by)) {
            let last = iter::once(None).chain(checks.iter().map(|check| Some(&check.question)));
            let found = checks.iter().zip(last).any(|(check, last)| {
                let answer = mutant.wrong.answer(&check.question, last);
                answer.is_some_and(|answer| is_found(&check.clone().judge(answer)))
            });
            missed.extend((!found).then_some(mutant.name));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
}

/// A finding has the id of the probe that it was shrunk from.
#[test]
fn what_is_found_is_made_small_and_fails_as_before() {
    let spec = Spec::embedded().unwrap();
    let options =
        Options { wire: dynamixel2::WIRE, seed: 1, cases: 3_000, asks: Asks::Codec, part: None };
    let drawn = blackbox::checks(&spec, &options, Builtin::default().hello());
    let drawn: BTreeMap<_, _> = drawn.into_iter().map(|check| (check.id, check.question)).collect();
    for mutant in MUTANTS.iter().step_by(8) {
        let findings = fuzzed(Mutated::new(mutant), 1, 2_000).findings;
        for Finding { kind, check, outcome, .. } in &findings {
            let again = check.clone().judge(Mutated::new(mutant).ask(&check.question));
            assert_eq!(again, *outcome, "{}", mutant.name);
            assert_eq!((check.question.name(), &check.requirement), (kind.op, &kind.requirement));
            let (before, after) = (size(&drawn[&check.id]), size(&check.question));
            assert!(after <= before, "{}: {before} to {after}: {:?}", mutant.name, check.question);
        }
        let sizes = findings.iter().map(|finding| size(&finding.check.question));
        // A length of two bytes is 256 bytes, and twice as many digits; the call has them again.
        let smallest = sizes.min().filter(|size| *size < 1_400);
        assert!(smallest.is_some(), "{}: {findings:?}", mutant.name);
    }
}

#[test]
fn a_seed_finds_the_same_again_in_any_number_of_processes() {
    let mutant = &MUTANTS[0];
    let in_processes = |count: usize, seed| {
        let subject = || Box::new(Mutated::new(mutant)) as Box<dyn Subject + Send>;
        several((0..count).map(|_| subject()).collect(), dynamixel2::WIRE, seed, 150)
    };
    let first = in_processes(1, 7);
    assert!(!first.findings.is_empty());
    assert_eq!(first, in_processes(1, 7));
    assert_eq!(first, in_processes(3, 7));
    assert_ne!(first, in_processes(1, 8));
}

/// The verdicts on the saved findings, asked again.
fn again(findings: &[Finding], subject: Box<dyn Subject + Send>) -> Vec<Verdict> {
    let checks: Vec<_> = findings.iter().flat_map(Finding::checks).cloned().collect();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("findings.yaml");
    std::fs::write(&file, saved::write(&checks).unwrap()).unwrap();
    let read = saved::read(&file).unwrap();
    assert_eq!(read, checks);
    let outcomes = run::outcomes(&mut [subject], &Plan::of(read), &AtomicBool::new(false));
    outcomes.into_iter().map(|outcome| outcome.verdict).collect()
}

#[test]
fn what_was_found_is_kept_and_fails_again() {
    let mutant = &MUTANTS[0];
    let findings = fuzzed(Mutated::new(mutant), 1, 400).findings;
    assert!(!findings.is_empty());
    let verdicts = again(&findings, Box::new(Mutated::new(mutant)));
    assert!(verdicts.iter().all(|verdict| *verdict == Verdict::Fail), "{verdicts:?}");
    let verdicts = again(&findings, Box::<Builtin>::default());
    assert!(verdicts.iter().all(|verdict| *verdict == Verdict::Pass), "{verdicts:?}");
}

/// Rejects what comes after a long packet.
static FULL: Mutant = Mutant {
    name: "does not empty its buffer",
    blames: "",
    wrong: Wrong::RejectsAfter(
        |last| matches!(last, Question::Stuff { bytes, .. } if bytes.len() > 9),
    ),
    found_by: "",
    found_by_documents: false,
};

#[test]
fn a_failure_that_depends_on_what_came_before_is_told_with_it() {
    let Fuzzed { findings, passing, .. } = fuzzed(Mutated::new(&FULL), 1, 1_000);
    assert_eq!(passing, []);
    for finding in &findings {
        let [before] = finding.before.as_slice() else { panic!("{finding:?}") };
        let Question::Stuff { bytes, .. } = &before.question else { panic!("{before:?}") };
        assert_eq!(bytes.0, [0; 10]);
        assert_eq!(before.id, format!("{}.before-1", finding.check.id));
        let verdicts = again(std::slice::from_ref(finding), Box::new(Mutated::new(&FULL)));
        // It fails, or breaks a recommendation.
        assert_eq!((verdicts[0], verdicts[1] == Verdict::Pass), (Verdict::Pass, false));
    }
    assert!(findings.len() > 3, "{}", findings.len());
}

/// The built-in codec with other answers to some questions.
struct Other<F> {
    codec: Builtin,
    hello: Hello,
    answer: F,
}

impl<F: FnMut(&Question) -> Option<Answer>> Other<F> {
    fn new(answer: F) -> Self {
        let codec = Builtin::default();
        Self { hello: codec.hello().clone(), codec, answer }
    }
}

impl<F: FnMut(&Question) -> Option<Answer>> Subject for Other<F> {
    fn hello(&self) -> &Hello {
        &self.hello
    }

    fn ask(&mut self, op: &Question) -> Answer {
        (self.answer)(op).unwrap_or_else(|| self.codec.ask(op))
    }
}

#[test]
fn a_crash_is_a_finding_and_small() {
    let ending = Other::new(|op| match op {
        Question::Crc { bytes, .. } if bytes.contains(&0xFD) => {
            Some(Answer::Crashed(String::new()))
        }
        _ => None,
    });
    let findings = fuzzed(ending, 1, 1_000).findings;
    let [finding] = findings.as_slice() else { panic!("{findings:?}") };
    assert_eq!((finding.kind.op, &finding.kind.symptom), ("crc", &Symptom::Crashed));
    assert!(size(&finding.check.question) < 70, "{:?}", finding.check.question);
    assert!(finding.times > 10);
}

#[test]
fn what_does_not_happen_again_is_no_finding() {
    let mut asked = 0;
    let wrong = || Answer::Crashed(String::new());
    let seldom = Other::new(move |_| {
        asked += 1;
        (asked % 997 == 0).then(wrong)
    });
    let Fuzzed { findings, passing, .. } = fuzzed(seldom, 1, 1_500);
    assert_eq!(findings, []);
    assert!(!passing.is_empty());
}

/// Whether the question is to build a Write.
fn is_write(op: &Question) -> bool {
    let Question::Encode { packet, .. } = op else { return false };
    let Packet::Dynamixel2(packet) = &packet.packet else { return false };
    matches!(packet, dynamixel2::Packet::Instruction { instruction: 0x03, .. })
}

#[test]
fn what_is_skipped_is_asked_no_more() {
    let asked = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&asked);
    let mut host = Other::new(move |op| {
        assert_ne!(op.role(), Some(Role::Device));
        is_write(op).then(|| {
            count.fetch_add(1, Ordering::Relaxed);
            Answer::Skipped("it writes nothing".to_owned())
        })
    });
    host.hello.roles = vec![Role::Host];
    let fuzzed = fuzzed(host, 1, 2_000);
    assert_eq!((fuzzed.asked, fuzzed.findings), (2_000, Vec::new()));
    let batch_of_writes = 40;
    assert!(asked.load(Ordering::Relaxed) < batch_of_writes, "{asked:?}");
    let topics = |reason: &str| -> Vec<_> {
        let topics = fuzzed.not_asked.get(reason).into_iter().flatten();
        topics.map(ToString::to_string).collect()
    };
    assert_eq!(topics("it writes nothing"), ["encode Write"]);
    let device = topics("only a device does this, and the adapter plays no device");
    assert!(device.contains(&"encode fast status".to_owned()), "{device:?}");
    assert!(device.contains(&"decode Write".to_owned()), "{device:?}");
}

#[test]
fn an_adapter_that_skips_everything_ends_the_run() {
    let idle = Other::new(|_| Some(Answer::Skipped(String::new())));
    let fuzzed = fuzzed(idle, 1, 10_000);
    assert!(fuzzed.asked < 2_000, "{}", fuzzed.asked);
    let reason = "there is nothing to ask: the adapter skips every kind of question";
    assert_eq!(fuzzed.given_up.as_deref(), Some(reason));
}
