//! A lazy list of checks: a check is built when it is asked.
//!
//! A plan is a list of families; a family yields groups, and a group builds its checks. To find an
//! id or a glob, the plan compares it with the prefix of each family and then with the ids that
//! each group names. Nothing else is built, and only a few groups are in memory at any time.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::Arc;

use actucheck_spec::model::Level;

use super::basics::is_basic;
use super::check::Check;
use super::partition::{Fingerprint, Partition};
use super::select::Patterns;
use crate::names::nearest;

/// Every check of a run, in a fixed order.
pub struct Plan<'a> {
    families: Vec<Family<'a>>,
    only: Patterns,
    not: Patterns,
    level: Level,
    part: Option<Partition>,
}

/// How many checks are selected, and which.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Outline {
    /// How many they are.
    pub checks: usize,
    /// A hash of their ids, in their order.
    pub ids: String,
}

/// A check that a part asks.
pub(crate) struct Numbered {
    pub(crate) id: String,
    /// Its number among all that are selected, from 1.
    pub(crate) number: usize,
    /// Whether it belongs to the part. Others rest on one that does not.
    pub(crate) is_own: bool,
}

/// The ids of a group's selected checks.
struct Members {
    ids: Vec<String>,
    is_own: bool,
    is_asked: bool,
}

/// Groups whose checks' ids have a common prefix.
pub(crate) struct Family<'a> {
    prefix: String,
    groups: Yield<'a>,
    /// Groups for their ids only, if making the real groups is more expensive.
    named: Option<Yield<'a>>,
}

type Yield<'a> = Box<dyn Fn() -> Groups<'a> + Send + Sync + 'a>;

/// Groups, one after the other.
type Groups<'a> = Box<dyn Iterator<Item = Group<'a>> + Send + 'a>;

/// Checks that one subject is asked in order. A check may require an earlier check of its group.
pub(crate) struct Group<'a> {
    stem: String,
    names: Names,
    build: Build<'a>,
}

/// Builds the checks of a group, given its stem.
type Build<'a> = Box<dyn FnOnce(&str) -> Vec<Check> + Send + 'a>;

/// The rest of the id of each check of a group, after the stem.
enum Names {
    /// The same for many groups.
    Fixed(&'static [&'static str]),
    /// Names of one group only.
    Own(Vec<String>),
}

impl Names {
    fn iter(&self) -> impl Iterator<Item = &str> {
        let (fixed, own): (&[&str], &[String]) = match self {
            Self::Fixed(names) => (names, &[]),
            Self::Own(names) => (&[], names),
        };
        fixed.iter().copied().chain(own.iter().map(String::as_str))
    }
}

impl<'a> Plan<'a> {
    pub(crate) fn new(families: Vec<Family<'a>>) -> Self {
        let (only, not) = (Patterns::default(), Patterns::default());
        Self { families, only, not, level: Level::May, part: None }
    }

    /// A plan of these checks only, as one group: one subject is asked them all.
    #[must_use]
    pub fn of(checks: Vec<Check>) -> Self {
        let mut plan = Self::new(Vec::new());
        plan.add(checks);
        plan
    }

    /// Adds the checks of another plan at the end.
    #[must_use]
    pub fn and(mut self, other: Self) -> Self {
        self.families.extend(other.families);
        self
    }

    /// Adds these checks at the end, as one group.
    pub fn add(&mut self, checks: Vec<Check>) {
        let checks: Arc<[Check]> = checks.into();
        self.families.push(Family::new("", move || {
            let names = checks.iter().map(|check| check.id.clone()).collect();
            let checks = Arc::clone(&checks);
            let build = Box::new(move |_: &str| checks.to_vec());
            std::iter::once(Group { stem: String::new(), names: Names::Own(names), build })
        }));
    }

