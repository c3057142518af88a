//! JSON Schemas of the JSON output, derived from the model. `ACCEPT=1 cargo test --workspace
//! --test reports` rewrites the files in `conformance/schema`.

use actucheck_spec::schema::of_written;

use super::compare::Comparison;
use super::jsonl::Line;
use super::model::Report;

/// Each schema's name and text.
#[must_use]
pub fn all() -> [(&'static str, String); 3] {
    [
        ("report", of_written::<Report>()),
        ("line", of_written::<Line>()),
        ("comparison", of_written::<Comparison>()),
    ]
}
