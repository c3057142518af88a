//! Black-box fuzzing of an implementation through its adapter, to find failures that no check
//! foresees.
//!
//! Probes are generated from a seed, and the reference model gives the right answers. Each failure
//! is asked again of a fresh process and shrunk to the smallest question of its kind, with the
//! questions before it if it depends on them.
//!
//! Probes are drawn in batches, and a batch is dealt to the subject's processes in turn. So the same
//! seed asks the same probes for any number of processes, and finds the same failures if the
//! answers depend neither on earlier questions nor on time. A limit in time ends a run, and the
//! shrinking of a slow subject, at another place each time.

mod ask;
mod change;
mod examine;
mod finding;
mod lane;
mod payload;
mod probe;
mod shrink;
mod source;
mod talk;
mod topic;
mod wire;

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64};

use actucheck_spec::Spec;

use self::examine::Examiner;
use self::finding::{Failure, size};
use self::lane::{Heard, Lane, Shared};
use self::probe::Probe;
use self::source::{Drawn, Source};
use self::topic::Topics;
use crate::adapter::{Hello, Permissions, Wire};
use crate::subject::Subject;
use crate::suite::Author;
use crate::suite::check::Check;
use crate::suite::device::Target;
use crate::suite::partition::Partition;

pub use finding::{Finding, Kind, Symptom};
pub use topic::{NotAsked, Topic};

/// The number of probes that are generated before they are asked.
const BATCH: u64 = 256;
/// After so many drawn probes in a row that are not asked, there is nothing left to ask.
const FRUITLESS: u32 = 5_000;
/// How often failures of one kind are examined: some do not come again, and another one may be
/// smaller than the smallest so far.
const EXAMINED: u32 = 4;

/// The same of conversations, which take longer.
const BATCH_OF_CONVERSATIONS: u64 = 32;

/// Which probes are asked.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// The wire of the probes.
    pub wire: Wire,
    /// Where the probes come from.
    pub seed: u64,
    /// How many are asked.
    pub cases: u64,
    /// Who is asked.
    pub asks: Asks<'a>,
    /// The part of the probes that is asked, if not all are.
    pub part: Option<Partition>,
}

/// Who is asked.
#[derive(Clone, Copy, Debug)]
pub enum Asks<'a> {
    /// A codec, one question after the other.
    Codec,
    /// A host, in conversations.
    Host,
    /// This device, in conversations that are allowed.
    Device(&'a Target<'a>, &'a Permissions),
}

impl<'a> Asks<'a> {
    /// The device, if one is asked, and what may be done to it.
    const fn device(self) -> Option<(&'a Target<'a>, &'a Permissions)> {
        match self {
            Self::Device(target, allowed) => Some((target, allowed)),
            Self::Codec | Self::Host => None,
        }
    }
}

/// The result of fuzzing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fuzzed {
    /// How many probes were asked.
    pub asked: u64,
    /// The kinds of failure found, in the order in which they were found.
    pub findings: Vec<Finding>,
    /// Kinds of failure that did not come again on a fresh process, neither alone nor after what was
    /// asked before, as far as there was time to ask.
    pub passing: Vec<Finding>,
    /// What was not asked, or not any more.
    pub not_asked: NotAsked,
    /// Why fuzzing was given up, if it was.
    pub given_up: Option<String>,
}

/// Whether there are conversations of hosts on a wire.
#[must_use]
pub fn has_conversations(wire: Wire) -> bool {
    wire::of(wire).is_some_and(|probes| probes.host.is_some())
}

/// Whether there are conversations with devices on a wire.
#[must_use]
pub fn has_requests(wire: Wire) -> bool {
    wire::of(wire).is_some_and(|probes| probes.requests.is_some())
}

