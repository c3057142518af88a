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
use crate::verdict::{Outcome, Verdict};

/// How many batches a worker may be ahead of the slowest one. Their outcomes are held back until
/// then.
const AHEAD: u64 = 64;
/// The longest delay before an interrupt is noticed.
const INTERRUPT: Duration = Duration::from_millis(100);

/// Passes on the outcomes of batches in the order of the batches.
pub(super) struct Merge<'s> {
    state: Mutex<State<'s>>,
    /// Signals that the first unfinished batch has changed.
    moved: Condvar,
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

struct State<'s> {
    sink: &'s mut Sink<'s>,
    /// Asks failures again, if there is a second process.
    again: Option<Again>,
    blame: Blame,
    /// How many outcomes the sink was given.
    count: usize,
    /// The first unfinished batch. Its outcomes go directly to the sink.
    first: u64,
    /// The outcomes of later batches, and whether these are finished.
    held: BTreeMap<u64, (Vec<Judged>, bool)>,
}

impl<'s> Merge<'s> {
    pub(super) fn new(
        sink: &'s mut Sink<'s>,
        again: Option<Again>,
        interrupted: &'s AtomicBool,
    ) -> Self {
        let blame = Blame::default();
        let state = State { sink, again, blame, count: 0, first: 0, held: BTreeMap::new() };
        let (moved, over) = (Condvar::new(), AtomicBool::new(false));
        let (state, ledger) = (Mutex::new(state), Ledger::default());
        Self { state, moved, over, interrupted, ledger }
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
        lock(&self.state).again.is_some()
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
        while number > state.first && !self.is_over() {
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
        let full = |state: &mut State<'_>| number >= state.first + AHEAD && !self.is_over();
        // An interrupt does not wake the thread.
        let waited = self.moved.wait_timeout_while(state, INTERRUPT, full);
        drop(waited.unwrap_or_else(PoisonError::into_inner));
    }

    /// Adds outcomes to a batch, in order; `done` marks the last ones.
    pub(super) fn put(&self, number: u64, outcomes: Vec<Judged>, done: bool) {
        let mut state = lock(&self.state);
        if number != state.first {
            let held = state.held.entry(number).or_default();
            held.0.extend(outcomes);
            held.1 = done;
            return;
        }
        self.hand_on(&mut state, outcomes);
        if done {
            state.end_batch();
            while let Some((outcomes, done)) = state.next_held() {
                self.hand_on(&mut state, outcomes);
                if !done {
                    break;
                }
                state.end_batch();
            }
        }
        drop(state);
        self.moved.notify_all();
    }

    /// Passes on the outcomes that were still held back at an early end. Returns how many outcomes
    /// the sink was given.
    pub(super) fn finish(&self) -> usize {
        let mut state = lock(&self.state);
        let held = std::mem::take(&mut state.held).into_values();
        self.hand_on(&mut state, held.flat_map(|(outcomes, _)| outcomes));
        state.count
    }

    fn hand_on(&self, state: &mut State<'_>, outcomes: impl IntoIterator<Item = Judged>) {
        for Judged { outcome, doubt } in outcomes {
            if is_set(&self.over) {
                return;
            }
            let outcome = match doubt {
                Some(doubt) => self.settle(state, outcome, &doubt),
                None => outcome,
            };
            if state.hand_on(outcome).is_break() {
                self.over.store(true, Ordering::Relaxed);
            }
        }
    }
}

impl Merge<'_> {
    /// The outcome after the question was asked again.
    fn settle(&self, state: &mut State<'_>, outcome: Outcome, doubt: &Doubt) -> Outcome {
        let started = Instant::now();
        let outcome = match &mut state.again {
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

impl State<'_> {
    fn hand_on(&mut self, mut outcome: Outcome) -> ControlFlow<()> {
        self.count += 1;
        self.blame.charge(&mut outcome);
        (self.sink)(outcome)
    }

    fn end_batch(&mut self) {
        self.first += 1;
        self.blame.end_batch();
    }

    fn next_held(&mut self) -> Option<(Vec<Judged>, bool)> {
        self.held.remove(&self.first)
    }
}
