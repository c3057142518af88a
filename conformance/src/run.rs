//! Asks subjects the checks of a plan, and passes each outcome on at once.

mod again;
mod batch;
mod blame;
mod history;
mod ledger;
mod merge;
mod repeat;
#[cfg(test)]
mod tests;
mod worker;

use std::num::NonZeroU32;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

use actucheck_spec::model::Level;

use self::again::Again;
use self::merge::Merge;
use self::worker::Worker;
pub(crate) use self::worker::not_offered;
use crate::subject::{Answer, Subject};
use crate::suite::plan::{Group, Plan};
use crate::verdict::{Outcome, Verdict};

/// Receives the outcomes of a run, one by one in the order of the plan. If it breaks, the run ends
/// and that outcome was the last.
pub type Sink<'s> = dyn FnMut(Outcome) -> ControlFlow<()> + Send + 's;

/// Asks `subjects`, all of the same implementation, the checks of `plan` in parallel. A subject
/// takes a few groups at a time. A check that requires another check of its group is skipped if the
/// subject skipped that one. A failure that follows from an earlier failure says so. `sink` receives
/// the same outcomes in the same order for any number of subjects. Of a plan's part it receives the
/// part's own outcomes, each with its number, and they are what they are in the whole.
///
/// Each question is asked so many `times` in a row; answers that differ are [`Verdict::Flaky`].
/// What failed is asked again in another process of the subject, and is flaky too if it does not
/// come again. If an adapter answers an op that does not exist, the first outcome reports that
/// fault. When `interrupted` is set, the run ends and passes on what was answered; the subject says
/// how long an outstanding question is awaited. Returns of how many checks the outcome was handed on.
pub fn run<'s>(
    subjects: &mut [Box<dyn Subject + Send>],
    plan: &'s Plan<'_>,
    times: NonZeroU32,
    interrupted: &'s AtomicBool,
    sink: &'s mut Sink<'s>,
) -> usize {
    let asks_invented = plan.part().is_none_or(|part| part.has(UNKNOWN_OP));
    let first = subjects.first_mut().filter(|_| asks_invented);
    let mut fault = first.and_then(|subject| invented_op(subject.as_mut()));
    if let Some(fault) = fault.as_mut().filter(|_| plan.part().is_some()) {
        fault.number = Some(0);
    }
    if fault.is_some_and(|fault| sink(fault).is_break()) {
        return 0;
    }
    let again = subjects.first().and_then(|subject| subject.another()).map(Again::new);
    let merge = Merge::new(sink, again, interrupted);
    let merge = if plan.part().is_some() { merge.of_part(plan.numbered()) } else { merge };
    ask(subjects, plan, times, merge)
}

/// Asks all checks of a short plan once, and keeps every outcome as it is; until it is `interrupted`.
pub fn outcomes(
    subjects: &mut [Box<dyn Subject + Send>],
    plan: &Plan<'_>,
    interrupted: &AtomicBool,
) -> Vec<Outcome> {
    let mut outcomes = Vec::new();
    let mut sink = |outcome| {
        outcomes.push(outcome);
        ControlFlow::Continue(())
    };
    ask(subjects, plan, NonZeroU32::MIN, Merge::new(&mut sink, None, interrupted));
    outcomes
}

/// Asks the checks of a plan. Returns of how many the outcome was handed on.
fn ask<'s>(
    subjects: &mut [Box<dyn Subject + Send>],
    plan: &'s Plan<'_>,
    times: NonZeroU32,
    merge: Merge<'s>,
) -> usize {
    let source = Mutex::new(Source { groups: Box::new(plan.groups()), next: 0 });
    let work = Work { plan, source, merge };
    let is_doubted = work.merge.asks_again();
    thread::scope(|scope| {
        for subject in subjects {
            let worker = Worker::new(&work, subject.hello().clone(), times, is_doubted);
            scope.spawn(|| worker.ask(subject.as_mut()));
        }
    });
    work.merge.finish()
}

/// The state that the workers share.
struct Work<'s, 'a> {
    plan: &'s Plan<'a>,
    source: Mutex<Source<'s, 'a>>,
    merge: Merge<'s>,
}

/// The groups that no worker has taken yet.
struct Source<'p, 'a> {
    groups: Box<dyn Iterator<Item = Group<'a>> + Send + 'p>,
    /// The number of the next batch.
    next: u64,
}

/// The maximum number of checks in a batch; a batch of one group may have more.
const BATCH: usize = 64;

impl<'a> Source<'_, 'a> {
    /// Takes the groups of the next batch; empty if none are left. The first batches are small, so
    /// that a short run has work for every subject.
    fn take(&mut self) -> Vec<Group<'a>> {
        let most = usize::try_from(self.next).unwrap_or(BATCH).saturating_add(2).min(BATCH);
        let (mut groups, mut size) = (Vec::new(), 0);
        while size < most
            && let Some(group) = self.groups.next()
        {
            size += group.size();
            groups.push(group);
        }
        // An empty batch would never be finished, and so hold up those behind it.
        self.next += u64::from(!groups.is_empty());
        groups
    }
}

/// Locks a value that stays valid even if a holder of the lock panics.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Reads a flag that is never reset.
fn is_set(flag: &AtomicBool) -> bool {
    flag.load(Ordering::Relaxed)
}

/// The rule, and the id of the question about it.
pub const UNKNOWN_OP: &str = "adapter.unknown-op";

/// A question that every adapter must skip, as it must skip unknown ops of later versions.
fn invented_op(subject: &mut dyn Subject) -> Option<Outcome> {
    let detail = match subject.ask_invented() {
        Answer::Skipped(_) | Answer::NotAsked(_) => return None,
        Answer::TimedOut(detail) | Answer::Crashed(detail) => detail,
        Answer::Ok(_) | Answer::Rejected(_) | Answer::Faulty(_) => String::new(),
    };
    let rule = "an op that the adapter does not know must be answered with `skip`";
    let detail = if detail.is_empty() { rule.to_owned() } else { format!("{rule}: {detail}") };
    Some(Outcome {
        id: UNKNOWN_OP.to_owned(),
        requirement: UNKNOWN_OP.to_owned(),
        level: Level::Must,
        verdict: Verdict::AdapterFault,
        detail,
        because: None,
        reason: None,
        request: None,
        expected: None,
        actual: None,
        behaviour: None,
        after: None,
        log: None,
        number: None,
    })
}
