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
    /// A warning by the first of these requirements that there is; `None` if there is none, as
    /// nothing is wrong that no document demands.
    pub(super) fn of(ids: impl IntoIterator<Item = String>, text: String) -> Option<Self> {
        let rule = ids.into_iter().find_map(|id| requirements().get(&id))?;
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

/// The requirements of all documents by their ids. Only they are read of the spec, which is quick,
/// and only when there is something to warn of.
fn requirements() -> &'static HashMap<String, Requirement> {
    static ROWS: OnceLock<HashMap<String, Requirement>> = OnceLock::new();
    ROWS.get_or_init(|| {
        let files = embedded().into_iter().filter(|file| file.path.contains("/requirements/"));
        let rows = files.filter_map(|file| yaml::<RequirementsFile>(&file.text).ok());
        rows.flat_map(|file| file.requirements).map(|row| (row.id.clone(), row)).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_requirement_that_there_is_gives_the_section() {
        let ids = ["xm430-w210.read.parameters", "dynamixel2.read.parameters"].map(str::to_owned);
        let warning = Warning::of(ids, "Too few.".to_owned()).unwrap();
        let text = "Too few. [dynamixel2 §Read (0x02), dynamixel2.read.parameters]";
        assert_eq!(warning.to_string(), text);
        assert_eq!(Warning::of(["no.rule".to_owned()], String::new()), None);
    }
}