    /// Keeps the checks whose id matches any pattern of `only` (all checks if there are none),
    /// whose id matches no pattern of `not`, and whose level is `level` or stricter.
    ///
    /// # Errors
    /// If a pattern is not a glob or matches no check.
    pub fn restrict(
        &mut self,
        only: &[String],
        not: &[String],
        level: Level,
    ) -> Result<(), String> {
        (self.only, self.not) = (self.patterns(only)?, self.patterns(not)?);
        self.level = level;
        Ok(())
    }

    /// Keeps the selected checks of a part. Basic checks are asked in every part, as the others rest on
    /// them: only so their failures are charged as in the whole.
    pub fn take_part(&mut self, part: Partition) {
        self.part = Some(part);
    }

    /// The part, if it is one.
    #[must_use]
    pub const fn part(&self) -> Option<Partition> {
        self.part
    }

    /// Patterns each of which matches a check.
    fn patterns(&self, texts: &[String]) -> Result<Patterns, String> {
        let patterns = Patterns::new(texts.iter().map(String::as_str))?;
        match self.unmatched(&patterns).first().and_then(|place| texts.get(*place)) {
            Some(text) => Err(format!("`{text}` matches no check; {}", self.hint(text))),
            None => Ok(patterns),
        }
    }

    /// What somebody means whose pattern matches no check.
    fn hint(&self, text: &str) -> String {
        let part = text.trim_matches('*');
        match self.nearest(part) {
            Some(id) if id.contains(part) => format!("did you mean `*{part}*`?"),
            Some(id) => format!("did you mean `{id}`?"),
            None => "`*` stands for any text, as in `*stuffing*`".to_owned(),
        }
    }

    /// The places of the patterns that match no check, even if the plan is restricted.
    pub(super) fn unmatched(&self, patterns: &Patterns) -> BTreeSet<usize> {
        let mut idle: BTreeSet<_> = (0..patterns.texts().len()).collect();
        self.each_match(patterns, |place| {
            idle.remove(&place);
            if idle.is_empty() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        idle
    }

    /// How many checks each pattern matches, even if the plan is restricted.
    #[must_use]
    pub fn count_matches(&self, patterns: &Patterns) -> Vec<usize> {
        let mut counts = vec![0; patterns.texts().len()];
        self.each_match(patterns, |place| {
            counts.get_mut(place).into_iter().for_each(|count| *count += 1);
            ControlFlow::Continue(())
        });
        counts
    }

    /// Calls back with the index of a pattern for each id that it matches. No check is built.
    fn each_match(&self, patterns: &Patterns, mut matched: impl FnMut(usize) -> ControlFlow<()>) {
        let may_match = |beginning: &str| patterns.may_match(beginning);
        let families = self.families.iter().filter(|family| may_match(&family.prefix));
        let groups = families.flat_map(Family::named).filter(|group| may_match(&group.stem));
        for id in groups.flat_map(|group| group.ids().collect::<Vec<_>>()) {
            for place in patterns.matches(&id) {
                if matched(place).is_break() {
                    return;
                }
            }
        }
    }

    /// The groups that have a check to ask, in order.
    pub(crate) fn groups(&self) -> impl Iterator<Item = Group<'a>> + Send + '_ {
        self.selected().filter(|group| self.part.is_none() || self.is_asked(group))
    }

    /// The groups that have a selected check, in whichever part.
    fn selected(&self) -> impl Iterator<Item = Group<'a>> + Send + '_ {
        let families = self.families.iter().filter(|family| {
            self.is_whole()
                || self.may_have(&family.prefix)
                    && family.named().any(|group| self.has_some(&group))
        });
        families
            .flat_map(|family| (family.groups)())
            .filter(|group| self.is_whole() || self.has_some(group))
    }

    /// Whether a group belongs to the part.
    fn is_own(&self, group: &Group<'_>) -> bool {
        self.part.is_none_or(|part| group.ids().next().is_some_and(|id| part.has(&id)))
    }

    fn is_asked(&self, group: &Group<'_>) -> bool {
        self.is_own(group) || group.ids().next().is_some_and(|id| is_basic(&id))
    }

    /// Whether every check of the group is selected.
    fn is_whole(&self) -> bool {
        self.only.is_empty() && self.not.is_empty() && self.level == Level::May
    }

    fn may_have(&self, beginning: &str) -> bool {
        self.only.is_empty() || self.only.may_match(beginning)
    }

    fn has_some(&self, group: &Group<'_>) -> bool {
        self.may_have(&group.stem) && group.ids().any(|id| self.has(&id))
    }

    /// The selected checks of a group.
    pub(crate) fn build(&self, group: Group<'_>) -> Vec<Check> {
        let mut checks = (group.build)(&group.stem);
        if self.is_whole() {
            return checks;
        }
        checks.retain(|check| self.has(&check.id) && check.level <= self.level);
        checks
    }

    fn has(&self, id: &str) -> bool {
        (self.only.is_empty() || self.only.is_match(id)) && !self.not.is_match(id)
    }

    /// Every check that is asked; each is built when it is needed.
    pub fn checks(&self) -> impl Iterator<Item = Check> + '_ {
        self.groups().flat_map(|group| self.build(group))
    }

    /// The id of every check that belongs to the plan. No check is built, unless the level is restricted.
    pub fn ids(&self) -> impl Iterator<Item = String> + '_ {
        self.members().filter(|group| group.is_own).flat_map(|group| group.ids)
    }

