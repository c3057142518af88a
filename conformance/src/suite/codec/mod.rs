//! Checks of a codec, one module per wire.

pub(crate) mod dynamixel2;
pub(super) mod innfos;
mod vector;

use std::borrow::Cow;

use actucheck_spec::wire;

use super::basics::{self, About, Basic};
use super::plan::Family;
use super::{Author, Options};
use crate::adapter::{Output, Question, Wire};

/// The checks of a wire.
struct Checks {
    wire: Wire,
    /// The basic checks, the most basic first.
    basics: fn() -> &'static [Basic],
    /// The ids of the basic checks of values that an answer rests on, the most basic first.
    values: fn(&Question, Option<&Output>) -> Vec<String>,
    /// The families of the other checks.
    families: for<'a> fn(Author<'a>, &Options) -> Vec<Family<'a>>,
}

/// The wires that are checked.
const WIRES: [Checks; 2] = [
    Checks {
        wire: wire::dynamixel2::WIRE,
        basics: dynamixel2::basics::all,
        values: dynamixel2::values::rests_on,
        families: dynamixel2::families,
    },
    Checks {
        wire: wire::innfos::WIRE,
        basics: innfos::basics::all,
        values: innfos::messages::rests_on,
        families: innfos::families,
    },
];

fn of_wire(wire: Wire) -> Option<&'static Checks> {
    WIRES.iter().find(|checks| checks.wire == wire)
}

/// Every check of a codec, in a fixed order: the basic ones first.
pub(super) fn families<'a>(author: Author<'a>, options: &Options) -> Vec<Family<'a>> {
    let Some(checks) = of_wire(author.wire) else { return Vec::new() };
    let mut families = vec![basics::family(author, (checks.basics)())];
    families.extend((checks.families)(author, options));
    families
}

/// The ids of the basic checks that the answer to a question rests on, the most basic first.
/// `expected` is the answer that is demanded, if it is not a rejection.
pub(crate) fn rests_on<'a>(
    question: &'a Question,
    expected: Option<&'a Output>,
) -> impl Iterator<Item = Cow<'static, str>> + use<'a> {
    let checks = of_wire(question.wire());
    let basics = checks.map_or(&[][..], |checks| (checks.basics)());
    let values = checks.map_or_else(Vec::new, |checks| (checks.values)(question, expected));
    let about = About::new(question, expected);
    let concerned = basics.iter().filter(move |basic| (basic.concerns)(&about));
    concerned.map(|basic| basic.id.as_str().into()).chain(values.into_iter().map(Cow::from))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)] // tests may stop at a surprise

    use std::collections::HashSet;

    use actucheck_spec::Spec;

    use super::*;
    use crate::suite::check::Demand;
    use crate::suite::{self, Options};

    #[test]
    fn basic_checks_reject_what_the_reference_model_rejects() {
        let mut rejected = 0;
        for basic in WIRES.iter().flat_map(|checks| (checks.basics)()) {
            if let (Demand::Reject(fault), Question::Decode { wire, bytes, context }) =
                (&basic.demand, &basic.question)
            {
                assert_eq!(wire.decode(bytes, context).err(), Some(*fault), "{}", basic.id);
                rejected += 1;
            }
        }
        assert!(rejected > 10, "{rejected}");
    }

    #[test]
    fn checks_rest_on_checks_of_the_plan() {
        let spec = Spec::embedded().unwrap();
        let options = Options { cases: 20, ..Options::new().with_bodies(2) };
        let plan = suite::plan(&spec, &WIRES.map(|checks| checks.wire), &options);
        let ids: HashSet<String> = plan.ids().collect();
        let mut resting = 0;
        for check in plan.checks() {
            for id in rests_on(&check.question, check.expected()) {
                assert!(ids.contains(&*id), "{} rests on {id}", check.id);
                resting += 1;
            }
        }
        assert!(resting > ids.len(), "{resting}");
    }
}
