//! What checks each requirement.

use std::collections::BTreeMap;

use crate::Spec;
use crate::model::{Level, Requirement, Role};

/// A check of the suite, with the facts that coverage needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CheckName<'a> {
    /// Its permanent id.
    pub id: &'a str,
    /// Id of the requirement that it tests.
    pub requirement: &'a str,
    /// The role that is asked.
    pub role: Role,
    /// Whether it only records the answer.
    pub only_records: bool,
}

/// A requirement and what checks it.
#[derive(Clone, Debug)]
pub struct Row<'a> {
    /// The requirement.
    pub requirement: &'a Requirement,
    /// The suite's checks by the role that they ask: those that name it, or if there are none those that
    /// name the requirement that it is checked with.
    pub checks: BTreeMap<Role, Checks>,
}

/// The suite's checks of one requirement.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checks {
    /// How many.
    pub count: usize,
    /// How many of them only record the answer.
    pub recorded: usize,
    /// Id of the first of them, one that judges the answer if there is any.
    pub example: String,
}

/// What checks a requirement for one of the roles that it binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Cover {
    /// Nothing yet.
    Nothing,
    /// Nothing can: packets don't show whether the role obeys.
    Unseen,
    /// Checks of the suite that record the answer and judge none.
    Record,
    /// A test of this repository, which tests only the built-in codec or the virtual device.
    Test,
    /// A check of the suite that judges the answer, which any subject can be asked.
    Check,
}

impl Checks {
    /// Whether none of them judges an answer.
    #[must_use]
    pub const fn only_record(&self) -> bool {
        self.recorded == self.count
    }
}

impl Row<'_> {
    /// What checks it for this role; nothing for a role that it does not bind. A check that asks a
    /// codec shows nothing about a device.
    #[must_use]
    pub fn cover(&self, role: Role) -> Cover {
        // A reason is about any device, a test about the virtual one.
        let is_unseen = self.requirement.unseen.by(role).is_some();
        match self.checks.get(&role) {
            _ if !self.requirement.binds.contains(&role) => Cover::Nothing,
            Some(checks) if !checks.only_record() => Cover::Check,
            _ if is_unseen => Cover::Unseen,
            _ if self.requirement.is_tested(role) => Cover::Test,
            Some(_) => Cover::Record,
            None => Cover::Nothing,
        }
    }

    /// Whether nothing checks it for any of the roles that it binds.
    #[must_use]
    pub fn is_uncovered(&self) -> bool {
        Role::ALL.into_iter().all(|role| self.cover(role) == Cover::Nothing)
    }
}

/// One row per requirement, in the order of files and of rows.
#[must_use]
pub fn matrix<'a, 'b>(
    spec: &'a Spec,
    checks: impl IntoIterator<Item = CheckName<'b>>,
) -> Vec<Row<'a>> {
    let mut by_requirement: BTreeMap<&str, BTreeMap<Role, Checks>> = BTreeMap::new();
    for check in checks {
        let roles = by_requirement.entry(check.requirement).or_default();
        let none = || Checks { count: 0, recorded: 0, example: check.id.to_owned() };
        let checks = roles.entry(check.role).or_insert_with(none);
        if checks.only_record() && !check.only_records {
            check.id.clone_into(&mut checks.example);
        }
        checks.count += 1;
        checks.recorded += usize::from(check.only_records);
    }
    spec.requirements
        .iter()
        .flat_map(|file| &file.content.requirements)
        .map(|requirement| {
            let of = |id| by_requirement.get(id).cloned().unwrap_or_default();
            let mut checks = requirement.checked_with.as_deref().map(of).unwrap_or_default();
            checks.extend(of(requirement.id.as_str()));
            Row { requirement, checks }
        })
        .collect()
}

/// How many requirements of one level bind one role, and how many are checked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Total {
    /// All of them.
    pub requirements: usize,
    /// Requirements with a check of the suite that judges.
    pub checked: usize,
    /// Requirements with only checks that record.
    pub recorded: usize,
    /// Requirements with only a test of this repository.
    pub tested: usize,
    /// Requirements that packets can't show.
    pub unseen: usize,
}

impl Total {
    /// Requirements that nothing checks.
    #[must_use]
    pub const fn unchecked(&self) -> usize {
        self.requirements - self.checked - self.recorded - self.tested - self.unseen
    }
}

/// Counts what checks the requirements of a level that bind a role. A requirement that binds two
/// roles counts for both.
#[must_use]
pub fn total(rows: &[Row<'_>], role: Role, level: Level) -> Total {
    let mut total = Total::default();
    let bound = rows
        .iter()
        .filter(|row| row.requirement.level == level && row.requirement.binds.contains(&role));
    for row in bound {
        total.requirements += 1;
        match row.cover(role) {
            Cover::Check => total.checked += 1,
            Cover::Record => total.recorded += 1,
            Cover::Test => total.tested += 1,
            Cover::Unseen => total.unseen += 1,
            Cover::Nothing => {}
        }
    }
    total
}
