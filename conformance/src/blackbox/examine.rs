//! Examines failures on fresh processes: whether a failure depends on what was asked before, and
//! what is the least that shows it.

use std::time::{Duration, Instant};

use super::Scope;
use super::finding::{Failure, Finding, Kind, size};
use super::probe::Probe;
use super::source::Drawn;
use crate::shrink::{fewest, shrink};
use crate::subject::Subject;
use crate::suite::check::Check;

/// The maximum number of questions to shrink a failure.
const STEPS: usize = 500;
/// The same if each question needs a fresh process.
const FRESH_STEPS: usize = 60;
/// The same for conversations, in which a host waits.
const CONVERSATIONS: usize = 200;
/// The same for an adapter that hangs or ends, as each question takes long.
const SLOW_STEPS: usize = 40;
/// How long one failure is examined at most.
const TIME: Duration = Duration::from_secs(10);
/// The same for one of a conversation.
const TIME_OF_CONVERSATIONS: Duration = Duration::from_secs(30);

/// Examines failures on one subject.
pub(super) struct Examiner<'a> {
    pub(super) scope: &'a Scope<'a>,
    pub(super) subject: &'a mut dyn Subject,
    /// Whether there is time.
    pub(super) goes_on: &'a dyn Fn() -> bool,
}

impl Examiner<'_> {
    /// The smallest question with such a failure, and what has to be asked before it; `None` if the
    /// failure does not come again.
    pub(super) fn examine(
        mut self,
        drawn: &Drawn,
        kind: &Kind,
        before: &[Drawn],
    ) -> Option<Finding> {
        let goes_on = self.goes_on;
        let started = Instant::now();
        let time = if kind.is_of_conversation() { TIME_OF_CONVERSATIONS } else { TIME };
        let goes_on = move || goes_on() && started.elapsed() < time;
        if self.fails_after(&[], &drawn.check, kind, &goes_on).is_some() {
            self.alone(drawn, kind, &goes_on)
        } else {
            self.in_a_row(drawn, kind, before, &goes_on)
        }
    }

    /// A failure that needs nothing before it.
    fn alone(&mut self, drawn: &Drawn, kind: &Kind, goes_on: &dyn Fn() -> bool) -> Option<Finding> {
        let steps = match kind {
            kind if kind.is_slow() => SLOW_STEPS,
            kind if kind.is_of_conversation() => CONVERSATIONS,
            _ => STEPS,
        };
        let smaller = Smaller::new(self.scope, drawn);
        let smallest = shrink(drawn.probe.clone(), steps, goes_on, |probe| {
            Some(self.fails(&smaller.check(probe)?, kind).is_some())
        });
        let finding = |this: &mut Self, probe: &Probe| {
            let check = smaller.check(probe)?;
            let failure = this.fails_after(&[], &check, kind, goes_on)?;
            Some(row(Vec::new(), check, failure))
        };
        if let Some(finding) = finding(self, &smallest) {
            return Some(finding);
        }
        // What was asked while shrinking has played a part.
        let steps = steps.min(FRESH_STEPS);
        let smallest = shrink(drawn.probe.clone(), steps, goes_on, |probe| {
            Some(self.fails_after(&[], &smaller.check(probe)?, kind, goes_on).is_some())
        });
        finding(self, &smallest).or_else(|| finding(self, &drawn.probe))
    }

    /// A failure that depends on what was asked before it.
    fn in_a_row(
        &mut self,
        drawn: &Drawn,
        kind: &Kind,
        before: &[Drawn],
        goes_on: &dyn Fn() -> bool,
    ) -> Option<Finding> {
        let smaller = Smaller::new(self.scope, drawn);
        let steps = if kind.is_slow() { SLOW_STEPS } else { FRESH_STEPS };
        let mut before = fewest(before, None, steps, goes_on, |before| {
            self.fails_after(before, &drawn.check, kind, goes_on).is_some()
        })?;
        let smallest = shrink(drawn.probe.clone(), steps, goes_on, |probe| {
            Some(self.fails_after(&before, &smaller.check(probe)?, kind, goes_on).is_some())
        });
        let check = smaller.check(&smallest)?;
        for place in 0..before.len() {
            let Some(drawn) = before.get(place).cloned() else { continue };
            let smaller = Smaller::new(self.scope, &drawn);
            let with = |probe: &Probe| {
                let check = smaller.check(probe)?;
                let mut before = before.clone();
                let drawn = Drawn { probe: probe.clone(), check, ..drawn.clone() };
                before.iter_mut().skip(place).take(1).for_each(|slot| *slot = drawn.clone());
                Some(before)
            };
            let smallest = shrink(drawn.probe.clone(), steps, goes_on, |probe| {
                Some(self.fails_after(&with(probe)?, &check, kind, goes_on).is_some())
            });
            before = with(&smallest)?;
        }
        // All of it was asked in time before, so that it does not take long.
        let failure = self.fails_after(&before, &check, kind, &|| true)?;
        Some(row(before, check, failure))
    }

    /// Whether a check fails in this way now.
    fn fails(&mut self, check: &Check, kind: &Kind) -> Option<Failure> {
        let failure = Failure::of(check, self.subject.ask(&check.question))?;
        kind.is_like(&failure.kind).then_some(failure)
    }

    /// Whether it fails on a fresh process that is asked something before it; `None` too if there is
    /// no time to ask all of that.
    fn fails_after(
        &mut self,
        before: &[Drawn],
        check: &Check,
        kind: &Kind,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<Failure> {
        self.subject.restart();
        for drawn in before {
            if !goes_on() {
                return None;
            }
            self.subject.ask(&drawn.check.question);
        }
        self.fails(check, kind)
    }
}

/// Checks of the probes that one is shrunk to.
struct Smaller<'a> {
    scope: &'a Scope<'a>,
    drawn: &'a Drawn,
    /// The size of its question.
    size: usize,
}

impl<'a> Smaller<'a> {
    fn new(scope: &'a Scope<'a>, drawn: &'a Drawn) -> Self {
        Self { scope, drawn, size: size(&drawn.check) }
    }

    /// The check of a probe. A probe without a damage may be longer: `None` then, and if there is no
    /// right answer.
    fn check(&self, probe: &Probe) -> Option<Check> {
        let check = self.scope.check(probe, self.drawn.check.id.clone())?;
        (size(&check) <= self.size).then_some(check)
    }
}

/// The finding with its checks in a row.
fn row(before: Vec<Drawn>, check: Check, failure: Failure) -> Finding {
    let id = |place: usize| format!("{}.before-{}", check.id, place + 1);
    let before = before.into_iter().enumerate();
    let before = before.map(|(place, drawn)| Check { id: id(place), ..drawn.check }).collect();
    let Failure { kind, outcome } = failure;
    Finding { kind, check, before, outcome, times: 0 }
}
