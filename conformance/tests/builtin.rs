//! The checks of test vectors pass on the built-in codec, and each kind of check fails on a subject that is
//! wrong in exactly that.

#![allow(clippy::unwrap_used)] // in what the tests share

use std::collections::BTreeSet;
use std::sync::atomic::AtomicBool;

use actucheck::adapter::{Hello, Output, Question, Request, Wire};
use actucheck::run;
use actucheck::subject::{Answer, Builtin, Subject};
use actucheck::suite;
use actucheck::suite::check::{Check, Demand};
use actucheck::suite::plan::Plan;
use actucheck::verdict::{Outcome, Totals, Verdict};
use actucheck_spec::Spec;
use actucheck_spec::coverage::{self, CheckName, Cover};
use actucheck_spec::model::{CheckedBy, Fault, Role};
use actucheck_spec::wire::Packet;
use actucheck_spec::wire::dynamixel2;
use actucheck_spec::wire::dynamixel2::Packet::Status;

fn checks() -> Vec<Check> {
    let options = suite::Options { cases: 100, ..suite::Options::new() };
    suite::plan(&Spec::embedded().unwrap(), &[dynamixel2::WIRE], &options).checks().collect()
}

/// The built-in codec with wrong answers to one op.
struct Bent<F> {
    codec: Builtin,
    bend: F,
}

impl<F: Fn(&Question, Answer) -> Answer + Send> Subject for Bent<F> {
    fn hello(&self) -> &Hello {
        self.codec.hello()
    }

    fn ask(&mut self, op: &Question) -> Answer {
        let answer = self.codec.ask(op);
        (self.bend)(op, answer)
    }
}

fn outcomes(bend: impl Fn(&Question, Answer) -> Answer + Send + 'static) -> Vec<Outcome> {
    let subject = Bent { codec: Builtin::default(), bend };
    run::outcomes(&mut [Box::new(subject)], &Plan::of(checks()), &AtomicBool::new(false))
}

/// The ops whose checks failed.
fn failed_ops(outcomes: &[Outcome]) -> BTreeSet<&'static str> {
    let failed = outcomes.iter().filter(|outcome| outcome.verdict == Verdict::Fail);
    failed.filter_map(|outcome| outcome.request.as_ref()).map(Question::name).collect()
}

#[test]
fn the_builtin_codec_passes_every_test_vector() {
    let outcomes = outcomes(|_, answer| answer);
    let bad: Vec<_> = outcomes
        .iter()
        .filter(|outcome| {
            !matches!(outcome.verdict, Verdict::Pass | Verdict::Recorded | Verdict::Skip)
        })
        .collect();
    assert_eq!(bad, Vec::<&Outcome>::new());
    assert_eq!(Totals::of(&outcomes).exit_status(), 0);
}

#[test]
fn ids_are_unique_and_requirements_exist() {
    let spec = Spec::embedded().unwrap();
    let mut ids = BTreeSet::new();
    for check in checks() {
        assert!(spec.requirement(&check.requirement).is_some(), "{}", check.requirement);
        assert!(ids.insert(check.id.clone()), "{} is there twice", check.id);
    }
}

#[test]
fn a_wrong_crc_fails_the_crc_checks() {
    let outcomes = outcomes(|_, answer| match answer {
        Answer::Ok(Output::Crc(crc)) => Answer::Ok(Output::Crc(crc ^ 1)),
        answer => answer,
    });
    assert_eq!(failed_ops(&outcomes), ["crc"].into());
}

#[test]
fn bytes_without_stuffing_fail_encode_and_stuff() {
    let outcomes = outcomes(|op, answer| match (op, answer) {
        (Question::Stuff { bytes, .. }, _) => Answer::Ok(Output::Bytes(bytes.clone())),
        (Question::Encode { .. }, Answer::Ok(Output::Bytes(mut bytes))) => {
            bytes.0.pop();
            Answer::Ok(Output::Bytes(bytes))
        }
        (_, answer) => answer,
    });
    assert_eq!(failed_ops(&outcomes), ["encode", "stuff"].into());
}

#[test]
fn stuffing_that_is_left_in_fails_unstuff() {
    let outcomes = outcomes(|op, answer| match op {
        Question::Unstuff { bytes, .. } => Answer::Ok(Output::Bytes(bytes.clone())),
        _ => answer,
    });
    assert_eq!(failed_ops(&outcomes), ["unstuff"].into());
}

#[test]
fn a_wrong_field_fails_decode() {
    let outcomes = outcomes(|_, answer| match answer {
        Answer::Ok(Output::Packet(Packet::Dynamixel2(Status { id, error, params }))) => {
            Answer::Ok(Output::Packet(Status { id, error: error ^ 0x80, params }.into()))
        }
        answer => answer,
    });
    assert_eq!(failed_ops(&outcomes), ["decode"].into());
}

