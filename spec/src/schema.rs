//! JSON Schemas, derived from the model: of the YAML files, so that editors complete and check
//! them, and of the exports, for their readers.

use schemars::generate::SchemaSettings;
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::Value;

use crate::export::json::Export;
use crate::export::vectors::VectorsExport;
use crate::model::{
    Device, DocumentsFile, ErrataFile, RequirementsFile, SentencesFile, VectorsFile,
};
use crate::wire::Wire;

/// A schema file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SchemaFile {
    /// Its path below the spec folder, with forward slashes.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// Every schema, in a fixed order.
#[must_use]
pub fn all() -> Vec<SchemaFile> {
    let wires = Wire::ALL.map(|wire| SchemaFile {
        path: file_name(&format!("wires/{wire}")),
        text: wire.exports().schema(),
    });
    let others = [
        source::<DocumentsFile>("documents"),
        source::<Device>("device"),
        source::<VectorsFile>("vectors"),
        source::<RequirementsFile>("requirements"),
        source::<ErrataFile>("errata"),
        source::<SentencesFile>("sentences"),
        export::<Export<'_>>("spec"),
        export::<VectorsExport<'_>>("vectors"),
    ];
    wires.into_iter().chain(others).collect()
}

/// The path of the schema of a YAML file. Both paths are relative to the spec folder.
#[must_use]
pub fn of_source(path: &str) -> Option<String> {
    let name = match path.split_once('/') {
        None | Some(("wires", _)) => path.strip_suffix(".yaml")?,
        Some(("devices", _)) => "device",
        Some((folder, _)) => folder,
    };
    Some(file_name(name))
}

fn file_name(name: &str) -> String {
    format!("schema/{name}.schema.json")
}

/// The schema of input.
fn source<T: JsonSchema>(name: &str) -> SchemaFile {
    SchemaFile { path: file_name(name), text: of_read::<T>() }
}

/// The schema of output.
fn export<T: JsonSchema>(name: &str) -> SchemaFile {
    SchemaFile { path: file_name(&format!("export/{name}")), text: of_written::<T>() }
}

/// The text of the schema of what is read.
#[must_use]
pub fn of_read<T: JsonSchema>() -> String {
    text::<T>(SchemaSettings::draft2020_12())
}

/// The schemas between which an enum's schema lets choose; else the one that there is.
pub(crate) fn variants<T: JsonSchema>(generator: &mut SchemaGenerator) -> Vec<Value> {
    let mut schema = T::json_schema(generator);
    match schema.remove("oneOf") {
        Some(Value::Array(variants)) => variants,
        _ => vec![schema.into()],
    }
}

/// The text of the schema of output, in which every field is required and may be `null`.
#[must_use]
pub fn of_written<T: JsonSchema>() -> String {
    text::<T>(SchemaSettings::draft2020_12().for_serialize())
}

fn text<T: JsonSchema>(settings: SchemaSettings) -> String {
    let schema = settings.into_generator().into_root_schema_for::<T>();
    // A schema has string keys only, so it can be written; `{:#}` indents it. The model's
    // documentation has rustdoc links, which no other tool follows.
    format!("{:#}\n", schema.as_value()).replace("[`", "`").replace("`]", "`")
}
