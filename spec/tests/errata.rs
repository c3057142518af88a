//! The documents, the YAML and the errata agree as far as arithmetic can show: every defect that a
//! test finds has an erratum with a `proof`, and a test still finds every defect with a `proof`.
//!
//! The tests that read the documents need their folder; without it they print a note and pass.

#![allow(
    clippy::expect_used,
    clippy::unwrap_used,
    reason = "a test may stop at the first surprise"
)]

mod support;

use std::collections::{BTreeMap, BTreeSet};

use actucheck_spec::Spec;
use actucheck_spec::model::{Device, Erratum, HexBytes, ProofKind};
use actucheck_spec::wire::dynamixel2::{Dynamixel2, WIRE};

use support::document::{self, Document};
use support::{Finding, numbers, packets, ranges, references, rows};

/// The wire of the documents whose examples are tables.
/// Those documents, and the device that each is about.
const DOCUMENTS: [(&str, &str); 3] =
    [("ja40", "ja40"), ("ja-variant", "ja-variant"), ("dynamixel2", "xm430-w210")];

fn spec() -> Spec {
    Spec::embedded().expect("the spec is free of defects")
}

fn wire(spec: &Spec) -> &Dynamixel2 {
    &spec.wires.dynamixel2.content
}

/// Each document with its device; empty if the documents are not available.
fn documents(spec: &Spec) -> Vec<(Document, &Device)> {
    let Some(documents) = document::read(spec, &DOCUMENTS.map(|(id, _)| id)) else {
        return Vec::new();
    };
    let devices = DOCUMENTS.map(|(_, id)| spec.device(id).unwrap());
    documents.into_iter().zip(devices).collect()
}

fn errata(spec: &Spec, kind: ProofKind) -> impl Iterator<Item = &Erratum> {
    let errata = &spec.errata.content.errata;
    errata.iter().filter(move |row| row.proof.as_ref().is_some_and(|proof| proof.kind == kind))
}

fn assert_none(faults: &[String]) {
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

/// Ids of the errata of one kind that `named` holds.
fn named<'a>(
    spec: &Spec,
    kind: ProofKind,
    named: impl IntoIterator<Item = &'a String>,
) -> Vec<&'a String> {
    named.into_iter().filter(|id| errata(spec, kind).any(|row| row.id == **id)).collect()
}

#[test]
fn defective_vectors_and_errata_about_packets_name_each_other() {
    let spec = spec();
    let mut faults = Vec::new();
    let mut used = BTreeSet::new();
    for (file, vector) in spec.vectors().filter(|(file, _)| file.wire == WIRE) {
        let Some(printed) = &vector.printed else {
            continue;
        };
        let ids = named(&spec, ProofKind::Packet, &vector.errata);
        match (packets::is_intact(wire(&spec), printed), ids.is_empty()) {
            (false, true) => faults.push(format!(
                "{} of {}: the printed bytes are wrong; name an erratum with proof kind packet",
                vector.id, file.source
            )),
            (true, false) => faults
                .push(format!("{}: the printed bytes are right, yet it names {ids:?}", vector.id)),
            _ => used.extend(ids),
        }
    }
    let unused = errata(&spec, ProofKind::Packet).filter(|row| !used.contains(&row.id));
    faults.extend(unused.map(|row| format!("{}: no defective vector names it", row.id)));
    assert_none(&faults);
}

#[test]
fn ranges_that_do_not_fit_and_errata_about_them_name_each_other() {
    let spec = spec();
    let mut faults = Vec::new();
    let mut used = BTreeSet::new();
    let registers = spec.devices.iter().flat_map(|file| &file.content.registers);
    for register in registers {
        let Some(defect) = ranges::defect(register) else {
            continue;
        };
        let ids = named(&spec, ProofKind::Range, register.all_errata());
        if ids.is_empty() {
            faults.push(format!("{}: {defect}; no erratum says so", register.name));
        }
        used.extend(ids);
    }
    let unused = errata(&spec, ProofKind::Range).filter(|row| !used.contains(&row.id));
    faults.extend(unused.map(|row| format!("{}: no register shows it", row.id)));
    assert_none(&faults);
}

