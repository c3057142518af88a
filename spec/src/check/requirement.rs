//! A requirement is used: a vector or a test names it, or its row says what else checks it.

use std::collections::BTreeSet;

use crate::model::CheckedBy;
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let named: BTreeSet<_> =
        spec.vectors().filter_map(|(_, vector)| vector.requirement.as_deref()).collect();
    let mut defects = Vec::new();
    for file in &spec.requirements {
        for (index, row) in file.content.requirements.iter().enumerate() {
            let used = named.contains(row.id.as_str()) || !row.tests.is_empty();
            let (node, message) = match row.checked_by {
                None if !used => (
                    "id",
                    "is used nowhere; name it in a vector, or say `checked_by: suite` or \
                     `checked_by: nothing`",
                ),
                Some(CheckedBy::Nothing) if used => {
                    ("checked_by", "is named by a vector or a test; leave `checked_by` out")
                }
                _ => continue,
            };
            let message = format!("{} {message}", row.id);
            defects.push(file.diagnostic(&format!("requirements[{index}].{node}"), message));
        }
    }
    defects
}
