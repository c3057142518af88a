//! Documents, wires, devices, requirements and errata as one JSON file. Every field is always
//! present; a fact that the documents do not state is `null` or an empty list.

use schemars::JsonSchema;
use serde::Serialize;

use super::{ExportError, to_json};
use crate::Spec;
use crate::model::{Device, Document, Erratum, Requirement};
use crate::wire::Wires;

/// Version of the file's format. It changes when a field is removed or gets another meaning.
pub const VERSION: u32 = 4;

/// What `actucheck spec export json` writes.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Export<'a> {
    /// Version of the file's form, now 4. It changes when a field goes or takes another meaning.
    pub version: u32,
    /// The documents that citations point to.
    pub documents: Vec<&'a Document>,
    /// The wires, each under its id.
    pub wires: &'a Wires,
    /// The control tables.
    pub devices: Vec<&'a Device>,
    /// What the documents demand, and the errata that each demand rests on.
    pub requirements: Vec<&'a Requirement>,
    /// The documents' defects.
    pub errata: Vec<&'a Erratum>,
}

impl<'a> Export<'a> {
    /// The export of a spec.
    #[must_use]
    pub fn of(spec: &'a Spec) -> Self {
        Self {
            version: VERSION,
            documents: spec.documents.content.documents.iter().collect(),
            wires: &spec.wires,
            devices: spec.devices.iter().map(|file| &file.content).collect(),
            requirements: spec
                .requirements
                .iter()
                .flat_map(|file| &file.content.requirements)
                .collect(),
            errata: spec.errata.content.errata.iter().collect(),
        }
    }
}

/// The whole file.
///
/// # Errors
/// If something can't be written as JSON.
pub fn export(spec: &Spec) -> Result<String, ExportError> {
    to_json(&Export::of(spec))
}
