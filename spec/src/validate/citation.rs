//! Rule: every citation names an existing document.

use super::sentence;
use crate::model::Citation;
use crate::wire::Wire;
use crate::{Diagnostic, Spec};

pub(super) fn check(spec: &Spec) -> Vec<Diagnostic> {
    let mut defects = Vec::new();
    for wire in Wire::ALL {
        for part in wire.cited(spec) {
            let node = format!("{}.source", part.node);
            let wrong = wrong(spec, part.source);
            defects.extend(wrong.map(|message| wire.diagnostic(spec, &node, message)));
        }
    }
    for file in &spec.devices {
        let device = &file.content;
        defects
            .extend(wrong(spec, &device.source).map(|message| file.diagnostic("source", message)));
        for (index, row) in device.registers.iter().enumerate() {
            let node = format!("registers[{index}].source");
            defects.extend(wrong(spec, &row.source).map(|message| file.diagnostic(&node, message)));
        }
    }
    for file in &spec.vectors {
        let list = &file.content;
        defects.extend(unknown(spec, &list.source).map(|text| file.diagnostic("source", text)));
        for (index, row) in list.vectors.iter().enumerate() {
            let cited = row.source.as_ref().and_then(|source| unknown(spec, source));
            let node = format!("vectors[{index}].source");
            defects.extend(cited.map(|message| file.diagnostic(&node, message)));
        }
    }
    for file in &spec.requirements {
        for (index, row) in file.content.requirements.iter().enumerate() {
            let node = format!("requirements[{index}].source");
            defects
                .extend(unknown(spec, &row.source).map(|message| file.diagnostic(&node, message)));
        }
    }
    for (index, row) in spec.errata.content.errata.iter().enumerate() {
        let node = format!("errata[{index}].source");
        defects.extend(
            unknown(spec, &row.source).map(|message| spec.errata.diagnostic(&node, message)),
        );
    }
    defects
}

fn wrong(spec: &Spec, sources: &[Citation]) -> impl Iterator<Item = String> {
    let missing = sources
        .is_empty()
        .then(|| "no citation; name the document and section as `DOCUMENT §SECTION`".to_owned());
    missing.into_iter().chain(sources.iter().filter_map(|source| unknown(spec, source)))
}

fn unknown(spec: &Spec, source: &Citation) -> Option<String> {
    let known = spec.document(&source.document).is_some();
    if known && !sentence::is_section(spec, source) {
        return Some(format!(
            "`{}` has no section `{}`; spec/sentences lists them",
            source.document, source.section
        ));
    }
    (!known).then(|| {
        let ids: Vec<_> =
            spec.documents.content.documents.iter().map(|row| row.id.as_str()).collect();
        format!("unknown document `{}`; documents.yaml has {}", source.document, ids.join(", "))
    })
}
