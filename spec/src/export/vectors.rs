//! Every golden packet as one JSON file, for the tests of any implementation.

use schemars::JsonSchema;
use serde::Serialize;

use super::{ExportError, to_json};
use crate::Spec;
use crate::model::{Citation, Fault, HexBytes, Outcome, Vector, VectorsFile};
use crate::wire::{Direction, Packet, Wire};

/// Version of the file's form. It changes when a field goes or takes another meaning.
pub const VERSION: u32 = 1;

/// Golden packets: frames with what an implementation has to make of them. Every field is always
/// there; what a vector does not have is `null` or an empty list.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct VectorsExport<'a> {
    /// Version of the file's form; 1. It changes when a field goes or takes another meaning.
    pub version: u32,
    /// One row a packet.
    pub vectors: Vec<VectorRow<'a>>,
}

/// A golden packet.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct VectorRow<'a> {
    /// Permanent id.
    pub id: &'a str,
    /// Id of the wire.
    pub wire: Wire,
    /// The frame's bytes.
    pub input: HexBytes,
    /// What is to happen to the frame: build it and read it (`valid`), reject it (`invalid`), or
    /// either (`acceptable`).
    pub result: Outcome,
    /// What the frame means; `null` for an invalid one.
    pub expected: Option<&'a Packet>,
    /// For an invalid frame: what is wrong with it.
    pub fault: Option<Fault>,
    /// For an invalid frame of a wire whose frames do not tell which way they go: the way.
    pub direction: Option<Direction>,
    /// Where the bytes come from.
    pub origin: Origin,
    /// For a corrected frame: the bytes as the document prints them.
    pub printed: Option<HexBytes>,
    /// For a corrected frame: what is wrong with the printed bytes. They are to be rejected.
    pub printed_fault: Option<Fault>,
    /// Ids of the errata that it depends on.
    pub errata: &'a [String],
    /// Id of the requirement that it shows, if it is not the document's general one.
    pub requirement: Option<&'a str>,
    /// Title of the document.
    pub document: &'a str,
    /// The section, by its number or its heading.
    pub section: &'a str,
    /// What a reader should know about it.
    pub note: Option<&'a str>,
}

/// Where a vector's bytes come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Origin {
    /// The document prints them.
    Printed,
    /// The document prints others, which an erratum corrects.
    Corrected,
    /// They follow from the document's rules.
    Derived,
}

impl Origin {
    fn of(vector: &Vector) -> Self {
        match (&vector.printed, &vector.bytes) {
            (_, None) => Self::Printed,
            (Some(_), Some(_)) => Self::Corrected,
            (None, Some(_)) => Self::Derived,
        }
    }
}

impl<'a> VectorsExport<'a> {
    /// The export of a spec.
    #[must_use]
    pub fn of(spec: &'a Spec) -> Self {
        let row = |(file, vector): (&'a VectorsFile, &'a Vector)| VectorRow::of(spec, file, vector);
        Self { version: VERSION, vectors: spec.vectors().map(row).collect() }
    }
}

impl<'a> VectorRow<'a> {
    fn of(spec: &'a Spec, file: &'a VectorsFile, vector: &'a Vector) -> Self {
        let Citation { document, section } = vector.source.as_ref().unwrap_or(&file.source);
        Self {
            id: &vector.id,
            wire: file.wire,
            input: vector.frame().to_vec().into(),
            result: vector.result,
            expected: vector.packet.as_ref(),
            fault: vector.fault,
            direction: vector.direction,
            origin: Origin::of(vector),
            printed: vector.defective().map(|bytes| bytes.to_vec().into()),
            printed_fault: vector.printed_fault,
            errata: &vector.errata,
            requirement: vector.requirement.as_deref(),
            document: spec.document(document).map_or(document, |document| &document.title),
            section,
            note: vector.note.as_deref(),
        }
    }
}

/// The whole file.
///
/// # Errors
/// If something can't be written as JSON.
pub fn export(spec: &Spec) -> Result<String, ExportError> {
    to_json(&VectorsExport::of(spec))
}