    /// What is selected, in whichever part.
    #[must_use]
    pub fn outline(&self) -> Outline {
        let (mut checks, mut hash) = (0, Fingerprint::new());
        for id in self.members().flat_map(|group| group.ids) {
            checks += 1;
            hash.add(&id);
            hash.add("\n");
        }
        Outline { checks, ids: hash.to_string() }
    }

    /// The checks that are asked, in order.
    pub(crate) fn numbered(&self) -> impl Iterator<Item = Numbered> + Send + '_ {
        let numbers = self.members().scan(0, |last, Members { ids, is_own, is_asked }| {
            let first = *last + 1;
            *last += ids.len();
            let ids = if is_asked { ids } else { Vec::new() };
            let numbered = (first..).zip(ids);
            Some(numbered.map(move |(number, id)| Numbered { id, number, is_own }))
        });
        numbers.flatten()
    }

    /// The ids of the selected checks by group, in whichever part.
    fn members(&self) -> Box<dyn Iterator<Item = Members> + Send + '_> {
        let members = |ids, (is_own, is_asked)| Members { ids, is_own, is_asked };
        let whose = |group: &Group<'_>| (self.is_own(group), self.is_asked(group));
        if self.level != Level::May {
            return Box::new(self.selected().map(move |group| {
                let whose = whose(&group);
                members(self.build(group).into_iter().map(|check| check.id).collect(), whose)
            }));
        }
        let families = self.families.iter().filter(|family| self.may_have(&family.prefix));
        let groups = families.flat_map(Family::named).filter(|group| self.may_have(&group.stem));
        Box::new(groups.map(move |group| {
            members(group.ids().filter(|id| self.has(id)).collect(), whose(&group))
        }))
    }

    /// The id of every check, even if the plan is restricted.
    pub(super) fn every_id(&self) -> impl Iterator<Item = String> {
        let groups = self.families.iter().flat_map(Family::named);
        groups.flat_map(|group| group.ids().collect::<Vec<_>>())
    }

    /// How many checks belong to the plan.
    #[must_use]
    pub fn size(&self) -> usize {
        if self.is_whole() {
            let groups = self.families.iter().flat_map(Family::named);
            groups.filter(|group| self.is_own(group)).map(|group| group.size()).sum()
        } else {
            self.ids().count()
        }
    }

    /// The id that is most like this one, as [`nearest`] has it. No check is built.
    #[must_use]
    pub fn nearest(&self, id: &str) -> Option<String> {
        let groups = self.families.iter().flat_map(Family::named);
        nearest(id, groups.flat_map(|group| group.ids().collect::<Vec<_>>()))
    }

    /// The check with this id, even if the plan is restricted.
    #[must_use]
    pub fn find(&self, id: &str) -> Option<Check> {
        let has = |group: &Group<'_>| id.starts_with(&group.stem) && group.ids().any(|it| it == id);
        let mut families = self.families.iter().filter(|it| id.starts_with(&it.prefix));
        let (family, place) =
            families.find_map(|family| Some((family, family.named().position(|it| has(&it))?)))?;
        let group = (family.groups)().nth(place)?;
        (group.build)(&group.stem).into_iter().find(|check| check.id == id)
    }
}

