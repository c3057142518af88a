//! Asks an implementation every check, and keeps what was found whatever happens.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

use actucheck_spec::model::Level;

use crate::adapter::{Hello, Op};
use crate::subject::{Answer, Subject};
use crate::suite::check::Check;
use crate::verdict::{Outcome, Verdict};

/// Asks all `checks` of some subjects that are the same implementation, each of which works through
/// them beside the others. `watch` hears of each outcome as it comes and may end the run; what is
/// outstanding then is still waited for. Outcomes are in the order of the checks, those of checks
/// that were not asked are missing. An adapter that answers an op that does not exist is shown as
/// a fault before all else.
pub fn run(
    subjects: &mut [Box<dyn Subject + Send>],
    checks: &[Check],
    watch: impl FnMut(&Outcome) -> ControlFlow<()> + Send,
) -> Vec<Outcome> {
    let fault = subjects.first_mut().and_then(|subject| invented_op(subject.as_mut()));
    let (requiring, others): (Vec<_>, Vec<_>) = checks
        .iter()
        .enumerate()
        .map(|(place, _)| place)
        .partition(|place| checks.get(*place).is_some_and(|check| check.requires.is_some()));
    let ledger = Mutex::new(Ledger {
        outcomes: checks.iter().map(|_| None).collect(),
        skipped: BTreeSet::new(),
        watch,
    });
    let stopped = AtomicBool::new(false);
    // Whether a check makes sense is known only when the one that it requires is answered.
    for places in [others, requiring] {
        let next = AtomicUsize::new(0);
        let round = Round { checks, places, next, stopped: &stopped, ledger: &ledger };
        thread::scope(|scope| {
            for subject in &mut *subjects {
                scope.spawn(|| round.ask(subject.as_mut()));
            }
        });
    }
    let ledger = ledger.into_inner().unwrap_or_else(PoisonError::into_inner);
    fault.into_iter().chain(ledger.outcomes.into_iter().flatten()).collect()
}

/// What has come out so far.
struct Ledger<W> {
    outcomes: Vec<Option<Outcome>>,
    /// Ids of checks that were skipped.
    skipped: BTreeSet<String>,
    watch: W,
}

/// Checks that may be asked in any order, side by side.
struct Round<'a, W> {
    /// All checks.
    checks: &'a [Check],
    /// Those of this round, by their place among all.
    places: Vec<usize>,
    /// The first of them that was not yet taken.
    next: AtomicUsize,
    stopped: &'a AtomicBool,
    ledger: &'a Mutex<Ledger<W>>,
}

impl<W: FnMut(&Outcome) -> ControlFlow<()>> Round<'_, W> {
    /// Asks one subject until no check is left.
    fn ask(&self, subject: &mut (dyn Subject + Send)) {
        let hello = subject.hello().clone();
        let mut questions = std::iter::from_fn(|| {
            loop {
                let (place, check) = self.take()?;
                match self.not_asked(&hello, check) {
                    Some(reason) => self.enter(place, Answer::Skipped(reason)),
                    None => return Some((place, &check.op)),
                }
            }
        });
        subject.ask_all(&mut questions, &mut |place, answer| self.enter(place, answer));
    }

    fn take(&self) -> Option<(usize, &Check)> {
        if self.stopped.load(Ordering::Relaxed) {
            return None;
        }
        let place = *self.places.get(self.next.fetch_add(1, Ordering::Relaxed))?;
        Some((place, self.checks.get(place)?))
    }

    /// Why a check is not even asked.
    fn not_asked(&self, hello: &Hello, check: &Check) -> Option<String> {
        let required = check.requires.as_ref();
        if required.is_some_and(|id| self.ledger().skipped.contains(id.as_str())) {
            return Some("the check that it requires is skipped too".to_owned());
        }
        not_offered(hello, check)
    }

    fn enter(&self, place: usize, answer: Answer) {
        let Some(check) = self.checks.get(place) else { return };
        let outcome = check.judge(answer);
        let mut ledger = self.ledger();
        if outcome.verdict == Verdict::Skip {
            ledger.skipped.insert(outcome.id.clone());
        }
        if (ledger.watch)(&outcome).is_break() {
            self.stopped.store(true, Ordering::Relaxed);
        }
        if let Some(slot) = ledger.outcomes.get_mut(place) {
            *slot = Some(outcome);
        }
    }

    fn ledger(&self) -> MutexGuard<'_, Ledger<W>> {
        self.ledger.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What a good adapter skips, so that it can skip what a later suite asks.
fn invented_op(subject: &mut dyn Subject) -> Option<Outcome> {
    let (verdict, detail) = match subject.ask(&Op::Invented) {
        Answer::Skipped(_) => return None,
        Answer::TimedOut(detail) => (Verdict::Timeout, detail),
        Answer::Crashed(detail) => (Verdict::Crash, detail),
        Answer::Ok(_) | Answer::Rejected(_) | Answer::Faulty(_) | Answer::NotAsked(_) => {
            (Verdict::AdapterFault, String::new())
        }
    };
    let rule = "an op that the adapter does not know must be answered with `skip`";
    let detail = if detail.is_empty() { rule.to_owned() } else { format!("{rule}: {detail}") };
    Some(Outcome {
        id: "adapter.unknown-op".to_owned(),
        requirement: "adapter.unknown-op".to_owned(),
        level: Level::Must,
        verdict,
        detail,
        request: Some(Op::Invented),
        expected: None,
        actual: None,
        behaviour: None,
    })
}

/// Why a check is not asked, by the adapter's own word.
fn not_offered(hello: &Hello, check: &Check) -> Option<String> {
    let name = check.op.name();
    if !hello.ops.iter().any(|op| op == name) {
        return Some(format!("the adapter offers no {name}"));
    }
    if let Some(wire) = check.op.wire()
        && !hello.wires.iter().any(|offered| offered == wire.id())
    {
        return Some(format!("the adapter offers no {}", wire.id()));
    }
    let (limit, size) = (hello.limits.max_packet?, check.packet_size()?);
    (size > limit).then(|| format!("{size} bytes, the adapter's limit is {limit}"))
}
