use std::fmt;

#[cfg(feature = "exports")]
use schemars::JsonSchema;
use serde::Deserialize;

/// A place in a document, written `DOCUMENT §SECTION`: `ja40 §1.6.1`. A heading that is not in
/// English is followed by its meaning: `dynamixel2 §Packet 처리 (packet handling)`.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[cfg_attr(feature = "exports", derive(serde::Serialize, JsonSchema))]
#[serde(try_from = "String", into = "String")]
#[cfg_attr(feature = "exports", schemars(extend("pattern" = r"^.+? §.*\S")))]
pub struct Citation {
    /// Id of the document, as `documents.yaml` lists it.
    pub document: String,
    /// The section, by its number or its heading, with the gloss if there is one.
    pub section: String,
}

impl TryFrom<String> for Citation {
    type Error = String;
    fn try_from(text: String) -> Result<Self, String> {
        let (document, section) = text
            .split_once(" §")
            .map(|(document, section)| (document, section.trim()))
            .filter(|(document, section)| !document.is_empty() && !section.is_empty())
            .ok_or_else(|| {
                format!("`{text}` is no citation; one is written `DOCUMENT §SECTION`")
            })?;
        if !section.is_ascii() && !has_gloss(section) {
            return Err(format!("`{text}` needs its meaning in English, as in `{text} (meaning)`"));
        }
        Ok(Self { document: document.to_owned(), section: section.to_owned() })
    }
}

/// Whether the section ends with English in parentheses.
fn has_gloss(section: &str) -> bool {
    let gloss = section.strip_suffix(')').and_then(|section| section.rsplit_once(" ("));
    gloss.is_some_and(|(_, gloss)| !gloss.trim().is_empty() && gloss.is_ascii())
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