impl<'a> Family<'a> {
    /// A family whose checks' ids begin with `prefix`.
    pub(crate) fn new<I>(
        prefix: impl Into<String>,
        groups: impl Fn() -> I + Send + Sync + 'a,
    ) -> Self
    where
        I: Iterator<Item = Group<'a>> + Send + 'a,
    {
        Self { prefix: prefix.into(), groups: Box::new(move || Box::new(groups())), named: None }
    }

    /// A family of few checks, or of checks that can be made only together.
    pub(crate) fn of(
        prefix: impl Into<String>,
        checks: impl Fn() -> Vec<Check> + Send + Sync + 'a,
    ) -> Self {
        Self::new(prefix, move || by_stem(checks()))
    }

    /// Sets a cheaper way to the ids of the groups.
    pub(crate) fn with_names<I>(mut self, named: impl Fn() -> I + Send + Sync + 'a) -> Self
    where
        I: Iterator<Item = Group<'a>> + Send + 'a,
    {
        self.named = Some(Box::new(move || Box::new(named())));
        self
    }

    fn named(&self) -> Groups<'a> {
        self.named.as_ref().unwrap_or(&self.groups)()
    }
}

/// Groups of checks that are already built; the ids in a group differ only after the last slash.
pub(crate) fn by_stem<'a>(checks: Vec<Check>) -> impl Iterator<Item = Group<'a>> + Send {
    let mut checks = checks.into_iter().peekable();
    std::iter::from_fn(move || {
        let first = checks.next()?;
        let (before, _) = first.id.rsplit_once('/').unwrap_or_default();
        let stem = format!("{before}/");
        let mut group = vec![first];
        while let Some(check) = checks.next_if(|check| check.id.starts_with(&stem)) {
            group.push(check);
        }
        Some(Group::of(stem, group))
    })
}

impl<'a> Group<'a> {
    /// A group whose checks' ids are the stem and each of the names.
    pub(crate) fn new(
        stem: String,
        names: &'static [&'static str],
        build: impl FnOnce(&str) -> Vec<Check> + Send + 'a,
    ) -> Self {
        Self { stem, names: Names::Fixed(names), build: Box::new(build) }
    }

    /// The same with names of its own.
    pub(crate) fn named(
        stem: String,
        names: Vec<String>,
        build: impl FnOnce(&str) -> Vec<Check> + Send + 'a,
    ) -> Self {
        Self { stem, names: Names::Own(names), build: Box::new(build) }
    }

    /// A group of checks that are already built, whose ids begin with the stem.
    pub(crate) fn of(stem: String, checks: Vec<Check>) -> Self {
        let name = |check: &Check| check.id.strip_prefix(&stem).unwrap_or_default().to_owned();
        let names = Names::Own(checks.iter().map(name).collect());
        Self { stem, names, build: Box::new(move |_| checks) }
    }

    fn ids(&self) -> impl Iterator<Item = String> {
        self.names.iter().map(|name| format!("{}{name}", self.stem))
    }

    /// How many checks it has.
    pub(crate) fn size(&self) -> usize {
        match &self.names {
            Names::Fixed(names) => names.len(),
            Names::Own(names) => names.len(),
        }
    }
}
