//! Every mutant is found, and every check and every family of checks finds a mutant.

use std::collections::{BTreeMap, BTreeSet};
use std::iter;
use std::sync::LazyLock;

use actucheck::adapter::Wire;
use actucheck::suite::check::Check;
use actucheck::verdict::{Outcome, Verdict};
use actucheck_spec::Spec;
use actucheck_spec::model::Level;

use super::{Mutant, checks, dynamixel2, innfos, stubs};

/// The mutants of a wire that a good check distinguishes from a right implementation.
pub(super) fn mutants(wire: Wire) -> impl Iterator<Item = &'static Mutant> {
    let lists: &'static [&[Mutant]] = match wire.id() {
        "dynamixel2" => &dynamixel2::LISTS,
        "innfos" => &innfos::LISTS,
        _ => &[],
    };
    lists.iter().copied().flatten()
}

/// The checks of a wire, and for each mutant those that find it.
pub(super) struct Matrix {
    wire: Wire,
    pub(super) checks: Vec<Check>,
    pub(super) found: Vec<(&'static Mutant, BTreeSet<usize>)>,
}

pub(super) static MATRICES: LazyLock<Vec<Matrix>> =
    LazyLock::new(|| Wire::ALL.into_iter().map(Matrix::new).collect());

impl Matrix {
    fn new(wire: Wire) -> Self {
        let checks = checks(wire);
        let all = mutants(wire).chain(&stubs::MUTANTS);
        let found = all.map(|mutant| (mutant, finders(mutant, &checks))).collect();
        Self { wire, checks, found }
    }

    fn id(&self, check: usize) -> &str {
        &self.checks[check].id
    }
}

/// The checks that find a mutant. It passes those to which it answers as the built-in codec does,
/// so they need not be asked.
fn finders(mutant: &Mutant, checks: &[Check]) -> BTreeSet<usize> {
    let last = iter::once(None).chain(checks.iter().map(|check| Some(&check.question)));
    let asked = checks.iter().zip(last).enumerate();
    let found = asked.filter(|(_, (check, last))| {
        let answer = mutant.wrong.answer(&check.question, *last);
        answer.is_some_and(|answer| is_found(&(*check).clone().judge(answer)))
    });
    found.map(|(place, _)| place).collect()
}

/// Whether a check reports an error or a warning.
pub(super) fn is_found(outcome: &Outcome) -> bool {
    let warned = outcome.verdict == Verdict::Warn && outcome.level == Level::Should;
    outcome.verdict.is_failure() || warned
}

/// Whether an answer to the check is judged.
fn is_judged(check: &Check) -> bool {
    !check.only_records()
}

/// The op of a check and the words of its id up to the third: `dynamixel2.id.ping`. What tells the
/// checks of a family apart, such as numbers and bytes, is left out. The test vectors are one
/// family, and the basic checks of a wire are.
fn family(check: &Check, vectors: &BTreeSet<&str>) -> (String, &'static str) {
    let (stem, _) = check.id.split_once('/').unwrap_or((&check.id, ""));
    if vectors.contains(stem) {
        return ("test vectors".to_owned(), check.question.name());
    }
    let words = if stem.contains(".basic.") { 2 } else { 3 };
    let is_word = |part: &&str| {
        let is_bytes = part.len() > 1 && part.bytes().all(|byte| byte.is_ascii_hexdigit());
        !is_bytes && !part.starts_with(|first: char| first.is_ascii_digit())
    };
    let words: Vec<_> = stem.split('.').filter(is_word).take(words).collect();
    (words.join("."), check.question.name())
}

#[test]
fn every_mutant_is_found_by_its_check() {
    // The packets of the documents, apart from those derived from their rules.
    let spec = Spec::embedded().unwrap();
    let printed: BTreeSet<_> = spec
        .vectors()
        .filter(|(_, vector)| vector.printed.is_some())
        .map(|(_, vector)| vector.id.as_str())
        .collect();
    let is_printed = |id: &str| id.split_once('/').is_some_and(|(id, _)| printed.contains(id));
    for matrix in MATRICES.iter() {
        let of_wire = matrix.found.iter().filter(|(mutant, _)| !mutant.found_by.is_empty());
        for (mutant, found) in of_wire {
            let failed: BTreeSet<_> = found.iter().map(|check| matrix.id(*check)).collect();
            assert!(failed.contains(mutant.found_by), "{}: {failed:?}", mutant.name);
            let found = failed.iter().any(|id| is_printed(id));
            assert_eq!(found, mutant.found_by_documents, "{}: {failed:?}", mutant.name);
        }
    }
}

#[test]
fn every_check_finds_a_mutant() {
    for matrix in MATRICES.iter() {
        let found: BTreeSet<_> = matrix.found.iter().flat_map(|(_, found)| found).collect();
        let judged = matrix.checks.iter().enumerate().filter(|(_, check)| is_judged(check));
        let idle: BTreeMap<_, _> = judged
            .filter(|(place, _)| !found.contains(place))
            .map(|(_, check)| (&check.id, &check.requirement))
            .collect();
        assert_eq!(idle, BTreeMap::new(), "checks of {} that nothing fails", matrix.wire);
    }
}

/// A trivial implementation fails so much that it shows little: each family finds another one.
#[test]
fn every_family_finds_a_mutant_that_is_not_trivial() {
    let spec = Spec::embedded().unwrap();
    let vectors = spec.vectors().map(|(_, vector)| vector.id.as_str()).collect();
    let family = |check| family(check, &vectors);
    for matrix in MATRICES.iter() {
        let real = matrix.found.iter().filter(|(mutant, _)| !mutant.found_by.is_empty());
        let found: BTreeSet<_> =
            real.flat_map(|(_, found)| found).map(|place| family(&matrix.checks[*place])).collect();
        let judged = matrix.checks.iter().filter(|check| is_judged(check));
        let judged: BTreeSet<_> = judged.map(family).collect();
        let idle: Vec<_> = judged.difference(&found).collect();
        assert!(idle.is_empty(), "families of {} that find nothing: {idle:?}", matrix.wire);
    }
}

#[test]
fn what_a_mutant_breaks_is_a_requirement() {
    let spec = Spec::embedded().unwrap();
    for mutant in Wire::ALL.into_iter().flat_map(mutants) {
        assert!(spec.requirement(mutant.blames).is_some(), "{}: {}", mutant.name, mutant.blames);
    }
}
