//! Rule: names, addresses, codes and ids are unique.

use std::collections::BTreeMap;
use std::fmt::Display;

use crate::load::File;
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    let documents = &spec.documents.content.documents;
    defects.extend(repeated([(&spec.documents, documents.as_slice())], "documents", "id", |row| {
        &row.id
    }));
    for file in &spec.devices {
        let rows = file.content.registers.as_slice();
        defects.extend(repeated([(file, rows)], "registers", "name", |row| &row.name));
        defects.extend(repeated([(file, rows)], "registers", "address", |row| row.address));
    }
    let vectors = spec.vectors.iter().map(|file| (file, file.content.vectors.as_slice()));
    defects.extend(repeated(vectors, "vectors", "id", |row| &row.id));
    let requirements =
        spec.requirements.iter().map(|file| (file, file.content.requirements.as_slice()));
    defects.extend(repeated(requirements, "requirements", "id", |row| &row.id));
    let errata = spec.errata.content.errata.as_slice();
    defects.extend(repeated([(&spec.errata, errata)], "errata", "id", |row| &row.id));
    defects
}

/// A defect for each row that has the key of an earlier row in any of the files.
pub(crate) fn repeated<'a, T: 'a, R: 'a, K: Ord + Display>(
    files: impl IntoIterator<Item = (&'a File<T>, &'a [R])>,
    list: &str,
    field: &str,
    key: impl Fn(&'a R) -> K,
) -> Vec<Diagnostic> {
    let mut seen = BTreeMap::new();
    let mut defects = Vec::new();
    for (file, rows) in files {
        for (index, row) in rows.iter().enumerate() {
            let key = key(row);
            if let Some(earlier) = seen.get(&key) {
                let message = format!("{field} {key} already belongs to {earlier}");
                defects.push(file.diagnostic(&format!("{list}[{index}].{field}"), message));
            } else {
                seen.insert(key, format!("row {} in {}", index + 1, file.path()));
            }
        }
    }
    defects
}
