//! Asks subjects the checks of a plan, and hands on what comes out as it comes.

mod merge;
mod worker;

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

use actucheck_spec::model::Level;

use self::merge::Merge;
use self::worker::Worker;
use crate::subject::{Answer, Subject};
use crate::suite::plan::{Group, Plan};
use crate::verdict::{Outcome, Verdict};

/// Takes what comes out of a run, an outcome after the other in the order of the plan. With a break
/// the run ends, and that outcome was the last.
pub type Sink<'s> = dyn FnMut(Outcome) -> ControlFlow<()> + Send + 's;

/// Asks all checks of `plan` of some subjects that are the same implementation, each of which works
/// through them beside the others. A subject takes some groups at a time; a check that requires
/// another of its group is skipped where that one was. `sink` is given the same in the same order
/// however many subjects there are. When `interrupted` is set, what is outstanding is waited for, and
/// what was answered is handed on. An adapter that answers an op that does not exist is shown as a
/// fault before all else. Returns of how many checks the outcome was handed on.
pub fn run<'s>(
    subjects: &mut [Box<dyn Subject + Send>],
    plan: &'s Plan<'_>,
    interrupted: &'s AtomicBool,
    sink: &'s mut Sink<'s>,
) -> usize {
    let fault = subjects.first_mut().and_then(|subject| invented_op(subject.as_mut()));
    if fault.is_some_and(|fault| sink(fault).is_break()) {
        return 0;
    }
    let source = Mutex::new(Source { groups: Box::new(plan.groups()), next: 0 });
    let work = Work { plan, source, merge: Merge::new(sink, interrupted) };
    thread::scope(|scope| {
        for subject in subjects {
            let worker = Worker::new(&work, subject.hello().clone());
            scope.spawn(|| worker.ask(subject.as_mut()));
        }
    });
    work.merge.finish()
}

/// Asks all checks of a plan that is known to be short, and keeps every outcome.
pub fn outcomes(subjects: &mut [Box<dyn Subject + Send>], plan: &Plan<'_>) -> Vec<Outcome> {
    let mut outcomes = Vec::new();
    run(subjects, plan, &AtomicBool::new(false), &mut |outcome| {
        outcomes.push(outcome);
        ControlFlow::Continue(())
    });
    outcomes
}

/// What the workers share.
struct Work<'s, 'a> {
    plan: &'s Plan<'a>,
    source: Mutex<Source<'s, 'a>>,
    merge: Merge<'s>,
}

/// The groups that nobody has taken yet.
struct Source<'p, 'a> {
    groups: Box<dyn Iterator<Item = Group<'a>> + Send + 'p>,
    /// The number of the next batch.
    next: u64,
}

/// The most checks of a batch, but for a group that has more.
const BATCH: usize = 64;

impl<'a> Source<'_, 'a> {
    /// The groups of the next batch; none if all were taken. The first batches are small, so that
    /// there is some for every subject of a short run.
    fn take(&mut self) -> Vec<Group<'a>> {
        let most = usize::try_from(self.next).unwrap_or(BATCH).saturating_add(2).min(BATCH);
        let (mut groups, mut size) = (Vec::new(), 0);
        while size < most
            && let Some(group) = self.groups.next()
        {
            size += group.size();
            groups.push(group);
        }
        self.next += 1;
        groups
    }
}

/// Locks what no panic can leave half done.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Whether a flag is set that only ever goes one way.
fn is_set(flag: &AtomicBool) -> bool {
    flag.load(Ordering::Relaxed)
}

/// What a good adapter skips, so that it can skip what a later suite asks.
fn invented_op(subject: &mut dyn Subject) -> Option<Outcome> {
    let (verdict, detail) = match subject.ask_invented() {
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
        request: None,
        expected: None,
        actual: None,
        behaviour: None,
    })
}