#[test]
fn every_example_packet_is_a_vector_and_every_printed_vector_an_example() {
    let spec = spec();
    let mut faults = Vec::new();
    for (document, _) in documents(&spec) {
        let mut vectors: Vec<_> = spec
            .vectors()
            .filter_map(|(file, vector)| {
                let source = vector.source.as_ref().unwrap_or(&file.source);
                let printed = vector.printed.as_ref()?;
                (source.document == document.id).then_some((source, &vector.id, printed))
            })
            .collect();
        let examples = packets::examples(wire(&spec), &document);
        println!("{}: {} example packets", document.id, examples.len());
        for example in examples {
            let found = vectors.iter().position(|(source, _, printed)| {
                ***printed == example.bytes && example.line.is_under(&source.section)
            });
            match found {
                Some(index) => drop(vectors.remove(index)),
                None => faults.push(format!(
                    "{} line {}: {} is no vector",
                    document.id,
                    example.line.number,
                    HexBytes(example.bytes)
                )),
            }
        }
        faults
            .extend(vectors.iter().map(|(source, id, _)| format!("{id}: not printed in {source}")));
    }
    assert_none(&faults);
}

#[test]
fn the_printed_table_is_that_of_the_crc() {
    let spec = spec();
    let documents = documents(&spec);
    let Some((document, _)) = documents.iter().find(|(document, _)| document.id == "ja40") else {
        return;
    };
    let printed: Vec<_> = document
        .lines
        .iter()
        .filter(|line| line.is_under("1.4.7"))
        .map(|line| line.text.trim())
        .filter(|text| text.starts_with("0x"))
        .flat_map(|text| text.split(','))
        .filter_map(|entry| u16::from_str_radix(entry.trim().strip_prefix("0x")?, 16).ok())
        .collect();
    let right: Vec<_> = (0..=u8::MAX).map(|byte| wire(&spec).crc.compute(&[byte])).collect();
    assert_eq!(printed, right);
}

#[test]
fn every_register_is_a_row_of_its_document() {
    let spec = spec();
    let mut faults = Vec::new();
    for (document, device) in documents(&spec) {
        let rows = rows::rows(&document);
        let missing = device
            .registers
            .iter()
            .filter(|register| rows.iter().all(|row| row.address != register.address));
        // The DYNAMIXEL document has no control table.
        if !rows.is_empty() {
            faults.extend(missing.map(|row| format!("{}: no row for {}", document.id, row.name)));
        }
        println!("{}: {} rows of control tables", document.id, rows.len());
    }
    assert_none(&faults);
}

#[test]
fn every_defect_found_is_an_erratum_and_every_erratum_with_a_proof_is_found() {
    let spec = spec();
    let mut faults = Vec::new();
    let mut registered = BTreeMap::new();
    for row in &spec.errata.content.errata {
        let Some(proof) = &row.proof else { continue };
        for line in &proof.lines {
            let key = (row.source.document.as_str(), *line, proof.kind);
            if let Some(other) = registered.insert(key, &row.id) {
                faults.push(format!("{} and {other} claim line {line}", row.id));
            }
        }
    }
    for (document, device) in documents(&spec) {
        let mut stale = registered.clone();
        stale.retain(|(id, ..), _| *id == document.id);
        for finding in findings(&spec, &document, device) {
            let key = (document.id.as_str(), finding.line, finding.kind);
            match registered.get(&key) {
                None => faults.push(format!("{finding} ({:?}); no erratum", finding.kind)),
                Some(id) => {
                    stale.remove(&key);
                    faults.extend(unnamed(&document, device, &finding, id));
                }
            }
        }
        faults.extend(
            stale
                .iter()
                .map(|((_, line, kind), id)| format!("{id}: no {kind:?} defect on line {line}")),
        );
    }
    assert_none(&faults);
}

fn findings(spec: &Spec, document: &Document, device: &Device) -> Vec<Finding> {
    let mut all = packets::findings(wire(spec), document);
    all.extend(numbers::findings(document));
    all.extend(references::findings(device, document));
    all.extend(rows::findings(device, document));
    all
}

/// A register whose row the document prints otherwise names the erratum that says so.
fn unnamed(document: &Document, device: &Device, finding: &Finding, id: &String) -> Option<String> {
    let rows = rows::rows(document);
    let row = rows
        .iter()
        .find(|row| finding.kind == ProofKind::Row && row.line.number == finding.line)?;
    let register = device.registers.iter().find(|r| r.address == row.address)?;
    (!register.all_errata().any(|named| named == id))
        .then(|| format!("{} does not name {id}", register.name))
}
