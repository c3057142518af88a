//! Each fault accuses first the requirement that it breaks, and few others beside it.

use std::collections::BTreeSet;
use std::sync::atomic::AtomicBool;

use actucheck::run;
use actucheck::suite::check::Check;
use actucheck::suite::plan::Plan;
use actucheck::verdict::Outcome;

use super::killing::{MATRICES, is_found};
use super::{Mutant, Mutated, Wrong};

/// How many requirements a fault may accuse.
const MOST: usize = 3;

/// The outcomes of the checks that find a mutant; those that do not accuse nothing. A mutant whose
/// answers depend on the last question is asked everything.
fn outcomes(mutant: &'static Mutant, checks: &[Check], finders: &[usize]) -> Vec<Outcome> {
    let asked = match mutant.wrong {
        Wrong::RejectsAfter(_) => checks.to_vec(),
        _ => finders.iter().map(|place| checks[*place].clone()).collect(),
    };
    run::outcomes(&mut [Box::new(Mutated::new(mutant))], &Plan::of(asked), &AtomicBool::new(false))
}

/// The requirements that are accused, in the order of the plan, each with the first check that
/// accuses it.
fn accused(outcomes: &[Outcome]) -> Vec<(&str, &str)> {
    let mut accused: Vec<(&str, &str)> = Vec::new();
    let wrong = |outcome: &&Outcome| is_found(outcome) && outcome.because.is_none();
    for outcome in outcomes.iter().filter(wrong) {
        if !accused.iter().any(|(requirement, _)| *requirement == outcome.requirement) {
            accused.push((&outcome.requirement, &outcome.id));
        }
    }
    accused
}

/// How many sentences are accused. The documents of several devices have the same one:
/// `ja40.table.units` and `ja-variant.table.units` are one sentence.
fn sentences(accused: &[(&str, &str)]) -> usize {
    let sentences = accused.iter().filter_map(|(requirement, _)| requirement.split_once('.'));
    sentences.map(|(_, sentence)| sentence).collect::<BTreeSet<_>>().len()
}

#[test]
fn each_fault_accuses_first_the_requirement_that_it_breaks() {
    let mut wrong = Vec::new();
    for matrix in MATRICES.iter() {
        let named = matrix.found.iter().filter(|(mutant, _)| !mutant.blames.is_empty());
        for (mutant, finders) in named {
            let finders: Vec<_> = finders.iter().copied().collect();
            let outcomes = outcomes(mutant, &matrix.checks, &finders);
            let accused = accused(&outcomes);
            let first = accused.first().map(|(requirement, _)| *requirement);
            if first != Some(mutant.blames) || sentences(&accused) > MOST {
                let (name, blames) = (mutant.name, mutant.blames);
                wrong.push(format!("{name}: should accuse {blames}, accuses {accused:#?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
