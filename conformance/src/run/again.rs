//! Asks what failed again, in a second process of the subject.
//!
//! A failure that does not come again is not a fact about the check: the answer depends on what was
//! asked before, or on time. It becomes [`Verdict::Flaky`], and the fewest earlier requests that
//! bring it about are searched.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use super::history::{History, Mark};
use super::lock;
use crate::legible::{LONGEST_TEXT, excerpt, legible};
use crate::shrink::fewest;
use crate::subject::Subject;
use crate::suite::check::Check;
use crate::verdict::{After, Outcome, Verdict};

/// A report shows so many checks of a requirement and verdict. Each of these fails alone, when a
/// process that has just started is asked nothing else.
const SHOWN: usize = 5;
/// After so many failures of a kind that fail alone, a failure of that kind is believed also if the
/// second process was asked something before.
const BELIEVED: usize = SHOWN;
/// The same if one of that kind turned out not to be a fact.
const BELIEVED_RARELY: usize = 100;
/// After so many that are no facts, it is believed that they are none without a new start.
const DISBELIEVED: usize = 5;
/// For how many flaky outcomes of a requirement and op earlier requests are searched, until one
/// search succeeds.
const SEARCHES: u32 = 3;
/// How many requests are asked to take parts out of a row of earlier ones, and how many such rows
/// are tried at least and at most.
const REQUESTS: usize = 20_000;
const STEPS: (usize, usize) = (40, 200);
/// How long one search takes at most, and all of a run.
const TIME: Duration = Duration::from_secs(5);
const RUN_TIME: Duration = Duration::from_secs(20);

/// What failed in the first process.
#[derive(Debug)]
pub(super) struct Doubt {
    pub(super) check: Arc<Check>,
    /// Where it was asked, in the history of which process.
    pub(super) asked: Option<(Arc<Mutex<History>>, Mark)>,
    /// What losing the process cost, if it was lost.
    pub(super) lost: Option<Lost>,
}

/// A process that was lost.
#[derive(Debug)]
pub(super) struct Lost {
    /// The end of its error output.
    pub(super) log: String,
    pub(super) took: Duration,
}

