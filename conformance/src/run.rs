//! Asks an implementation every check, and keeps what was found whatever happens.

use std::collections::BTreeSet;

use actucheck_spec::model::Level;

use crate::check::Check;
use crate::protocol::{Hello, Op};
use crate::testee::{Answer, Testee};
use crate::verdict::{Outcome, Verdict};

/// Asks all `checks`, one after the other; `done` hears of each. An adapter that answers an op
/// that does not exist is shown as a fault before all else.
pub fn run(
    testee: &mut dyn Testee,
    checks: &[Check],
    mut done: impl FnMut(&Outcome),
) -> Vec<Outcome> {
    let mut outcomes = Vec::with_capacity(checks.len() + 1);
    outcomes.extend(invented_op(testee));
    let mut skipped = BTreeSet::new();
    for check in checks {
        let presumed = check.presumes.as_ref().filter(|id| skipped.contains(id.as_str()));
        let answer = match (presumed, not_offered(testee.hello(), check)) {
            (Some(id), _) => Answer::Skipped(format!("{id} is skipped too")),
            (None, Some(reason)) => Answer::Skipped(reason),
            (None, None) => testee.ask(&check.op),
        };
        let outcome = check.judge(answer);
        if outcome.verdict == Verdict::Skip {
            skipped.insert(check.id.as_str());
        }
        done(&outcome);
        outcomes.push(outcome);
    }
    outcomes
}

/// What a good adapter skips, so that it can skip what a later suite asks.
fn invented_op(testee: &mut dyn Testee) -> Option<Outcome> {
    let (verdict, detail) = match testee.ask(&Op::Invented) {
        Answer::Skipped(_) => return None,
        Answer::TimedOut(detail) => (Verdict::Timeout, detail),
        Answer::Crashed(detail) => (Verdict::Crash, detail),
        Answer::Ok(_) | Answer::Rejected(_) | Answer::Faulty(_) | Answer::NotAsked(_) => {
            (Verdict::AdapterFault, String::new())
        }
    };
    let rule = "an op that the adapter does not know must be answered with `skip`";
    let detail = if detail.is_empty() { rule.to_owned() } else { format!("{rule}: {detail}") };
    Some(Outcome {
        id: "adapter.unknown-op".to_owned(),
        requirement: "adapter.unknown-op".to_owned(),
        level: Level::Must,
        verdict,
        detail,
        request: Some(Op::Invented),
        expected: None,
        actual: None,
        behaviour: None,
    })
}

/// Why a check is not even asked, by the adapter's own word.
fn not_offered(hello: &Hello, check: &Check) -> Option<String> {
    let name = check.op.name();
    if !hello.ops.iter().any(|op| op == name) {
        return Some(format!("the adapter offers no {name}"));
    }
    if let Some(wire) = check.op.wire()
        && !hello.wires.iter().any(|offered| offered == wire.id())
    {
        return Some(format!("the adapter offers no {}", wire.id()));
    }
    let (limit, size) = (hello.limits.max_packet?, check.packet_size()?);
    (size > limit).then(|| format!("{size} bytes, the adapter's limit is {limit}"))
}
