#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

/// `documents.yaml`.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct DocumentsFile {
    /// One row per document.
    pub documents: Vec<Document>,
}

/// A source document of the spec.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// Its id in citations.
    pub id: String,
    /// Its title in English.
    pub title: String,
    /// The language that it is written in.
    pub language: String,
    /// Name of its file, if the document was given to this project. `sentences/` has all of it then.
    pub file: Option<String>,
    /// Where it is public, if it is. Only facts are taken from it.
    pub url: Option<String>,
}

impl Document {
    /// Where it is: its file, or where it is public.
    #[must_use]
    pub fn place(&self) -> &str {
        self.file.as_deref().or(self.url.as_deref()).unwrap_or_default()
    }

    /// One of which nothing is known but what citations call it.
    #[must_use]
    pub(crate) fn own(id: &str) -> Self {
        Self {
            id: id.to_owned(),
            title: id.to_owned(),
            language: String::new(),
            file: None,
            url: None,
        }
    }
}
