//! Rule: something depends on each erratum. A requirement with an open erratum binds nobody, and a
//! chosen reading has a requirement.

use std::collections::BTreeSet;

use crate::model::{Level, Status};
use crate::rests::{self, Rests};
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let rests = rests::all(spec);
    let named: BTreeSet<_> = rests.iter().map(|(id, _)| *id).collect();
    let stated: BTreeSet<_> = rests
        .iter()
        .filter(|(_, what)| matches!(what, Rests::Requirement(_)))
        .map(|(id, _)| *id)
        .collect();
    let mut defects = Vec::new();
    for (index, row) in spec.errata.content.errata.iter().enumerate() {
        let id = row.id.as_str();
        let message = if !named.contains(id) {
            "nothing rests on it; name it where it bites"
        } else if row.status == Status::Chosen && !stated.contains(id) {
            "it was chosen, but no requirement that names it states what"
        } else {
            continue;
        };
        let node = format!("errata[{index}].id");
        defects.push(spec.errata.diagnostic(&node, format!("{id}: {message}")));
    }
    defects.extend(binding(spec));
    defects
}

/// Requirements that bind although an erratum leaves their text unspecified.
fn binding(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for file in &spec.requirements {
        for (index, row) in file.content.requirements.iter().enumerate() {
            for (place, id) in row.errata.iter().enumerate() {
                let node = format!("requirements[{index}].errata[{place}]");
                let message = match spec.erratum(id).map(|erratum| erratum.status) {
                    None => format!("unknown erratum `{id}`"),
                    Some(Status::Open) if row.level == Level::Must => {
                        format!("{} is `must`, but rests on {id}, which is open", row.id)
                    }
                    Some(_) => continue,
                };
                defects.push(file.diagnostic(&node, message));
            }
        }
    }
    defects
}
