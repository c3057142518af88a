//! What is wrong in the meaning of a frame that is well formed, each with the sentence that says so.

use std::collections::HashMap;
use std::fmt;
use std::sync::OnceLock;

use actucheck_spec::load::{embedded, yaml};
use actucheck_spec::model::{Requirement, RequirementsFile};
use schemars::JsonSchema;
use serde::Serialize;

/// Something that a document says otherwise.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Warning {
    /// What is wrong.
    pub text: String,
    /// The id of the document that says otherwise.
    pub document: &'static str,
    /// The document's section.
    pub section: &'static str,
    /// The id of the requirement, which `actucheck spec show` explains.
    pub requirement: &'static str,
}

impl Warning {
    /// A warning by the first requirement with one of these names in the first document that has one;
    /// `None` if there is none, as nothing is wrong that no document demands.
    pub(super) fn of<'a>(
        documents: impl IntoIterator<Item = &'a str>,
        names: &[&str],
        text: String,
    ) -> Option<Self> {
        let mut documents = documents.into_iter().filter_map(|id| requirements().get(id));
        let rule = documents.find_map(|rules| names.iter().find_map(|name| rules.get(*name)))?;
        let (document, section) = (rule.source.document.as_str(), rule.source.section.as_str());
        Some(Self { text, document, section, requirement: &rule.id })
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { text, document, section, requirement } = self;
        write!(f, "{text} [{document} §{section}, {requirement}]")
    }
}

/// The requirements of each document by the rest of their ids.
type Requirements = HashMap<String, HashMap<String, Requirement>>;

/// Only they are read of the spec, which is quick, and only when there is something to warn of.
fn requirements() -> &'static Requirements {
    static ROWS: OnceLock<Requirements> = OnceLock::new();
    ROWS.get_or_init(|| {
        let files = embedded().into_iter().filter(|file| file.path.contains("/requirements/"));
        let files = files.filter_map(|file| yaml::<RequirementsFile>(&file.text).ok());
        let mut documents = Requirements::new();
        for row in files.flat_map(|file| file.requirements) {
            let Some((document, name)) = row.id.split_once('.') else { continue };
            let (document, name) = (document.to_owned(), name.to_owned());
            documents.entry(document).or_default().insert(name, row);
        }
        documents
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_requirement_that_there_is_gives_the_section() {
        let documents = ["xm430-w210", "dynamixel2"];
        let names = ["read.order", "read.parameters"];
        let warning = Warning::of(documents, &names, "Too few.".to_owned()).unwrap();
        let text = "Too few. [dynamixel2 §Read (0x02), dynamixel2.read.parameters]";
        assert_eq!(warning.to_string(), text);
        assert_eq!(Warning::of(documents, &["rule"], String::new()), None);
    }
}
