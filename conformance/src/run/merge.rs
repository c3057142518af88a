//! Puts the outcomes of several workers into the order of the plan, in which causes come before
//! what follows from them.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::again::{Again, Doubt};
use super::blame::Blame;
use super::ledger::{Ledger, Loss};
use super::{Sink, is_set, lock};
use crate::suite::check::Check;
use crate::suite::plan::Numbered;
use crate::verdict::{Outcome, Verdict};

/// How many batches a worker may be ahead of the slowest one. Their outcomes are held back until
/// then.
const AHEAD: u64 = 64;
/// The longest delay before an interrupt is noticed.
const INTERRUPT: Duration = Duration::from_millis(100);

/// Passes on the outcomes of batches in the order of the batches. One worker at a time does so, also
/// with the outcomes of others: these ask on meanwhile.
pub(super) struct Merge<'s> {
    state: Mutex<State>,
    /// Signals that the first unfinished batch has changed, or that nothing is passed on now.
    moved: Condvar,
    /// Where outcomes go; locked by the worker that passes them on.
    exit: Mutex<Exit<'s>>,
    /// The sink has ended the run.
    over: AtomicBool,
    interrupted: &'s AtomicBool,
    ledger: Ledger,
}

/// An outcome, and what is needed to ask it again.
pub(super) struct Judged {
    pub(super) outcome: Outcome,
    pub(super) doubt: Option<Box<Doubt>>,
}

#[derive(Default)]
struct State {
    /// The first unfinished batch.
    first: u64,
    /// The outcomes that were not passed on yet, and whether they are the last of their batch.
    held: BTreeMap<u64, (Vec<Judged>, bool)>,
    /// Whether a worker passes on outcomes.
    is_busy: bool,
}

struct Exit<'s> {
    sink: &'s mut Sink<'s>,
    /// Asks failures again, if there is a second process.
    again: Option<Again>,
    blame: Blame,
    /// The checks that are asked, if they are those of a part.
    part: Option<Box<dyn Iterator<Item = Numbered> + Send + 's>>,
    /// How many outcomes the sink was given.
    count: usize,
}

impl<'s> Merge<'s> {
    pub(super) fn new(
        sink: &'s mut Sink<'s>,
        again: Option<Again>,
        interrupted: &'s AtomicBool,
    ) -> Self {
        let exit = Exit { sink, again, blame: Blame::default(), part: None, count: 0 };
        Self {
            state: Mutex::default(),
            moved: Condvar::new(),
            exit: Mutex::new(exit),
            over: AtomicBool::new(false),
            interrupted,
            ledger: Ledger::default(),
        }
    }

    /// The same for a part of a plan: outcomes get their numbers, and those of other parts are not passed
    /// on.
    pub(super) fn of_part(mut self, checks: impl Iterator<Item = Numbered> + Send + 's) -> Self {
        let exit = self.exit.get_mut().unwrap_or_else(PoisonError::into_inner);
        exit.part = Some(Box::new(checks));
        self
    }

    /// Whether to stop asking.
    pub(super) fn is_over(&self) -> bool {
        is_set(&self.over) || is_set(self.interrupted)
    }

    /// Stops the asking.
    pub(super) fn end(&self) {
        self.over.store(true, Ordering::Relaxed);
    }

    /// Whether what failed is asked again.
    pub(super) fn asks_again(&self) -> bool {
        lock(&self.exit).again.is_some()
    }

    /// Gives all checks up that are left.
    pub(super) fn give_up(&self, reason: &str) {
        self.ledger.end(reason);
    }

    /// Why this check is not asked.
    pub(super) fn given_up(&self, check: &Check) -> Option<String> {
        self.ledger.given_up(check)
    }

    /// Notes a question that did not cost the process.
    pub(super) fn note_answer(&self, check: &Check) {
        self.ledger.note(check, None);
    }