/// Asks the processes of a subject the probes of the options. `watch` is called with the number of
/// probes asked and of kinds of failure found; fuzzing ends when it breaks.
pub fn fuzz(
    spec: &Spec,
    options: &Options<'_>,
    subjects: &mut [Box<dyn Subject + Send>],
    watch: &(dyn Fn(u64, usize) -> ControlFlow<()> + Sync),
) -> Fuzzed {
    let Some(hello) = subjects.first().map(|subject| subject.hello().clone()) else {
        return Fuzzed::default();
    };
    let mut lanes: Vec<_> =
        subjects.iter_mut().map(|subject| Lane::new(subject.as_mut())).collect();
    let device = options.asks.device();
    let scope = Scope { author: Author { spec, wire: options.wire }, hello: &hello, device };
    let Some(source) = Source::new(&scope, options) else {
        let given_up = Some(format!("the adapter offers no op of {}", options.wire));
        return Fuzzed { given_up, ..Fuzzed::default() };
    };
    let (topics, known, result) = (Topics::default(), BTreeMap::new(), Fuzzed::default());
    let mut fuzzer = Fuzzer { scope: &scope, source, topics, known, result, of_others: 0 };
    while fuzzer.dealt() < options.cases && fuzzer.result.given_up.is_none() {
        fuzzer.draw(options, &mut lanes);
        let found = fuzzer.result.findings.len();
        // A batch of other parts only asks nothing.
        if watch(fuzzer.result.asked, found).is_break() {
            break;
        }
        let shared = Shared {
            asked: AtomicU64::new(fuzzer.result.asked),
            over: AtomicBool::new(false),
            watch: &|asked| watch(asked, found),
        };
        ask(&mut lanes, &shared);
        fuzzer.result.asked = shared.asked.into_inner();
        fuzzer.judge(&mut lanes, watch);
        if shared.over.into_inner() {
            break;
        }
    }
    fuzzer.end()
}

/// Checks of the first probes, `cases` at most.
#[must_use]
pub fn checks(spec: &Spec, options: &Options<'_>, hello: &Hello) -> Vec<Check> {
    let device = options.asks.device();
    let scope = Scope { author: Author { spec, wire: options.wire }, hello, device };
    let Some(mut source) = Source::new(&scope, options) else { return Vec::new() };
    let cases = usize::try_from(options.cases).unwrap_or(usize::MAX);
    let rows = std::iter::repeat_with(|| source.draw(|_| true)).take(cases);
    rows.flatten().map(|drawn| drawn.check).take(cases).collect()
}

/// Asks every lane its part of the batch.
fn ask(lanes: &mut [Lane<'_>], shared: &Shared<'_>) {
    if let [lane] = lanes {
        lane.ask(shared);
        return;
    }
    std::thread::scope(|scope| {
        for lane in lanes {
            scope.spawn(|| lane.ask(shared));
        }
    });
}

/// What the probes are about, and who is asked.
struct Scope<'a> {
    author: Author<'a>,
    hello: &'a Hello,
    /// The device that is asked, if it is one, and what may be done to it.
    device: Option<(&'a Target<'a>, &'a Permissions)>,
}

impl Scope<'_> {
    /// The check of a probe; `None` if there is no right answer.
    fn check(&self, probe: &Probe, id: String) -> Option<Check> {
        probe.check(&self.author, (self.hello, self.device), id)
    }

    /// What a probe is about.
    fn topics(&self, probe: &Probe) -> Vec<Topic> {
        probe.topics(self.author.spec, self.author.wire)
    }
}

struct Fuzzer<'a> {
    scope: &'a Scope<'a>,
    source: Source<'a>,
    topics: Topics,
    known: BTreeMap<Kind, Known>,
    result: Fuzzed,
    /// How many probes were drawn that other parts ask.
    of_others: u64,
}

/// What is known of a kind of failure.
struct Known {
    /// How often it occurred.
    times: u64,
    /// How often one was examined.
    examined: u32,
    /// The place among the findings, if it came again.
    found: Option<usize>,
    /// The first one.
    first: Finding,
}

