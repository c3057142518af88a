//! Fuzzing finds the mutants too, without a list of checks, and shrinks the failures.

use std::ops::ControlFlow;

use actucheck::adapter::{Question, Wire};
use actucheck::blackbox::{Fuzzed, Symptom, fuzz};
use actucheck::run;
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck::suite::plan::Plan;
use actucheck::suite::saved;
use actucheck::verdict::Verdict;
use actucheck_spec::Spec;
use actucheck_spec::wire::dynamixel2;

use super::Mutated;
use super::dynamixel2::MUTANTS;

fn fuzzed(subject: &mut dyn Subject, seed: u64, cases: u64) -> Fuzzed {
    let spec = Spec::embedded().unwrap();
    fuzz(&spec, dynamixel2::WIRE, seed, cases, subject, |_, _| ControlFlow::Continue(()))
}

/// The size of a question.
fn size(op: &Question) -> usize {
    serde_json::to_string(op).unwrap().len()
}

#[test]
fn nothing_is_found_in_the_builtin_codec() {
    for wire in Wire::ALL {
        let spec = Spec::embedded().unwrap();
        let mut codec = Builtin::default();
        let fuzzed = fuzz(&spec, wire, 1, 5_000, &mut codec, |_, _| ControlFlow::Continue(()));
        assert!(fuzzed.asked > 4_000, "{}", fuzzed.asked);
        assert_eq!(fuzzed.findings, []);
    }
}

#[test]
fn every_mutant_is_found_and_made_small() {
    for mutant in &MUTANTS {
        let fuzzed = fuzzed(&mut Mutated::new(mutant), 1, 5_000);
        let sizes = fuzzed.findings.iter().map(|finding| size(&finding.check.question));
        // A length of two bytes is 256 bytes, and twice as many digits; the call has them again.
        let smallest = sizes.min().filter(|size| *size < 1_400);
        let found: Vec<_> = fuzzed.findings.iter().map(|finding| &finding.check.question).collect();
        assert!(smallest.is_some(), "{}: {found:?}", mutant.name);
    }
}

#[test]
fn a_seed_finds_the_same_again() {
    let mutant = &MUTANTS[0];
    let first = fuzzed(&mut Mutated::new(mutant), 7, 2_000);
    assert!(!first.findings.is_empty());
    assert_eq!(first, fuzzed(&mut Mutated::new(mutant), 7, 2_000));
    assert_ne!(first, fuzzed(&mut Mutated::new(mutant), 8, 2_000));
}

#[test]
fn what_was_found_is_kept_and_fails_again() {
    let mutant = &MUTANTS[0];
    let findings = fuzzed(&mut Mutated::new(mutant), 1, 2_000).findings;
    let checks: Vec<_> = findings.iter().map(|finding| finding.check.clone()).collect();
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("findings.yaml");
    std::fs::write(&file, saved::write(&checks).unwrap()).unwrap();
    let read = saved::read(&file).unwrap();
    assert_eq!(read, checks);
    let verdicts = |subject: Box<dyn Subject + Send>| -> Vec<_> {
        let outcomes = run::outcomes(&mut [subject], &Plan::of(read.clone()));
        outcomes.into_iter().map(|outcome| outcome.verdict).collect()
    };
    assert!(
        verdicts(Box::new(Mutated::new(mutant))).iter().all(|verdict| *verdict == Verdict::Fail)
    );
    let sound = verdicts(Box::<Builtin>::default());
    assert!(sound.iter().all(|verdict| *verdict == Verdict::Pass));
}

/// Ends at every packet with a certain byte.
struct Ending(Builtin);

impl Subject for Ending {
    fn hello(&self) -> &actucheck::adapter::Hello {
        self.0.hello()
    }

    fn ask(&mut self, op: &Question) -> Answer {
        match op {
            Question::Crc { bytes, .. } if bytes.contains(&0xFD) => Answer::Crashed(String::new()),
            op => self.0.ask(op),
        }
    }
}

#[test]
fn a_crash_is_a_finding_and_small() {
    let findings = fuzzed(&mut Ending(Builtin::default()), 1, 2_000).findings;
    let [finding] = findings.as_slice() else { panic!("{findings:?}") };
    assert_eq!((finding.kind.op, &finding.kind.symptom), ("crc", &Symptom::Crashed));
    assert!(size(&finding.check.question) < 70, "{:?}", finding.check.question);
    assert!(finding.times > 10);
}