    /// Waits until the outcomes before this batch were passed on, and those of the batch that were
    /// put so far.
    pub(super) fn wait_for_turn(&self, number: u64) {
        let mut state = lock(&self.state);
        let awaits = |state: &State| number > state.first || number == state.first && state.is_busy;
        while awaits(&state) && !self.is_over() {
            let waited = self.moved.wait_timeout(state, INTERRUPT);
            (state, _) = waited.unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Whether the batch with this number may start.
    pub(super) fn has_room(&self, number: u64) -> bool {
        number < lock(&self.state).first + AHEAD
    }

    /// Waits a moment, or until the batch with this number may start.
    pub(super) fn wait_for_room(&self, number: u64) {
        let state = lock(&self.state);
        let full = |state: &mut State| number >= state.first + AHEAD && !self.is_over();
        // An interrupt does not wake the thread.
        let waited = self.moved.wait_timeout_while(state, INTERRUPT, full);
        drop(waited.unwrap_or_else(PoisonError::into_inner));
    }

    /// Adds outcomes to a batch, in order; `done` marks the last ones. They are passed on when those
    /// before them were; by another worker, if it is passing on.
    pub(super) fn put(&self, number: u64, outcomes: Vec<Judged>, done: bool) {
        let mut state = lock(&self.state);
        let held = state.held.entry(number).or_default();
        held.0.extend(outcomes);
        held.1 = done;
        if std::mem::replace(&mut state.is_busy, true) {
            return;
        }
        while let Some((outcomes, done)) = state.next_held() {
            drop(state);
            self.hand_on(outcomes, done);
            state = lock(&self.state);
            if done {
                state.first += 1;
                self.moved.notify_all();
            }
        }
        state.is_busy = false;
        drop(state);
        self.moved.notify_all();
    }

    /// Passes on the outcomes that were still held back at an early end. Returns how many outcomes
    /// the sink was given.
    pub(super) fn finish(&self) -> usize {
        let held = std::mem::take(&mut lock(&self.state).held);
        for (outcomes, done) in held.into_values() {
            self.hand_on(outcomes, done);
        }
        lock(&self.exit).count
    }

    /// Passes on outcomes of a batch; `done` marks the last ones.
    fn hand_on(&self, outcomes: Vec<Judged>, done: bool) {
        let mut exit = lock(&self.exit);
        for Judged { outcome, doubt } in outcomes {
            if is_set(&self.over) {
                return;
            }
            let outcome = match doubt {
                Some(doubt) => self.settle(&mut exit, outcome, &doubt),
                None => outcome,
            };
            if exit.hand_on(outcome).is_break() {
                self.end();
            }
        }
        if done {
            exit.blame.end_batch();
        }
    }

    /// The outcome after the question was asked again.
    fn settle(&self, exit: &mut Exit<'_>, outcome: Outcome, doubt: &Doubt) -> Outcome {
        let started = Instant::now();
        let outcome = match &mut exit.again {
            Some(again) if !self.is_over() => again.settle(outcome, doubt, &|| !self.is_over()),
            _ => outcome,
        };
        if let Some(lost) = &doubt.lost {
            let confirmed = outcome.verdict != Verdict::Flaky;
            let took = lost.took + started.elapsed();
            let silent = outcome.verdict == Verdict::Timeout;
            self.ledger.note(&doubt.check, Some(Loss { confirmed, silent, took }));
        }
        outcome
    }
}

impl State {
    fn next_held(&mut self) -> Option<(Vec<Judged>, bool)> {
        self.held.remove(&self.first)
    }
}

impl Exit<'_> {
    fn hand_on(&mut self, mut outcome: Outcome) -> ControlFlow<()> {
        self.blame.charge(&mut outcome);
        if let Some(checks) = &mut self.part {
            // Those in between were not asked, as the run has ended early.
            let mut asked = checks.filter(|check| check.id == outcome.id);
            let Some(own) = asked.next().filter(|check| check.is_own) else {
                return ControlFlow::Continue(());
            };
            outcome.number = Some(own.number);
        }
        self.count += 1;
        (self.sink)(outcome)
    }
}
