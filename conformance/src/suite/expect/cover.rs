//! Few and short patterns that match failing checks, and no other.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::hash::{BuildHasher, RandomState};

use super::failures::Failures;
use crate::suite::plan::Plan;
use crate::suite::select;

/// Patterns that match the failing checks.
pub(super) struct Cover {
    /// By the place of the cause.
    pub(super) patterns: Vec<Vec<String>>,
    /// How many failing checks they don't match.
    pub(super) left_out: usize,
}

/// How many ids are written; nobody reads more.
const MOST_IDS: usize = 20_000;
/// How many globs are written; a few times more can't be looked for at once. Half of them may mix
/// causes.
const MOST_GLOBS: usize = 2000;
/// So many single ids are shown with their own causes. If there are more, globs may mix causes.
const FEW: usize = 200;
/// A glob has at most this many separators; ids have fewer.
const DEEPEST: usize = 8;

/// Covers the failing checks, the most general globs first. A glob has one `*`, which stands between
/// separators of an id. So the globs that match an id are the ways to cut it, and no glob has to be
/// tried on an id.
pub(super) fn cover(failures: &Failures, plan: &Plan<'_>, causes: usize) -> Cover {
    let mut globs = Globs::default();
    for mixed in [false, true] {
        for depth in 1..=DEEPEST {
            let left = globs.extend(failures, plan, Step { depth, mixed });
            if left == 0 || mixed && left <= FEW {
                break;
            }
        }
    }
    let mut cover = Cover { patterns: vec![Vec::new(); causes], left_out: 0 };
    let mut put = |cause: usize, pattern: String| {
        cover.patterns.get_mut(cause).into_iter().for_each(|own| own.push(pattern.clone()));
    };
    for (cause, text) in std::mem::take(&mut globs.texts) {
        put(cause, text);
    }
    let (mut written, mut single) = (0, 0);
    for id in plan.every_id() {
        let Some(cause) = failures.cause(&id) else { continue };
        if globs.match_id(&id) {
            written += 1;
        } else if single < MOST_IDS {
            single += 1;
            put(cause, select::exactly(&id));
        }
    }
    cover.left_out = failures.count().saturating_sub(written + single);
    cover
}

/// Globs that are looked for together.
#[derive(Clone, Copy)]
struct Step {
    /// How many separators they have.
    depth: usize,
    /// Whether they may match failures of several causes.
    mixed: bool,
}

/// The globs that are chosen.
#[derive(Default)]
struct Globs {
    hasher: RandomState,
    keys: HashSet<u64>,
    texts: Vec<(usize, String)>,
}

/// A glob that may be chosen.
struct Candidate {
    cause: usize,
    count: usize,
    is_pure: bool,
}

impl Globs {
    /// Whether a glob matches this id.
    fn match_id(&self, id: &str) -> bool {
        !self.keys.is_empty() && cuts(id).any(|cut| self.keys.contains(&self.key(&cut)))
    }

    fn key(&self, cut: &Cut<'_>) -> u64 {
        self.hasher.hash_one((cut.before, cut.after))
    }

    /// Adds the globs of a step. Returns how many failing checks no glob matched before.
    fn extend(&mut self, failures: &Failures, plan: &Plan<'_>, step: Step) -> usize {
        let open = |globs: &Self, id: &str| failures.cause(id).filter(|_| !globs.match_id(id));
        let mut left = 0;
        let mut candidates: HashMap<u64, Candidate> = HashMap::new();
        for id in plan.every_id() {
            let Some(cause) = open(self, &id) else { continue };
            left += 1;
            for cut in cuts_at(&id, step.depth) {
                let new = Candidate { cause, count: 0, is_pure: true };
                let candidate = candidates.entry(self.key(&cut)).or_insert(new);
                candidate.count += 1;
                if failures.is_flaky(candidate.cause) {
                    candidate.cause = cause;
                }
                candidate.is_pure &= failures.joins(cause, candidate.cause);
            }
        }
        candidates.retain(|_, it| it.count > 1 && (it.is_pure || step.mixed));
        if candidates.is_empty() {
            return left;
        }
        for id in plan.every_id() {
            let cause = failures.cause(&id);
            let is_open = !step.mixed || open(self, &id).is_some();
            for cut in cuts_at(&id, step.depth) {
                let key = self.key(&cut);
                let is_good = candidates.get(&key).is_some_and(|it| {
                    is_open && cause.is_some_and(|own| step.mixed || failures.joins(own, it.cause))
                });
                if !is_good {
                    candidates.remove(&key);
                }
            }
        }
        self.choose(failures, plan, step, &candidates);
        left
    }

    /// Takes for each failing check the glob that matches most.
    fn choose(
        &mut self,
        failures: &Failures,
        plan: &Plan<'_>,
        step: Step,
        candidates: &HashMap<u64, Candidate>,
    ) {
        let mut chosen: BTreeMap<u64, (usize, String)> = BTreeMap::new();
        for id in plan.every_id() {
            if failures.cause(&id).is_none() || self.match_id(&id) {
                continue;
            }
            let own = cuts_at(&id, step.depth);
            let own = own.filter_map(|cut| Some((candidates.get(&self.key(&cut))?, cut)));
            if let Some((candidate, cut)) = own.max_by_key(|(candidate, _)| candidate.count) {
                chosen.entry(self.key(&cut)).or_insert_with(|| (candidate.cause, cut.glob()));
            }
        }
        let most = if step.mixed { MOST_GLOBS } else { MOST_GLOBS / 2 };
        let room = most.saturating_sub(self.texts.len());
        let mut chosen: Vec<_> = chosen.into_iter().take(room).collect();
        chosen.sort_unstable_by(|(_, one), (_, other)| one.cmp(other));
        for (key, text) in chosen {
            self.keys.insert(key);
            self.texts.push(text);
        }
    }
}

/// An id without its middle, which begins and ends at a separator.
struct Cut<'a> {
    before: &'a str,
    after: &'a str,
}

impl Cut<'_> {
    fn glob(&self) -> String {
        let quoted = |text: &str| select::exactly(text);
        format!("{}*{}", quoted(self.before), quoted(self.after))
    }
}

/// Every way to cut an id, so that something is before the cut: a glob that begins with a star says little to a
/// reader.
fn cuts(id: &str) -> impl Iterator<Item = Cut<'_>> {
    let separators = separators(id);
    (1..=separators.len()).flat_map(move |depth| cuts_between(id, separators.clone(), depth))
}

/// The ways to cut an id that keep this many separators.
fn cuts_at(id: &str, depth: usize) -> impl Iterator<Item = Cut<'_>> {
    cuts_between(id, separators(id), depth)
}

/// The places of the separators of an id.
fn separators(id: &str) -> Vec<usize> {
    let bytes = id.bytes().enumerate();
    bytes.filter(|(_, byte)| matches!(byte, b'.' | b'/')).map(|(place, _)| place).collect()
}

/// The ways to keep `depth` of these separators: from one to all of them before the cut, the others behind it.
fn cuts_between(id: &str, separators: Vec<usize>, depth: usize) -> impl Iterator<Item = Cut<'_>> {
    let most = if depth <= separators.len() { depth } else { 0 };
    (1..=most).filter_map(move |before| {
        let end = separators.get(before - 1)? + 1;
        let behind = separators.len() - (depth - before);
        let start = separators.get(behind).copied().unwrap_or(id.len());
        Some(Cut { before: id.get(..end)?, after: id.get(start..)? })
    })
}
