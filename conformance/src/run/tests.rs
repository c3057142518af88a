use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, mpsc};
use std::thread;
use std::time::Duration;

use actucheck_spec::model::{Citation, HexBytes, Level};

use super::history::History;
use super::ledger::{Ledger, Loss};
use super::lock;
use super::merge::{Judged, Merge};
use crate::adapter::{Output, Question, Wire};
use crate::subject::Answer;
use crate::suite::check::{Check, Demand};
use crate::verdict::{Because, Outcome, Verdict};

/// A check that asks for bytes with stuffing, or without.
fn check(id: &str, requirement: &str, is_stuffed: bool) -> Check {
    let (wire, bytes) = (*Wire::ALL.first().unwrap(), HexBytes(Vec::new()));
    Check {
        id: id.to_owned(),
        requirement: requirement.to_owned(),
        level: Level::Must,
        source: Citation { document: String::new(), section: String::new() },
        requires: None,
        question: if is_stuffed {
            Question::Unstuff { wire, bytes }
        } else {
            Question::Stuff { wire, bytes }
        },
        demand: Demand::Yield(Output::Bytes(HexBytes(Vec::new()))),
    }
}

/// Notes losses of this kind until the check is given up, most times. Returns how often it was.
fn lose(ledger: &Ledger, check: &Check, loss: Loss, answers: usize, most: usize) -> usize {
    let notes = |_: &usize| {
        ledger.note(check, Some(loss));
        (0..answers).for_each(|_| ledger.note(check, None));
        ledger.given_up(check).is_some()
    };
    (1..=most).find(notes).unwrap_or(usize::MAX)
}

const HANG: Loss = Loss { confirmed: true, silent: true, took: Duration::from_secs(1) };
const CRASH: Loss = Loss { silent: false, took: Duration::from_millis(1), ..HANG };
const NEVER: usize = usize::MAX;

#[test]
fn a_kind_that_hangs_is_given_up_soon_and_one_that_crashes_later() {
    let ledger = Ledger::default();
    let [hangs, crashes, other] = ["hangs", "crashes", "other"].map(|name| check("", name, false));
    // Before the first loss nothing is counted.
    (0..99).for_each(|_| ledger.note(&hangs, None));
    assert_eq!(lose(&ledger, &hangs, HANG, 0, 99), 5);
    assert_eq!(lose(&ledger, &crashes, CRASH, 3, 99), 32);
    assert_eq!(ledger.given_up(&other), None);
    assert_eq!(ledger.given_up(&check("", "hangs", true)), None);
}

#[test]
fn what_is_lost_now_and_then_is_asked_unless_it_takes_long() {
    let rare = check("", "rare", false);
    assert_eq!(lose(&Ledger::default(), &rare, CRASH, 4, 999), NEVER);
    let once = Loss { confirmed: false, ..CRASH };
    assert_eq!(lose(&Ledger::default(), &rare, once, 2, 999), NEVER);
    let slow = Loss { took: Duration::from_secs(7), ..HANG };
    assert_eq!(lose(&Ledger::default(), &rare, slow, 9, 99), 5);
}

#[test]
fn an_op_is_given_up_and_then_the_run() {
    let checks = |name, is_stuffed| {
        let names = (0..64).map(move |number| format!("{name}-{number}"));
        names.map(move |name| check("", &name, is_stuffed))
    };
    let ledger = Ledger::default();
    let mut asked = 0;
    for check in checks("quick", true).take_while(|check| ledger.given_up(check).is_none()) {
        ledger.note(&check, Some(CRASH));
        asked += 1;
    }
    assert_eq!((asked, ledger.given_up(&check("", "one", false))), (24, None));
    let slow = Loss { took: Duration::from_secs(5), ..HANG };
    let ledger = Ledger::default();
    for (number, check) in checks("slow", true).enumerate().take(16) {
        assert_eq!(ledger.given_up(&check), None, "{number}");
        ledger.note(&check, Some(slow));
    }
    let reason = ledger.given_up(&check("", "one", false)).unwrap();
    assert!(reason.starts_with("given up: every kind of question"), "{reason}");
}

