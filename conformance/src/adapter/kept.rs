//! What is kept of what an adapter says. Most is much smaller; so an adapter that says too much costs
//! the memory of one line only.

use actucheck_spec::model::HexBytes;

use super::{Implementation, Output};
use crate::legible::{LONGEST_NAME, legible};

impl Implementation {
    /// The same with legible texts.
    #[must_use]
    pub fn legible(self) -> Self {
        let name = |text: String| legible(&text, LONGEST_NAME);
        let Self { name: own, version, language, url } = self;
        Self {
            name: name(own),
            version: name(version),
            language: name(language),
            url: url.map(name),
        }
    }
}

/// How many bytes longer than expected an output may be and is kept as it is.
const LONGER: usize = 1024;

impl Output {
    /// What is kept of it, beside the expected output: bytes are cut after the length that is
    /// expected, and anything else that is longer by far is dropped. Names are made legible. So an
    /// outcome is not much larger than its check. Also a sentence, if something is missing.
    #[must_use]
    pub fn kept(self, expected: Option<&Self>) -> (Option<Self>, String) {
        let size = |output: &Self| output.to_string().len();
        let most = 2 * LONGER + expected.map_or(0, size);
        let none = String::new();
        match self {
            Self::Bytes(HexBytes(mut bytes)) if 2 * bytes.len() > most => {
                let (all, kept) = (bytes.len(), most / 2);
                bytes.truncate(kept);
                bytes.shrink_to_fit();
                let missing = format!("of its {all} bytes the first {kept} are kept");
                (Some(Self::Bytes(HexBytes(bytes))), missing)
            }
            Self::Bytes(bytes) => (Some(Self::Bytes(bytes)), none),
            // The line keeps no more of it than is shown.
            Self::Conversation(steps) => (Some(Self::Conversation(steps)), none),
            Self::Line(steps) => (Some(Self::Line(steps)), none),
            other => match (size(&other), other) {
                (all, _) if all > most => (None, format!("its {all} characters are not kept")),
                (_, Self::Message(message)) => {
                    let name = |name: String| legible(&name, LONGEST_NAME);
                    (Some(Self::Message(message.map_names(name))), none)
                }
                (_, other) => (Some(other), none),
            },
        }
    }
}
