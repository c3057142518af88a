//! Which checks are no longer asked, because such questions cost the adapter too often.
//!
//! Whoever crashes a library loses that check, and each loss costs a start or the wait for an
//! answer. So a run gives up by requirement and op, then by op, then as a whole, and only when much
//! of what was asked last is lost: an adapter that hangs now and then is asked everything.

use std::collections::HashMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use super::{is_set, lock};
use crate::suite::check::Check;

/// After so many confirmed losses, the other checks of a requirement and op are not asked, if they
/// are many of those asked: answers that did not come in time.
const KIND_SILENT: u32 = 5;
/// The same for all losses: a crash takes little time.
const KIND: u32 = 32;
/// The same if they are few of many, but took so long.
const KIND_TIME: Duration = Duration::from_secs(30);
/// After so many losses among its last 64 questions, an op is not asked.
const OP: u32 = 24;
/// After so many losses among the last 64 questions that took so long, nothing is asked.
const RUN: u32 = 16;
const RUN_TIME: Duration = Duration::from_mins(1);

/// The losses of a run.
#[derive(Debug, Default)]
pub(super) struct Ledger {
    /// Whether there was a loss: until then nothing is counted, as nothing costs time.
    any: AtomicBool,
    books: Mutex<Books>,
}

#[derive(Debug, Default)]
struct Books {
    /// By requirement and op.
    kinds: HashMap<(String, &'static str), Tally>,
    ops: HashMap<&'static str, Tally>,
    run: Tally,
    /// Why nothing is asked any more.
    over: Option<String>,
}

#[derive(Debug, Default)]
struct Tally {
    /// The last 64 questions, a bit each, which is set for a loss.
    last: u64,
    /// How many questions those are.
    asked: u32,
    /// How many losses were confirmed.
    confirmed: u32,
    /// How many of these were answers that did not come in time.
    silent: u32,
    /// The time that losses took.
    took: Duration,
    given_up: bool,
}

/// A question that cost the adapter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Loss {
    /// Whether it does so again when it is asked again.
    pub(super) confirmed: bool,
    /// Whether it is an answer that did not come in time.
    pub(super) silent: bool,
    pub(super) took: Duration,
}

impl Tally {
    fn add(&mut self, loss: Option<Loss>) {
        self.last = self.last << 1 | u64::from(loss.is_some());
        self.asked = (self.asked + 1).min(u64::BITS);
        if let Some(loss) = loss {
            self.confirmed += u32::from(loss.confirmed);
            self.silent += u32::from(loss.confirmed && loss.silent);
            self.took += loss.took;
        }
    }

    const fn lost(&self) -> u32 {
        self.last.count_ones()
    }
}

impl Books {
    fn add(&mut self, check: &Check, loss: Option<Loss>) {
        let op = check.question.name();
        let kind = self.kinds.entry((check.requirement.clone(), op)).or_default();
        kind.add(loss);
        let often = kind.lost() * 4 >= kind.asked;
        let many = kind.silent >= KIND_SILENT || kind.confirmed >= KIND;
        kind.given_up |= often && many || kind.took > KIND_TIME && kind.confirmed >= KIND_SILENT;
        let op = self.ops.entry(op).or_default();
        op.add(loss);
        op.given_up |= op.lost() >= OP;
        self.run.add(loss);
        self.run.given_up |= self.run.lost() >= RUN && self.run.took > RUN_TIME;
    }

    fn given_up(&self, check: &Check) -> Option<String> {
        if let Some(reason) = &self.over {
            return Some(reason.clone());
        }
        let op = check.question.name();
        let gone = |tally: &Tally| tally.given_up;
        let losses = "crashes the adapter, or gets no answer,";
        if self.run.given_up {
            return Some(format!("given up: every kind of question {losses} too often"));
        }
        if self.ops.get(op).is_some_and(gone) {
            return Some(format!("given up: {op} {losses} too often"));
        }
        let kind = (check.requirement.clone(), op);
        let given_up = self.kinds.get(&kind).is_some_and(gone);
        given_up.then(|| format!("given up: {op} {losses} too often for this requirement"))
    }
}

impl Ledger {
    /// Notes a question and whether it was a loss.
    pub(super) fn note(&self, check: &Check, loss: Option<Loss>) {
        if loss.is_some() {
            self.any.store(true, Ordering::Relaxed);
        }
        if is_set(&self.any) {
            lock(&self.books).add(check, loss);
        }
    }

    /// Gives everything up.
    pub(super) fn end(&self, reason: &str) {
        self.any.store(true, Ordering::Relaxed);
        lock(&self.books).over.get_or_insert_with(|| reason.to_owned());
    }

    /// Why this check is not asked.
    pub(super) fn given_up(&self, check: &Check) -> Option<String> {
        if is_set(&self.any) { lock(&self.books).given_up(check) } else { None }
    }
}
