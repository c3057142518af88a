use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `documents.yaml`.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DocumentsFile {
    /// One row a document.
    pub documents: Vec<Document>,
}

/// A document that the spec was taken from.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// What citations call it.
    pub id: String,
    /// Its title in English.
    pub title: String,
    /// The language that it is written in.
    pub language: String,
    /// Name of the file that it was read from.
    pub file: String,
}

impl Document {
    /// One of which nothing is known but what citations call it.
    #[must_use]
    pub(crate) fn own(id: &str) -> Self {
        Self {
            id: id.to_owned(),
            title: id.to_owned(),
            language: String::new(),
            file: String::new(),
        }
    }
}
