//! JSON Schemas, derived from the model: of the YAML files, so that editors complete and check
//! them, and of the exports, for whoever reads those.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;

use crate::export::json::Export;
use crate::export::vectors::VectorsExport;
use crate::model::{
    Device, DocumentsFile, ErrataFile, Innfos, Protocol, RequirementsFile, SentencesFile,
    VectorsFile,
};

/// A schema as a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SchemaFile {
    /// Its path below the spec folder, with forward slashes.
    pub path: String,
    /// Its whole text.
    pub text: String,
}

/// Every schema, in a fixed order.
#[must_use]
pub fn all() -> Vec<SchemaFile> {
    vec![
        source::<DocumentsFile>("documents"),
        source::<Protocol>("protocol"),
        source::<Innfos>("innfos"),
        source::<Device>("device"),
        source::<VectorsFile>("vectors"),
        source::<RequirementsFile>("requirements"),
        source::<ErrataFile>("errata"),
        source::<SentencesFile>("sentences"),
        export::<Export<'_>>("spec"),
        export::<VectorsExport<'_>>("vectors"),
    ]
}

/// The path below the spec folder of the schema that a YAML file has to fit; `path` is below the
/// spec folder too.
#[must_use]
pub fn of_source(path: &str) -> Option<String> {
    let name = match path.split_once('/') {
        None => path.strip_suffix(".yaml")?,
        Some(("protocols", "innfos.yaml")) => "innfos",
        Some(("protocols", _)) => "protocol",
        Some(("devices", _)) => "device",
        Some((folder, _)) => folder,
    };
    Some(file_name(name))
}

fn file_name(name: &str) -> String {
    format!("schema/{name}.schema.json")
}

/// The schema of what is read.
fn source<T: JsonSchema>(name: &str) -> SchemaFile {
    SchemaFile { path: file_name(name), text: text::<T>(SchemaSettings::draft2020_12()) }
}

/// The schema of what is written.
fn export<T: JsonSchema>(name: &str) -> SchemaFile {
    SchemaFile { path: file_name(&format!("export/{name}")), text: of_written::<T>() }
}

/// The text of the schema of what is written: every field is there, if only with `null`.
#[must_use]
pub fn of_written<T: JsonSchema>() -> String {
    text::<T>(SchemaSettings::draft2020_12().for_serialize())
}

fn text<T: JsonSchema>(settings: SchemaSettings) -> String {
    let schema = settings.into_generator().into_root_schema_for::<T>();
    // A schema has string keys only, so it can be written. `{:#}` indents it.
    // The model's documentation links as rustdoc does, which nobody else follows.
    format!("{:#}\n", schema.as_value()).replace("[`", "`").replace("`]", "`")
}
