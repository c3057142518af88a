//! One fault accuses one requirement: the right one comes first, and few others beside it.

use actucheck::run;
use actucheck::suite::check::Check;
use actucheck::suite::plan::Plan;
use actucheck::verdict::Outcome;

use super::killing::MATRICES;
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
    run::outcomes(&mut [Box::new(Mutated::new(mutant))], &Plan::of(asked))
}

/// The requirements that are accused, in the order of the plan, each with the first check that
/// accuses it.
fn accused(outcomes: &[Outcome]) -> Vec<(&str, &str)> {
    let mut accused: Vec<(&str, &str)> = Vec::new();
    for outcome in outcomes.iter().filter(|outcome| outcome.accuses()) {
        if !accused.iter().any(|(requirement, _)| *requirement == outcome.requirement) {
            accused.push((&outcome.requirement, &outcome.id));
        }
    }
    accused
}

#[test]
fn most_faults_accuse_first_the_requirement_that_they_break() {
    let (mut right, mut wrong) = (0, Vec::new());
    for matrix in MATRICES.iter() {
        let named = matrix.found.iter().filter(|(mutant, _)| !mutant.blames.is_empty());
        for (mutant, finders) in named {
            let finders: Vec<_> = finders.iter().copied().collect();
            let outcomes = outcomes(mutant, &matrix.checks, &finders);
            let accused = accused(&outcomes);
            let first = accused.first().map(|(requirement, _)| *requirement);
            if first == Some(mutant.blames) && accused.len() <= MOST {
                right += 1;
            } else {
                let (name, blames) = (mutant.name, mutant.blames);
                wrong.push(format!("{name}: should accuse {blames}, accuses {accused:#?}"));
            }
        }
    }
    let few = wrong.len() < right;
    assert!(few, "{right} are right, these are not:\n{}", wrong.join("\n"));
}
