use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, mpsc};
use std::thread;
use std::time::Duration;

use actucheck_spec::model::{Citation, HexBytes, Level};

use super::again::{Again, Doubt};
use super::history::History;
use super::ledger::{Ledger, Loss};
use super::lock;
use super::merge::{Judged, Merge};
use crate::adapter::{Hello, Output, Question, Wire};
use crate::subject::{Answer, Builtin, Subject};
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
        drop(merge);
        let earlier = follows.then(|| because("earlier"));
        assert_eq!(causes, [earlier.clone(), earlier]);
    }
}

/// It counts what it is asked, and notes whether it was asked for bytes with stuffing.
struct Stateful {
    hello: Hello,
    count: usize,
    was_stuffed: bool,
    is_wrong: fn(&Self) -> bool,
}

impl Stateful {
    fn again(is_wrong: fn(&Self) -> bool) -> Again {
        let hello = Builtin::default().hello().clone();
        Again::new(Box::new(Self { hello, count: 0, was_stuffed: false, is_wrong }))
    }
}

impl Subject for Stateful {
    fn hello(&self) -> &Hello {
        &self.hello
    }

    fn ask(&mut self, question: &Question) -> Answer {
        self.count += 1;
        let is_wrong = (self.is_wrong)(self);
        self.was_stuffed |= matches!(question, Question::Unstuff { .. });
        Answer::Ok(Output::Bytes(HexBytes(vec![0; usize::from(is_wrong)])))
    }

    fn restart(&mut self) {
        (self.count, self.was_stuffed) = (0, false);
    }
}

/// Settles a failure of the last of so many checks. Every hundredth of them asks for stuffing.
fn settle(again: &mut Again, count: usize) -> Outcome {
    let mut history = History::default();
    let checks = (0..count).map(|at| Arc::new(check(&at.to_string(), "", at % 100 == 50)));
    let checks: Vec<_> = checks.collect();
    checks.iter().enumerate().for_each(|(at, check)| history.add(at, Arc::clone(check)));
    let mark = history.mark(count - 1).unwrap();
    let asked = Some((Arc::new(Mutex::new(history)), mark));
    let check = Arc::clone(checks.last().unwrap());
    let wrong = Answer::Ok(Output::Bytes(HexBytes(vec![0])));
    let outcome = Check::clone(&check).judge(wrong);
    assert_eq!(outcome.verdict, Verdict::Fail);
    again.settle(outcome, &Doubt { check, asked, lost: None }, &|| true)
}

#[test]
fn the_fewest_earlier_requests_are_found() {
    let after = |is_wrong, count| {
        let outcome = settle(&mut Stateful::again(is_wrong), count);
        assert_eq!(outcome.verdict, Verdict::Flaky);
        outcome.after.map(|after| (after.count, after.checks))
    };
    assert_eq!(after(|own| own.was_stuffed, 100), Some((1, vec!["50".to_owned()])));
    // Neither twice as many each time nor all that is remembered are as many as are needed.
    let counted = after(|own| own.count.is_multiple_of(700), 2100).unwrap();
    assert_eq!(counted.0, 699);
    assert_eq!(after(|_| false, 100), None);
}

#[test]
fn a_failure_is_no_fact_until_it_fails_alone() {
    // Wrong from the second request on.
    let mut again = Stateful::again(|own| own.count > 1);
    for _ in 0..9 {
        assert_eq!(settle(&mut again, 1).verdict, Verdict::Flaky);
    }
    let mut always = Stateful::again(|_| true);
    assert!((0..9).all(|_| settle(&mut always, 1).verdict == Verdict::Fail));
}
