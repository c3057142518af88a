//! Rule: a vector or a test names each requirement, or its row says what else checks it. A
//! requirement that is checked with another one is not stricter than that one, and binds no role
//! that the other does not bind. A reason why packets can't show what a role does is given only where
//! the role is bound and no conversation shows it.

use std::collections::BTreeSet;

use crate::model::{CheckedBy, Requirement, Role};
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let named: BTreeSet<_> =
        spec.vectors().filter_map(|(_, vector)| vector.requirement.as_deref()).collect();
    let mut defects = Vec::new();
    for file in &spec.requirements {
        for (index, row) in file.content.requirements.iter().enumerate() {
            if let Some(other) = &row.checked_with
                && let Some(message) = not_with(spec, row, other)
            {
                let node = format!("requirements[{index}].checked_with");
                defects.push(file.diagnostic(&node, format!("{} {message}", row.id)));
            }
            let needless =
                |role: &Role| row.unseen.by(*role).is_some() && !row.binds.contains(role);
            for role in Role::ALL.into_iter().filter(needless) {
                let node = format!("requirements[{index}].unseen.{role}");
                let message = format!("{} binds no {role}; leave `unseen` out", row.id);
                defects.push(file.diagnostic(&node, message));
            }
            let used = named.contains(row.id.as_str())
                || !row.tests.is_empty()
                || row.checked_with.is_some();
            let (node, message) = match row.checked_by {
                None if !used => (
                    "id",
                    "is used nowhere; name it in a vector, or say `checked_by: suite`, \
                     `checked_by: nothing` or `checked_with: ID`",
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

/// Why a requirement can't be checked with another requirement.
fn not_with(spec: &Spec, row: &Requirement, other: &str) -> Option<String> {
    let Some(with) = spec.requirement(other) else {
        return Some(format!("is checked with `{other}`, which is no requirement"));
    };
    if with.checked_with.is_some() {
        return Some(format!("is checked with {other}, which is checked with another one itself"));
    }
    if with.level > row.level || !row.binds.iter().all(|role| with.binds.contains(role)) {
        return Some(format!("is checked with {other}, which binds less or fewer"));
    }
    None
}
