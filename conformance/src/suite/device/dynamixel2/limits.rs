//! What a register does not take: values outside its range, and beyond limits that other registers hold.

use actucheck_spec::model::{Access, Area, Bound, Register};

use super::writable::{Writable, bytes, needs, writable};
use super::written::Step;
use super::{Talk, asked, error, named, word, write};
use crate::adapter::{Permission, Permissions};
use crate::suite::check::Check;
use crate::suite::wanted::{Like, Part};

/// Values outside the ranges of registers.
pub(super) fn ranges(talk: &Talk<'_>) -> Vec<Check> {
    writable(talk).into_iter().flat_map(|one| outside(talk, one)).collect()
}

/// The nearest values outside the range of a register.
fn outside(talk: &Talk<'_>, one: Writable<'_>) -> Vec<Check> {
    let Writable { register, min, max } = one;
    let size = register.kind.size();
    let is_limit = register.name.ends_with("Limit");
    let values = [("below", min.checked_sub(1)), ("above", max.checked_add(1))];
    let values = values.into_iter().filter_map(|(name, value)| Some((name, value?)));
    let values = values.filter(|(_, value)| register.kind.holds(*value));
    let check = |(name, value): (&str, i64)| {
        let refused =
            if is_limit { refusals(talk) } else { vec![vec![talk.refusal(error::DATA_RANGE)]] };
        let same = talk.done(Part::Same { step: 0, from: 0, count: size.into() });
        let any = talk.done(Part::Any(size.into()));
        let read = || asked(talk.read(register.address, size), 1);
        let write = write(talk.id(), register.address, &bytes(register, value));
        let steps =
            vec![(read(), vec![vec![any]]), (asked(write, 1), refused), (read(), vec![vec![same]])];
        let id = named(&format!("range.{}/{name}", word(&register.name)));
        talk.demands(needs(talk, register), id, &["status-packet.error.data-range"], steps)
    };
    values.map(check).collect()
}

/// What may answer a value outside the own range of a limit.
pub(super) fn refusals(talk: &Talk<'_>) -> Vec<Vec<Like>> {
    let numbers = [error::DATA_RANGE, error::DATA_LIMIT];
    let count = if has_two_numbers(talk) { 2 } else { 1 };
    numbers.into_iter().take(count).map(|number| vec![talk.refusal(number)]).collect()
}

/// Whether the device's document leaves unspecified which error number refuses a value outside the own range of a
/// limit.
fn has_two_numbers(talk: &Talk<'_>) -> bool {
    let own = talk.document().map(|document| format!("{document}.invalid-value.error"));
    let errata = &talk.author.spec.errata.content.errata;
    own.is_some_and(|id| errata.iter().any(|erratum| erratum.id == id))
}

/// Registers whose range ends at the value of another register that can be set.
pub(super) fn limited(talk: &Talk<'_>) -> Vec<Check> {
    let Some(device) = talk.target.device else { return Vec::new() };
    let limits = writable(talk);
    let mut checks = Vec::new();
    for register in &device.registers {
        let Some(range) = register.range.as_ref().filter(|range| talk.author.spec.settles(range))
        else {
            continue;
        };
        // With other modes the range is another.
        let depends = register.meanings.iter().any(|meaning| meaning.range.is_some());
        let is_profile = register.name.starts_with("Profile ");
        if register.access == Access::R || register.area != Area::Ram || depends && !is_profile {
            continue;
        }
        let Some(Bound::Register(name)) = &range.max else { continue };
        let Some(limit) = limits.iter().find(|limit| limit.register.name == *name) else {
            continue;
        };
        let is_both_ways = range.min == Some(Bound::Register(format!("-{name}")));
        checks.push(at_limit(talk, register, *limit, is_both_ways));
        checks.extend(beyond(talk, register, *limit, is_both_ways));
    }
    checks
}

/// A limit for these checks: something in the middle of what it may be.
const fn middle(limit: Writable<'_>) -> i64 {
    limit.min.midpoint(limit.max)
}

/// What a check needs that sets a limit and what it limits.
fn both(talk: &Talk<'_>, limit: Writable<'_>) -> Permissions {
    let own = needs(talk, limit.register);
    Permission::ALL
        .into_iter()
        .filter(|permission| own.has(*permission) || *permission == Permission::WriteRam)
        .collect()
}

/// What comes before a value at a limit or beyond it.
fn begin(talk: &Talk<'_>, register: &Register, limit: Writable<'_>) -> Vec<Step> {
    let depends = register.meanings.iter().any(|meaning| meaning.range.is_some());
    let given = talk.profile(0).filter(|_| depends);
    let set = talk.sets(limit.register.address, &bytes(limit.register, middle(limit)));
    given.into_iter().chain([set]).collect()
}

/// A value at the limit is taken.
fn at_limit(talk: &Talk<'_>, register: &Register, limit: Writable<'_>, both_ways: bool) -> Check {
    let values = if both_ways { vec![-middle(limit), middle(limit)] } else { vec![middle(limit)] };
    let steps = values.into_iter().flat_map(|value| {
        let data = bytes(register, value);
        [talk.sets(register.address, &data), talk.holds(register.address, data)]
    });
    let id = named(&format!("limit.{}/at", word(&register.name)));
    let steps = begin(talk, register, limit).into_iter().chain(steps).collect();
    talk.demands(both(talk, limit), id, &["write.effect"], steps)
}

/// A value beyond the limit is refused.
fn beyond(
    talk: &Talk<'_>,
    register: &Register,
    limit: Writable<'_>,
    both_ways: bool,
) -> Vec<Check> {
    let above = middle(limit) + 1;
    let values = [("above", above), ("below", -above)];
    let values = values.into_iter().take(if both_ways { 2 } else { 1 });
    let requirements = requirements(&limit.register.name, &register.name);
    let check = |(name, value)| {
        let inside = bytes(register, 0);
        let write = write(talk.id(), register.address, &bytes(register, value));
        let steps = [
            talk.sets(register.address, &inside),
            talk.refused_with(write, error::DATA_LIMIT),
            talk.holds(register.address, inside),
        ];
        let steps = begin(talk, register, limit).into_iter().chain(steps).collect();
        let id = named(&format!("limit.{}/{name}", word(&register.name)));
        talk.demands(both(talk, limit), id, &requirements, steps)
    };
    values.map(check).collect()
}

/// The rows that say so of a limit.
fn requirements(limit: &str, register: &str) -> Vec<String> {
    let limit = word(limit);
    let what = if register.starts_with("Goal ") { "goal" } else { "profile" };
    let rows = [format!("{limit}.{what}"), format!("{limit}.error")];
    rows.into_iter().chain(["status-packet.error.data-limit".to_owned()]).collect()
}
