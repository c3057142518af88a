//! Asks an implementation every check, and keeps what was found whatever happens.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

use actucheck_spec::model::Level;

use crate::check::Check;
use crate::protocol::{Hello, Op};
use crate::testee::{Answer, Testee};
use crate::verdict::{Outcome, Verdict};

/// Asks all `checks` of some testees that are the same implementation, each of which works through
/// them beside the others. `watch` hears of each outcome as it comes and may end the run; what is
/// outstanding then is still waited for. Outcomes are in the order of the checks, those of checks
/// that were not asked are missing. An adapter that answers an op that does not exist is shown as
/// a fault before all else.
pub fn run(
    testees: &mut [Box<dyn Testee + Send>],
    checks: &[Check],
    watch: impl FnMut(&Outcome) -> ControlFlow<()> + Send,
) -> Vec<Outcome> {
    let fault = testees.first_mut().and_then(|testee| invented_op(testee.as_mut()));
    let (presuming, others): (Vec<_>, Vec<_>) = checks
        .iter()
        .enumerate()
        .map(|(place, _)| place)
        .partition(|place| checks.get(*place).is_some_and(|check| check.presumes.is_some()));
    let ledger = Mutex::new(Ledger {
        outcomes: checks.iter().map(|_| None).collect(),
        skipped: BTreeSet::new(),
        watch,
    });
    let stopped = AtomicBool::new(false);
    // Whether a check makes sense is known only when the one that it presumes is answered.
    for places in [others, presuming] {
        let next = AtomicUsize::new(0);
        let round = Round { checks, places, next, stopped: &stopped, ledger: &ledger };
        thread::scope(|scope| {
            for testee in &mut *testees {
                scope.spawn(|| round.ask(testee.as_mut()));
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
    /// Asks one testee until no check is left.
    fn ask(&self, testee: &mut (dyn Testee + Send)) {
        let hello = testee.hello().clone();
        let mut questions = std::iter::from_fn(|| {
            loop {
                let (place, check) = self.take()?;
                match self.not_asked(&hello, check) {
                    Some(reason) => self.enter(place, Answer::Skipped(reason)),
                    None => return Some((place, &check.op)),
                }
            }
        });
        testee.ask_all(&mut questions, &mut |place, answer| self.enter(place, answer));
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
        let presumed = check.presumes.as_ref();
        if presumed.is_some_and(|id| self.ledger().skipped.contains(id.as_str())) {
            return Some("the check that it presumes is skipped too".to_owned());
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
fn invented_op(testee: &mut dyn Testee) -> Option<Outcome> {
    let (verdict, detail) = match testee.ask(&Op::Invented) {
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
