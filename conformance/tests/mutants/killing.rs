//! Every mutant is found, and every check finds a mutant.

use std::collections::{BTreeMap, BTreeSet};

use actucheck::adapter::Wire;
use actucheck::subject::Builtin;
use actucheck::verdict::{Outcome, Verdict};
use actucheck_spec::Spec;
use actucheck_spec::model::Level;

use super::{Mutant, Mutated, checks, dynamixel2, innfos, outcomes, stubs};

/// The mutants of a wire that a good check distinguishes from a right implementation.
fn mutants(wire: Wire) -> impl Iterator<Item = &'static Mutant> {
    let lists: &'static [&[Mutant]] = match wire.id() {
        "dynamixel2" => &dynamixel2::LISTS,
        "innfos" => &innfos::LISTS,
        _ => &[],
    };
    lists.iter().copied().flatten()
}

/// Whether a check reports an error or a warning.
fn is_found(outcome: &Outcome) -> bool {
    let warned = outcome.verdict == Verdict::Warn && outcome.level == Level::Should;
    outcome.verdict.is_failure() || warned
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
    for wire in Wire::ALL {
        let checks = checks(wire);
        for mutant in mutants(wire) {
            let outcomes = outcomes(Mutated::new(mutant), &checks);
            let failed: BTreeSet<_> = outcomes
                .iter()
                .filter(|outcome| is_found(outcome))
                .map(|outcome| outcome.id.as_str())
                .collect();
            assert!(failed.contains(mutant.found_by), "{}: {failed:?}", mutant.name);
            let found = failed.iter().any(|id| is_printed(id));
            assert_eq!(found, mutant.found_by_documents, "{}: {failed:?}", mutant.name);
        }
    }
}

#[test]
fn every_check_finds_a_mutant() {
    for wire in Wire::ALL {
        let checks = checks(wire);
        let sound = outcomes(Builtin::default(), &checks);
        let judged = sound.iter().filter(|outcome| outcome.verdict == Verdict::Pass);
        let mut idle: BTreeMap<_, _> =
            judged.map(|outcome| (outcome.id.as_str(), &outcome.requirement)).collect();
        for mutant in mutants(wire).chain(&stubs::MUTANTS) {
            for outcome in outcomes(Mutated::new(mutant), &checks) {
                if is_found(&outcome) {
                    idle.remove(outcome.id.as_str());
                }
            }
        }
        assert_eq!(idle, BTreeMap::new(), "checks that nothing fails");
    }
}

#[test]
fn what_a_mutant_breaks_is_a_requirement() {
    let spec = Spec::embedded().unwrap();
    for mutant in Wire::ALL.into_iter().flat_map(mutants) {
        assert!(spec.requirement(mutant.blames).is_some(), "{}: {}", mutant.name, mutant.blames);
    }
}
