//! What a test vector demands.

use actucheck_spec::Spec;
use actucheck_spec::model::{Outcome, Vector};

use crate::adapter::Output;
use crate::suite::check::{Demand, Unspecified, Way};

/// What the vector demands, if `output` is right and each of `others` is right too.
pub(super) fn demand(spec: &Spec, vector: &Vector, output: Output, others: Vec<Way>) -> Demand {
    if vector.result != Outcome::Acceptable {
        return Demand::Yield(output);
    }
    let mut ways = vec![way(vector, output)];
    ways.extend(others);
    Demand::Record(Unspecified { question: question(spec, vector), ways })
}

/// The behaviour that this vector describes.
pub(super) fn way(vector: &Vector, output: Output) -> Way {
    Way { name: format!("as {}", vector.id), output }
}

/// What is unspecified about a vector, from the errata that it depends on.
fn question(spec: &Spec, vector: &Vector) -> String {
    let rows = spec.errata.content.errata.iter().filter(|row| vector.errata.contains(&row.id));
    let readings: Vec<_> = rows.map(|row| format!("{} ({})", row.held_right, row.id)).collect();
    format!("{}: {}", vector.id, readings.join("; "))
}
