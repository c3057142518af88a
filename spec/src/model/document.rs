use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// `documents.yaml`.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DocumentsFile {
    /// One row per document.
    pub documents: Vec<Document>,
}

/// A source document of the spec.
#[derive(Clone, Debug, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// Its id in citations.
    pub id: String,
    /// Its title in English.
    pub title: String,
    /// The language that it is written in.
    pub language: String,
    /// Name of its file.
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