/// A second process of the subject.
pub(super) struct Again {
    subject: Box<dyn Subject + Send>,
    /// How many questions it was asked since it was started.
    asked: usize,
    /// Whether it must be started anew before the next question.
    is_spoilt: bool,
    /// Whether it can't be started.
    is_gone: bool,
    kinds: HashMap<(String, &'static str, Verdict), Kind>,
    /// By requirement and op: how many searches are left.
    searches: HashMap<(String, &'static str), u32>,
    /// How much time is left to search.
    time: Duration,
}

/// What is known of the failures of a requirement, op and verdict.
#[derive(Debug, Default)]
struct Kind {
    /// How many fail alone.
    alone: usize,
    /// The sizes of the smallest of these.
    smallest: Vec<usize>,
    /// How many do not come again.
    flaky: usize,
}

impl Kind {
    /// Whether one that fails in a process that was asked something before fails alone, too.
    fn is_believed(&self, size: usize) -> bool {
        let enough = if self.flaky == 0 { BELIEVED } else { BELIEVED_RARELY };
        let is_shown = self.smallest.last().is_none_or(|largest| size < *largest);
        self.alone >= enough && !is_shown
    }

    fn add_alone(&mut self, size: usize) {
        self.alone += 1;
        let place = self.smallest.partition_point(|other| *other <= size);
        self.smallest.insert(place, size);
        self.smallest.truncate(SHOWN);
    }
}

impl Again {
    pub(super) fn new(subject: Box<dyn Subject + Send>) -> Self {
        let (kinds, searches) = (HashMap::new(), HashMap::new());
        let (is_spoilt, is_gone) = (false, false);
        Self { subject, asked: 0, is_spoilt, is_gone, kinds, searches, time: RUN_TIME }
    }

    /// The outcome after the question was asked again.
    pub(super) fn settle(
        &mut self,
        mut outcome: Outcome,
        doubt: &Doubt,
        goes_on: &dyn Fn() -> bool,
    ) -> Outcome {
        if self.is_gone {
            return outcome;
        }
        let check = &doubt.check;
        let size = check.question.to_string().len();
        let key = (check.requirement.clone(), check.question.name(), outcome.verdict);
        let mut alone = self.asked == 0 || self.is_spoilt;
        let mut again = self.ask(check);
        let comes_again = again.verdict == outcome.verdict;
        let kind = self.kinds.entry(key.clone()).or_default();
        let is_believed =
            if comes_again { kind.is_believed(size) } else { kind.flaky >= DISBELIEVED };
        if !alone && !is_believed && again.verdict != Verdict::NotRun {
            self.is_spoilt = true;
            (alone, again) = (true, self.ask(check));
        }
        if again.verdict == Verdict::NotRun {
            self.is_gone = true;
            outcome.detail = format!("{}; not asked again: {}", outcome.detail, again.detail);
            return outcome;
        }
        let kind = self.kinds.entry(key).or_default();
        if again.verdict != outcome.verdict {
            kind.flaky += 1;
            return self.flaky(outcome, &again, doubt, goes_on);
        }
        if alone {
            kind.add_alone(size);
        }
        if doubt.lost.is_some() {
            let log = excerpt(&self.subject.log());
            outcome.log = (!log.is_empty()).then_some(log).or(outcome.log);
        }
        outcome
    }

    /// Asks a check, of a new process if necessary.
    fn ask(&mut self, check: &Check) -> Outcome {
        if std::mem::take(&mut self.is_spoilt) {
            self.subject.restart();
            self.asked = 0;
        }
        self.asked += 1;
        let outcome = check
            .clone()
            .judge(self.subject.ask_until(&check.question, &|answer| check.is_met(answer)));
        let broke = [Verdict::Crash, Verdict::Timeout, Verdict::AdapterFault];
        self.is_spoilt = broke.contains(&outcome.verdict);
        outcome
    }

    /// The outcome of a check that failed and does not fail in the same way again.
    fn flaky(
        &mut self,
        mut outcome: Outcome,
        again: &Outcome,
        doubt: &Doubt,
        goes_on: &dyn Fn() -> bool,
    ) -> Outcome {
        let then = match (outcome.verdict, again.verdict) {
            (Verdict::Timeout, Verdict::Pass | Verdict::Recorded) => {
                "answered in time when asked again; --timeout gives it more".to_owned()
            }
            (_, Verdict::Pass | Verdict::Recorded) => "right when asked again".to_owned(),
            (_, verdict) => {
                let actual = again.actual.as_ref().map(|actual| format!(": {actual}"));
                let actual = legible(&actual.unwrap_or_default(), LONGEST_TEXT);
                format!("asked again it is another answer ({verdict}, {}{actual})", again.detail)
            }
        };
        let row = self.search(outcome.verdict, doubt, goes_on);
        let needs = match &row {
            None => String::new(),
            Some(row) => match row.len() {
                0 => "; nothing asked before was found to bring it about".to_owned(),
                1 => "; it fails after 1 earlier request".to_owned(),
                many => format!("; it fails after {many} earlier requests"),
            },
        };
        outcome.after = row.filter(|row| !row.is_empty()).map(|row| {
            let ids: Vec<_> = row.iter().map(|check| check.id.as_str()).collect();
            After::of(&ids)
        });
        outcome.detail = format!("{}; {then}{needs}", outcome.detail);
        outcome.verdict = Verdict::Flaky;
        outcome
    }

    /// Searches the fewest earlier requests that bring a failure about; none if nothing does. `None`
    /// without a search.
    fn search(
        &mut self,
        verdict: Verdict,
        doubt: &Doubt,
        goes_on: &dyn Fn() -> bool,
    ) -> Option<Vec<Arc<Check>>> {
        let key = (doubt.check.requirement.clone(), doubt.check.question.name());
        let left = *self.searches.get(&key).unwrap_or(&SEARCHES);
        if left == 0 || self.time.is_zero() {
            return None;
        }
        let (history, mark) = doubt.asked.as_ref()?;
        let before = lock(history).before(*mark);
        let (started, time) = (Instant::now(), TIME.min(self.time));
        let goes_on = || goes_on() && started.elapsed() < time;
        let likely = self.first_failure(&before, &goes_on);
        let steps = (REQUESTS / before.len().max(1)).clamp(STEPS.0, STEPS.1);
        let row = fewest(&before, likely, steps, &goes_on, |before| {
            self.fails_after(before, &doubt.check, verdict, &goes_on)
        });
        // An empty row means that it fails alone now and then.
        let row = row.unwrap_or_default();
        self.is_spoilt = true;
        self.time = self.time.saturating_sub(started.elapsed());
        self.searches.insert(key, if row.is_empty() { left - 1 } else { 0 });
        Some(row)
    }

    /// How many checks a new process is asked before the first that fails: as many as bring a
    /// failure about in a library that counts.
    fn first_failure(
        &mut self,
        before: &[Arc<Check>],
        goes_on: &dyn Fn() -> bool,
    ) -> Option<usize> {
        self.subject.restart();
        let fails = |check: &Arc<Check>| {
            let answer = self.subject.ask(&check.question);
            !goes_on() || Check::clone(check).judge(answer).verdict.is_failure()
        };
        before.iter().position(fails).filter(|place| *place > 0)
    }

    /// Whether a check fails in this way in a new process that is asked something before it.
    fn fails_after(
        &mut self,
        before: &[Arc<Check>],
        check: &Check,
        verdict: Verdict,
        goes_on: &dyn Fn() -> bool,
    ) -> bool {
        self.subject.restart();
        for earlier in before {
            if !goes_on() {
                return false;
            }
            self.subject.ask(&earlier.question);
        }
        goes_on() && check.clone().judge(self.subject.ask(&check.question)).verdict == verdict
    }
}
