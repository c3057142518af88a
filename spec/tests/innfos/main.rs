//! What arithmetic can prove about the INNFOS files: from the YAML alone, and against the document
//! if it is available.

#![allow(
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test may stop at the first surprise, in its helpers too"
)]

mod document;
mod meaning;
mod numbers;
mod rules;
mod tables;
mod vectors;

use actucheck_spec::Spec;
use actucheck_spec::model::Vector;
use actucheck_spec::wire::innfos;

fn spec() -> Spec {
    Spec::embedded().expect("the spec folder has defects")
}

/// The vectors of the wire.
fn vectors(spec: &Spec) -> impl Iterator<Item = &Vector> {
    spec.vectors().filter(|(file, _)| file.wire == innfos::WIRE).map(|(_, vector)| vector)
}