impl Fuzzer<'_> {
    /// How many probes were asked by this part, or are for others to ask.
    const fn dealt(&self) -> u64 {
        self.result.asked.saturating_add(self.of_others)
    }

    /// Draws a batch and deals it to the lanes. Probes that are best asked in a row go to one lane, and
    /// belong to one part.
    fn draw(&mut self, options: &Options<'_>, lanes: &mut [Lane<'_>]) {
        let batch = match options.asks {
            Asks::Codec => BATCH,
            Asks::Host | Asks::Device(..) => BATCH_OF_CONVERSATIONS,
        };
        let mut left = batch.min(options.cases.saturating_sub(self.dealt()));
        let (mut turn, mut fruitless) = (0, 0);
        while left > 0 {
            let first = self.source.next_id();
            let row = self.row(left);
            let many = u64::try_from(row.len()).unwrap_or(left);
            left -= many;
            fruitless = if row.is_empty() { fruitless + 1 } else { 0 };
            if fruitless >= FRUITLESS {
                let reason = "there is nothing to ask: the adapter skips every kind of question";
                self.result.given_up = Some(reason.to_owned());
                return;
            }
            if row.is_empty() {
                continue;
            }
            if options.part.is_some_and(|part| !part.has(&first)) {
                self.of_others += many;
                continue;
            }
            let lane = turn % lanes.len().max(1);
            turn += 1;
            lanes.iter_mut().skip(lane).take(1).for_each(|lane| lane.deal(row.clone()));
        }
    }

    /// Draws probes that are asked in a row, `most` at most, without those that the adapter skips.
    fn row(&mut self, most: u64) -> Vec<Drawn> {
        let (scope, topics) = (self.scope, &mut self.topics);
        let mut row = self.source.draw(|probe| topics.are_open(&scope.topics(probe)));
        row.retain(|Drawn { probe, check, .. }| {
            topics.are_for(&scope.topics(probe), &check.question, scope.hello)
        });
        row.truncate(usize::try_from(most).unwrap_or(usize::MAX));
        row
    }

    /// Looks at the answers to a batch in the order of the probes.
    fn judge(
        &mut self,
        lanes: &mut [Lane<'_>],
        watch: &(dyn Fn(u64, usize) -> ControlFlow<()> + Sync),
    ) {
        let mut answers = Vec::new();
        for (number, lane) in lanes.iter_mut().enumerate() {
            for (place, heard) in lane.take_answers() {
                answers
                    .extend(lane.probe(place).cloned().map(|drawn| (drawn, number, place, heard)));
            }
        }
        answers.sort_by_key(|(drawn, ..)| drawn.number);
        for (drawn, number, place, heard) in answers {
            let Some(lane) = lanes.get_mut(number) else { continue };
            let topics = self.scope.topics(&drawn.probe);
            match heard {
                Heard::Right => self.topics.note(&topics, None),
                Heard::Skipped(reason) => self.topics.note(&topics, Some(&reason)),
                Heard::Lost(reason) => {
                    self.result.given_up.get_or_insert(reason);
                }
                Heard::Wrong(failed) => {
                    self.topics.note(&topics, None);
                    let (before, (drawn, failure)) = (lane.before(place), *failed);
                    self.fail(&drawn, failure, lane, &before, watch);
                }
            }
        }
        lanes.iter_mut().for_each(Lane::end_batch);
    }

    /// Counts a failure, and examines it if it is new or smaller.
    fn fail(
        &mut self,
        drawn: &Drawn,
        failure: Failure,
        lane: &mut Lane<'_>,
        before: &[Drawn],
        watch: &(dyn Fn(u64, usize) -> ControlFlow<()> + Sync),
    ) {
        let Failure { kind, outcome } = failure;
        let known = self.known.entry(kind.clone()).or_insert_with(|| {
            let (kind, check) = (kind.clone(), drawn.check.clone());
            let first = Finding { kind, check, before: Vec::new(), outcome, times: 0 };
            Known { times: 0, examined: 0, found: None, first }
        });
        known.times += 1;
        if known.examined >= EXAMINED {
            return;
        }
        let smallest = known.found.and_then(|place| self.result.findings.get_mut(place));
        let worth = smallest.as_ref().is_none_or(|finding| size(&drawn.check) < finding.size());
        if !worth {
            return;
        }
        known.examined += 1;
        lane.is_examined = true;
        let asked = self.result.asked;
        let found = self.known.values().filter(|known| known.found.is_some()).count();
        let goes_on = || watch(asked, found).is_continue();
        let examiner = Examiner { scope: self.scope, subject: lane.subject, goes_on: &goes_on };
        let Some(finding) = examiner.examine(drawn, &kind, before) else { return };
        // What is left of it may be of another kind.
        let findings = &mut self.result.findings;
        let place = findings.iter().position(|other| other.kind == finding.kind);
        if let Some(known) = self.known.get_mut(&kind) {
            known.found = Some(place.unwrap_or(findings.len()));
        }
        match place.and_then(|place| findings.get_mut(place)) {
            Some(smallest) if finding.size() < smallest.size() => *smallest = finding,
            Some(_) => {}
            None => findings.push(finding),
        }
    }

    /// The result.
    fn end(mut self) -> Fuzzed {
        for Known { times, found, first, .. } in self.known.into_values() {
            match found.and_then(|place| self.result.findings.get_mut(place)) {
                Some(finding) => finding.times += times,
                None => self.result.passing.push(Finding { times, ..first }),
            }
        }
        // Smaller ones have turned out to be of another kind.
        self.result.findings.retain(|finding| finding.times > 0);
        self.result.not_asked = self.topics.not_asked();
        self.result
    }
}
