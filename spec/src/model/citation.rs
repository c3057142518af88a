use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A place in a document, written `DOCUMENT §SECTION`: `ja40 §1.6.1`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize, JsonSchema)]
#[serde(try_from = "String", into = "String")]
#[schemars(extend("pattern" = r"^.+? §.*\S"))]
pub struct Citation {
    /// Id of the document, as `documents.yaml` lists it.
    pub document: String,
    /// The section, by its number or its heading.
    pub section: String,
}

impl TryFrom<String> for Citation {
    type Error = String;
    fn try_from(text: String) -> Result<Self, String> {
        match text.split_once(" §") {
            Some((document, section)) if !document.is_empty() && !section.trim().is_empty() => {
                Ok(Self { document: document.to_owned(), section: section.trim().to_owned() })
            }
            _ => Err(format!("`{text}` is no citation; one is written `DOCUMENT §SECTION`")),
        }
    }
}

impl From<Citation> for String {
    fn from(citation: Citation) -> Self {
        citation.to_string()
    }
}

impl fmt::Display for Citation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} §{}", self.document, self.section)
    }
}