#[test]
fn accepting_damaged_packets_fails_each_negative_check() {
    let accepted = Packet::from(Status { id: 1, error: 0, params: vec![].into() });
    let outcomes = outcomes(move |_, answer| match answer {
        Answer::Rejected(_) => Answer::Ok(Output::Packet(accepted.clone())),
        answer => answer,
    });
    let failed: Vec<_> =
        outcomes.iter().filter(|outcome| outcome.verdict == Verdict::Fail).collect();
    let negative = checks().into_iter().filter(|check| matches!(check.demand, Demand::Reject(_)));
    assert_eq!(failed.len(), negative.count());
}

#[test]
fn another_class_is_a_warning_and_a_breakdown_a_failure() {
    let with_class = |class| {
        outcomes(move |_, answer| match answer {
            Answer::Rejected(mut rejection) => {
                rejection.class = class;
                Answer::Rejected(rejection)
            }
            answer => answer,
        })
    };
    let other = Totals::of(&with_class(Fault::Parameter));
    assert_eq!((other.count(Verdict::Fail), other.exit_status()), (0, 0));
    assert!(other.count(Verdict::Warn) > 0);
    let rejected = with_class(Fault::Crc).into_iter().filter_map(|outcome| outcome.behaviour);
    let recorded = rejected.filter(|behaviour| behaviour.answer == "rejects it (crc)").count();
    let broken = Totals::of(&with_class(Fault::Internal));
    assert_eq!(broken.count(Verdict::Fail), other.count(Verdict::Warn) + recorded);
    let wordless = Totals::of(&with_class(Fault::Unspecified));
    assert_eq!((wordless.count(Verdict::Fail), wordless.count(Verdict::Warn)), (0, 0));
}

#[test]
fn every_packet_to_encode_has_its_call() {
    let spec = Spec::embedded().unwrap();
    let mut general = 0;
    for check in suite::plan(&spec, &Wire::ALL, &suite::Options::new()).checks() {
        let Question::Encode { packet, .. } = &check.question else { continue };
        let call = packet.call.as_ref().unwrap_or_else(|| panic!("{}", check.id));
        general += usize::from(call.is_general);
        let old = Request::Ask(&check.question).in_version(1);
        assert_eq!(old.contains("\"call\""), !call.is_general, "{}", check.id);
    }
    assert!(general > 0);
}

#[test]
fn rejecting_everything_fails_all_that_is_valid_but_not_what_is_unspecified() {
    let outcomes = outcomes(|op, answer| match answer {
        Answer::Ok(_) if matches!(op, Question::Decode { .. }) => {
            let detail = String::new();
            Answer::Rejected(actucheck::adapter::Rejection { class: Fault::Crc, detail })
        }
        answer => answer,
    });
    let of = |id: &str| outcomes.iter().find(|outcome| outcome.id == id).unwrap();
    let unspecified = of("ja40.clear.instruction.with-parameters/decode");
    assert_eq!(unspecified.verdict, Verdict::Recorded);
    assert_eq!(unspecified.behaviour.as_ref().unwrap().answer, "rejects it (crc)");
    assert_eq!(of("ja40.clear.status/decode").verdict, Verdict::Fail);
}

#[test]
fn requirements_say_whether_the_suite_checks_them() {
    let spec = Spec::embedded().unwrap();
    let mut named = BTreeSet::new();
    for wire in Wire::ALL {
        let plan = suite::plan(&spec, &[wire], &suite::Options::new());
        named.extend(plan.checks().map(|check| check.requirement));
    }
    for row in spec.requirements.iter().flat_map(|file| &file.content.requirements) {
        let said = match row.checked_by {
            Some(CheckedBy::Suite) => true,
            Some(CheckedBy::Nothing) => false,
            None => continue,
        };
        assert_eq!(named.contains(&row.id), said, "{}", row.id);
    }
}

#[test]
fn no_requirement_on_a_codec_is_left_uncovered() {
    let spec = Spec::embedded().unwrap();
    let plan = suite::plan(&spec, &Wire::ALL, &suite::Options::new());
    let all: Vec<_> = plan.checks().collect();
    let names = all.iter().map(|check| CheckName {
        id: &check.id,
        requirement: &check.requirement,
        role: Role::Codec,
        only_records: check.only_records(),
    });
    let uncovered: Vec<_> = coverage::matrix(&spec, names)
        .into_iter()
        .filter(|row| row.requirement.binds.contains(&Role::Codec))
        .filter(|row| row.cover(Role::Codec) == Cover::Nothing)
        .map(|row| &row.requirement.id)
        .collect();
    assert_eq!(uncovered, Vec::<&String>::new());
}
