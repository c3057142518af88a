//! Exports every test vector as one JSON file, for the tests of any implementation.

use schemars::JsonSchema;
use serde::Serialize;

use super::{ExportError, to_json};
use crate::Spec;
use crate::model::{Citation, Fault, HexBytes, Outcome, Vector, VectorsFile};
use crate::wire::{Direction, Packet, Wire};

/// Version of the file's format. It changes when a field is removed or gets another meaning.
pub const VERSION: u32 = 1;

/// Test vectors: frames, and what an implementation must do with them. Every field is always
/// present; a field that a vector does not have is `null` or an empty list.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct VectorsExport<'a> {
    /// Version of the file's format: 1. It changes when a field is removed or gets another meaning.
    pub version: u32,
    /// One row per packet.
    pub vectors: Vec<VectorRow<'a>>,
}

/// A test vector.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct VectorRow<'a> {
    /// Permanent id.
    pub id: &'a str,
    /// Id of the wire.
    pub wire: Wire,
    /// The frame's bytes.
    pub input: HexBytes,
    /// What an implementation must do with the frame: build it and read it (`valid`), reject it
    /// (`invalid`), or either (`acceptable`).
    pub result: Outcome,
    /// The frame's meaning; `null` for an invalid frame.
    pub expected: Option<&'a Packet>,
    /// For an invalid frame: what is wrong with it.
    pub fault: Option<Fault>,
    /// For an invalid frame of a wire whose frames do not state their direction: the direction.
    pub direction: Option<Direction>,
    /// The origin of the bytes.
    pub origin: Origin,
    /// For a corrected frame: the bytes as the document prints them.
    pub printed: Option<HexBytes>,
    /// For a corrected frame: what is wrong with the printed bytes. They must be rejected.
    pub printed_fault: Option<Fault>,
    /// Ids of the errata that it depends on.
    pub errata: &'a [String],
    /// Id of the requirement that it tests, if it is not the document's general one.
    pub requirement: Option<&'a str>,
    /// Title of the document.
    pub document: &'a str,
    /// The section, by its number or its heading.
    pub section: &'a str,
    /// A note for readers.
    pub note: Option<&'a str>,
}

/// The origin of a vector's bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Origin {
    /// The document prints them.
    Printed,
    /// The document prints other bytes, which an erratum corrects.
    Corrected,
    /// They were derived from the document's rules.
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
