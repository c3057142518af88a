//! Puts the outcomes of several workers into the order of the plan, in which causes come before
//! what follows from them.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Condvar, Mutex, PoisonError};
use std::time::Duration;

use super::blame::Blame;
use super::{Sink, is_set, lock};
use crate::verdict::Outcome;

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
}

struct State<'s> {
    sink: &'s mut Sink<'s>,
    blame: Blame,
    /// How many outcomes the sink was given.
    count: usize,
    /// The first unfinished batch. Its outcomes go directly to the sink.
    first: u64,
    /// The outcomes of later batches, and whether these are finished.
    held: BTreeMap<u64, (Vec<Outcome>, bool)>,
}

impl<'s> Merge<'s> {
    pub(super) fn new(sink: &'s mut Sink<'s>, interrupted: &'s AtomicBool) -> Self {
        let blame = Blame::default();
        let state = State { sink, blame, count: 0, first: 0, held: BTreeMap::new() };
        let (moved, over) = (Condvar::new(), AtomicBool::new(false));
        Self { state: Mutex::new(state), moved, over, interrupted }
    }

    /// Whether to stop asking.
    pub(super) fn is_over(&self) -> bool {
        is_set(&self.over) || is_set(self.interrupted)
    }

    /// Stops the asking.
    pub(super) fn end(&self) {
        self.over.store(true, Ordering::Relaxed);
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
    pub(super) fn put(&self, number: u64, outcomes: Vec<Outcome>, done: bool) {
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
    pub(super) fn finish(self) -> usize {
        let mut state = self.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        let held = std::mem::take(&mut state.held).into_values();
        for outcome in held.flat_map(|(outcomes, _)| outcomes) {
            if is_set(&self.over) || state.hand_on(outcome).is_break() {
                break;
            }
        }
        state.count
    }

    fn hand_on(&self, state: &mut State<'_>, outcomes: Vec<Outcome>) {
        for outcome in outcomes {
            if is_set(&self.over) {
                return;
            }
            if state.hand_on(outcome).is_break() {
                self.over.store(true, Ordering::Relaxed);
            }
        }
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

    fn next_held(&mut self) -> Option<(Vec<Outcome>, bool)> {
        self.held.remove(&self.first)
    }
}
