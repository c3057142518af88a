//! Reads the documents, to compare them with the YAML.

pub(crate) mod document;
mod folder;
pub(crate) mod numbers;
pub(crate) mod packets;
pub(crate) mod ranges;
pub(crate) mod references;
pub(crate) mod rows;

use std::fmt;

use actucheck_spec::model::ProofKind;

/// A defect found without the errata.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Finding {
    /// Id of the document.
    pub(crate) document: String,
    /// The line, from 1.
    pub(crate) line: usize,
    /// What was looked at.
    pub(crate) kind: ProofKind,
    /// What is wrong.
    pub(crate) what: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} line {}: {}", self.document, self.line, self.what)
    }
}