#[test]
fn a_history_has_what_one_process_was_asked_before() {
    const NONE: [usize; 0] = [];
    let mut history = History::default();
    let ask = |history: &mut History, number: usize| {
        history.add(number, Arc::new(check(&number.to_string(), "", false)));
    };
    let before = |history: &History, number| {
        let checks = history.before(history.mark(number).unwrap());
        checks.iter().map(|check| check.id.parse().unwrap()).collect::<Vec<usize>>()
    };
    (0..3).for_each(|number| ask(&mut history, number));
    history.begin_anew();
    (3..6).for_each(|number| ask(&mut history, number));
    assert_eq!(before(&history, 0), NONE);
    assert_eq!(before(&history, 2), [0, 1]);
    assert_eq!(before(&history, 3), NONE);
    assert_eq!(before(&history, 5), [3, 4]);
    assert_eq!(history.mark(6).map(|_| ()), None);
    let marked = history.mark(5).unwrap();
    (6..20_000).for_each(|number| ask(&mut history, number));
    let last = before(&history, 19_999);
    assert_eq!((last.len(), last.first(), last.last()), (1024, Some(&18_975), Some(&19_998)));
    assert!(history.before(marked).is_empty() && history.mark(5).is_none());
}

/// The sink waits for another worker, as it would for a second process.
#[test]
fn a_worker_does_not_wait_until_another_ones_outcomes_are_handed_on() {
    let judged = |id: &str| {
        let outcome = check(id, "", false).judge(Answer::Skipped(String::new()));
        vec![Judged { outcome, doubt: None }]
    };
    let (put, is_put) = mpsc::channel();
    let (handing, is_handing) = mpsc::channel();
    let handed_on = Mutex::new(Vec::new());
    let ids = &handed_on;
    let mut sink = move |outcome: Outcome| {
        if lock(ids).is_empty() {
            handing.send(()).unwrap();
            is_put.recv_timeout(Duration::from_secs(3)).unwrap();
        }
        lock(ids).push(outcome.id);
        ControlFlow::Continue(())
    };
    let interrupted = AtomicBool::new(false);
    let merge = Merge::new(&mut sink, None, &interrupted);
    thread::scope(|scope| {
        let first = scope.spawn(|| merge.put(0, judged("first"), true));
        is_handing.recv().unwrap();
        merge.put(1, judged("second"), false);
        merge.put(1, judged("third"), false);
        put.send(()).unwrap();
        first.join().unwrap();
        merge.wait_for_turn(1);
        assert_eq!(*lock(ids), ["first", "second", "third"]);
        merge.put(1, judged("fourth"), true);
    });
    assert_eq!(merge.finish(), 4);
}

#[test]
fn a_failure_follows_from_a_fact_only() {
    for (verdict, follows) in [(Verdict::Fail, true), (Verdict::Flaky, false)] {
        let judged = |id: &str, verdict, because| {
            let outcome = check(id, "", false).judge(Answer::Skipped(String::new()));
            vec![Judged { outcome: Outcome { verdict, because, ..outcome }, doubt: None }]
        };
        let because = |id: &str| Because { check: id.to_owned(), requirement: String::new() };
        let mut causes = Vec::new();
        let mut sink = |outcome: Outcome| {
            causes.push(outcome.because);
            ControlFlow::Continue(())
        };
        let interrupted = AtomicBool::new(false);
        let merge = Merge::new(&mut sink, None, &interrupted);
        merge.put(0, judged("first", verdict, Some(because("earlier"))), false);
        merge.put(0, judged("second", Verdict::Fail, Some(because("first"))), true);
        assert_eq!(merge.finish(), 2);
        let earlier = follows.then(|| because("earlier"));
        assert_eq!(causes, [earlier.clone(), earlier]);
    }
}
